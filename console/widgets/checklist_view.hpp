// F6: every condition of the motion permit with its state, and how many are missing.
#pragma once

#include "model/permit_model.hpp"

#include <QFrame>

#include <vector>

class QGridLayout;
class QLabel;

namespace console {

class GuardRow;
class SheetButton;

/// The conditions in two columns, in an order that does not change. Follows the model by its signals; `permit` must outlive it.
class ChecklistPane : public QFrame {
    Q_OBJECT
public:
    explicit ChecklistPane(const PermitModel& permit, QWidget* parent = nullptr);

private:
    void refresh();

    const PermitModel& m_permit;
    QLabel* m_summary;
    QGridLayout* m_grid;
    std::vector<GuardRow*> m_rows;
};

/// The pane as a view over E, F and G.
class ChecklistView : public QFrame {
    Q_OBJECT
public:
    explicit ChecklistView(const PermitModel& permit, QWidget* parent = nullptr);

Q_SIGNALS:
    void leaveRequested();
};

} // namespace console
