// The motion permit for those who show it: phase, checklist, and why it holds.
#pragma once

#include "model/motion_permit.hpp"

#include <QObject>
#include <QString>

namespace console {

/// GUI thread only. The composition root feeds it; widgets read it.
class PermitModel : public QObject {
    Q_OBJECT
public:
    explicit PermitModel(QObject* parent = nullptr);

    const PermitState& state() const { return m_state; }
    PermitPhase phase() const { return m_state.phase; }
    const GuardChecklist& checklist() const { return m_checklist; }
    int unmetCount() const;

    /// The first unmet conditions as one line; empty when all are met.
    QString unmetText(int most = 3) const;

    /// Why motion was held last: the conditions that failed, or the cause. Empty before the first time.
    const QStringList& holdReasons() const { return m_holdReasons; }

    /// Feeds the machine; the actions are the caller's to carry out.
    PermitActions apply(const PermitEvent& event, Instant now);

    /// Feeds SessionInterrupted; `link`: the title of whose link it was.
    PermitActions interrupt(const QString& link, Instant now);

    /// Replaces the checklist and feeds GuardsChecked.
    PermitActions check(const GuardReadings& readings, Instant now);

    /// Between two of those: feeds GuardsChecked with what ends motion, and leaves what arming needs as it is.
    PermitActions keep(const GuardReadings& readings, Instant now);

Q_SIGNALS:
    void phaseChanged(console::PermitPhase from, console::PermitPhase to);
    void checklistChanged();

private:
    PermitActions applyKept(PermitEvent event, const GuardReadings& readings, Instant now);

    QStringList reasons() const;

    PermitState m_state;
    GuardChecklist m_checklist;
    QStringList m_broken;  ///< of the guards that are being looked at, where they would end motion
    QString m_interrupted; ///< the title of whose link is being told of
    QStringList m_holdReasons;
};

} // namespace console
