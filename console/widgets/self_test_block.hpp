// The buttons of the alarm self-test: begin it, and say what was seen and heard.
#pragma once

#include "model/alarm_self_test.hpp"

#include <QWidget>

class QPushButton;

namespace console {

/// Nothing is shown while a passed test counts.
class SelfTestBlock : public QWidget {
    Q_OBJECT
public:
    explicit SelfTestBlock(QWidget* parent = nullptr);
    void setStep(AlarmSelfTest::Step step);

    /// Not beside a high alarm that nobody has acknowledged.
    void setMayBegin(bool may);

    /// Nobody is made to say that they heard what could not sound.
    void setSoundWorks(bool works);

Q_SIGNALS:
    void beginRequested();
    void answered(bool seenAndHeard);

private:
    QPushButton* add(const QString& text, const QString& accessibleName);

    QPushButton* m_begin;
    QPushButton* m_right;
    QPushButton* m_wrong;
};

} // namespace console
