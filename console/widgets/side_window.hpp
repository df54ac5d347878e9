// A window on a further screen: what is good to see, and nothing that moves anything.
#pragma once

#include <QWidget>

#include <initializer_list>

class QVBoxLayout;

namespace console {

/// Not the cockpit: the hand has no keys while it has the focus. Esc, F12 and F9 work in it as everywhere (UrgentKeys); F1 goes back to the
/// cockpit, also to one that is minimised or hidden.
class SideWindow : public QWidget {
    Q_OBJECT
public:
    explicit SideWindow(const QString& name);

    /// Takes them: a row, beneath the rows before it, and its parts side by side in equal width.
    void add(std::initializer_list<QWidget*> parts, int share);

Q_SIGNALS:
    void emergencyStopRequested(const QString& reason);
    void panicHoldRequested();
    void audioPauseRequested();
    void cockpitRequested();
    void closedByPerson();

protected:
    void closeEvent(QCloseEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;

private:
    void addKeys();

    QVBoxLayout* m_column;
};

} // namespace console
