// Actions in one row, or in two where one has no room for them.
#pragma once

#include <QWidget>

class QBoxLayout;

namespace console {

/// In one row `second` stands to the right of `first` and takes what is left of the width; else below it.
class ActionRows : public QWidget {
    Q_OBJECT
public:
    explicit ActionRows(QWidget* parent);

    QBoxLayout* first() { return m_first; }
    QBoxLayout* second() { return m_second; }

protected:
    bool event(QEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;

private:
    void arrange();

    QBoxLayout* m_rows;
    QBoxLayout* m_first;
    QBoxLayout* m_second;
};

} // namespace console
