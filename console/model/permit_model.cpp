// The motion permit for those who show it.
#include "model/permit_model.hpp"

#include <QStringList>

#include <algorithm>

namespace console {

PermitModel::PermitModel(QObject* parent) : QObject(parent), m_checklist(checkGuards({})) {}

int PermitModel::unmetCount() const
{
    return static_cast<int>(std::count_if(m_checklist.begin(), m_checklist.end(), [](const GuardLine& line) { return !line.met; }));
}

QString PermitModel::unmetText(int most) const
{
    QStringList lines;
    for (const auto& line : m_checklist)
        if (!line.met && lines.size() < most)
            lines << line.text;
    return lines.join(QStringLiteral(" · "));
}

PermitActions PermitModel::apply(const PermitEvent& event, Instant now)
{
    const auto before = m_state.phase;
    const auto next = step(m_state, event, now);
    m_state = next.state;
    if (m_state.phase == PermitPhase::Hold && before != PermitPhase::Hold)
        m_holdReasons = reasons();
    if (m_state.phase != before)
        Q_EMIT phaseChanged(before, m_state.phase);
    return next.actions;
}

QStringList PermitModel::reasons() const
{
    if (m_state.cause == HoldCause::GuardFailed && !m_broken.isEmpty())
        return m_broken;
    return {word(m_state.cause, m_interrupted)};
}

PermitActions PermitModel::interrupt(const QString& link, Instant now)
{
    PermitEvent event;
    event.kind = PermitEventKind::SessionInterrupted;
    m_interrupted = link;
    const auto actions = apply(event, now);
    m_interrupted.clear();
    return actions;
}

PermitActions PermitModel::check(const GuardReadings& readings, Instant now)
{
    const auto checklist = checkGuards(readings);
    const bool same = std::equal(checklist.begin(), checklist.end(), m_checklist.begin(),
                                 [](const GuardLine& a, const GuardLine& b) { return a.met == b.met && a.text == b.text; });
    m_checklist = checklist;
    if (!same)
        Q_EMIT checklistChanged();
    PermitEvent event;
    event.kind = PermitEventKind::GuardsChecked;
    event.armable = metGuards(m_checklist);
    return applyKept(event, readings, now);
}

PermitActions PermitModel::keep(const GuardReadings& readings, Instant now)
{
    PermitEvent event;
    event.kind = PermitEventKind::GuardsChecked;
    event.armable = m_state.armable;
    return applyKept(event, readings, now);
}

PermitActions PermitModel::applyKept(PermitEvent event, const GuardReadings& readings, Instant now)
{
    event.kept = checkKept(readings);
    const bool mayHold =
        m_state.phase == PermitPhase::Arming || m_state.phase == PermitPhase::Armed || m_state.phase == PermitPhase::Engaged;
    m_broken = mayHold && !event.kept.all() ? brokenGuards(readings) : QStringList();
    return apply(event, now);
}

} // namespace console
