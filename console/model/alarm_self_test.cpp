// The alarm self-test, step by step.
#include "model/alarm_self_test.hpp"

namespace console {

AlarmSelfTest::AlarmSelfTest(QObject* parent) : QObject(parent) {}

std::optional<AlarmPriority> AlarmSelfTest::signal() const
{
    switch (m_step) {
    case Step::High:
        return AlarmPriority::High;
    case Step::Medium:
        return AlarmPriority::Medium;
    case Step::Low:
        return AlarmPriority::Low;
    default:
        return std::nullopt;
    }
}

void AlarmSelfTest::enter(Step step, Instant now)
{
    m_step = step;
    m_since = now;
    Q_EMIT changed();
}

void AlarmSelfTest::begin(Instant now)
{
    if (m_step == Step::NotDone || m_step == Step::Failed)
        enter(Step::High, now);
}

void AlarmSelfTest::confirm()
{
    if (m_step != Step::Asking)
        return;
    ++m_passes;
    enter(Step::Passed, m_since);
}

void AlarmSelfTest::refuse()
{
    if (m_step == Step::Asking)
        enter(Step::Failed, m_since);
}

void AlarmSelfTest::follow(PermitPhase phase, Instant now)
{
    const bool armed = phase == PermitPhase::Armed || phase == PermitPhase::Engaged;
    if (armed && m_step != Step::InUse)
        enter(Step::InUse, now);
    else if (!armed && m_step == Step::InUse)
        enter(Step::NotDone, now);
    else if (phase == PermitPhase::Incident && passed())
        enter(Step::NotDone, now);
}

void AlarmSelfTest::update(bool disturbed, Instant now)
{
    if (disturbed && running())
        return enter(Step::NotDone, now);
    const auto in = now - m_since;
    const auto& times = isBrief() ? brief : whole;
    if (m_step == Step::High && in >= times.high)
        enter(Step::Medium, now);
    else if (m_step == Step::Medium && in >= times.medium)
        enter(Step::Low, now);
    else if (m_step == Step::Low && in >= times.low)
        enter(Step::Asking, now);
    else if ((m_step == Step::Asking && in >= answerTime) || (m_step == Step::Passed && in >= validity))
        enter(Step::NotDone, now);
}

} // namespace console
