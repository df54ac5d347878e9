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
    if (!running() && !passed())
        enter(Step::High, now);
}

void AlarmSelfTest::confirm()
{
    if (m_step == Step::Asking)
        enter(Step::Passed, m_since);
}

void AlarmSelfTest::refuse()
{
    if (m_step == Step::Asking)
        enter(Step::Failed, m_since);
}

void AlarmSelfTest::update(bool disturbed, Instant now)
{
    if (disturbed && running())
        return enter(Step::NotDone, now);
    const auto in = now - m_since;
    if (m_step == Step::High && in >= highTime)
        enter(Step::Medium, now);
    else if (m_step == Step::Medium && in >= mediumTime)
        enter(Step::Low, now);
    else if (m_step == Step::Low && in >= lowTime)
        enter(Step::Asking, now);
}

} // namespace console
