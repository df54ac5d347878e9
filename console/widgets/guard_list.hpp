// The live checklist of the motion permit: what is missing first, what is met after it.
#pragma once

#include "model/permit_guards.hpp"

#include <QWidget>

namespace console {

class GuardList : public QWidget {
    Q_OBJECT
public:
    explicit GuardList(QWidget* parent = nullptr);
    void setChecklist(const GuardChecklist& checklist);
    QSize sizeHint() const override;
    QSize minimumSizeHint() const override { return sizeHint(); }

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    static constexpr int columns = 3;
    static constexpr int rows = 5;
    std::array<GuardLine, guardCount> m_lines{};
};

} // namespace console
