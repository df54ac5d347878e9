// The last check before the actuators: implementation.
#include "drive_gate.hpp"

#include <algorithm>
#include <cmath>

namespace liena::devices {

namespace {

constexpr std::chrono::nanoseconds partLength = std::chrono::milliseconds(1);

double secondsOf(std::chrono::nanoseconds duration) { return std::chrono::duration<double>(duration).count(); }

double towards(double value, double target, double most)
{
    return value < target ? std::min(value + most, target) : std::max(value - most, target);
}

} // namespace

std::string_view toString(StopCause cause)
{
    switch (cause) {
    case StopCause::LeaseOver:
        return "the command stream was lost";
    case StopCause::SoftLimit:
        return "a soft limit was reached";
    case StopCause::HardLimit:
        return "a hard limit was reached";
    case StopCause::ForceStop:
        return "the force on the guidewire reached its limit";
    case StopCause::Watchdog:
        return "the control loop did not run in time";
    }
    return "unknown";
}

DriveLimits DriveLimits::forWay(double wayLength)
{
    const AxisRange soft{0, wayLength - 5};
    const AxisRange hard{-5, wayLength};
    DriveLimits limits;
    limits.axes[0] = {40, 400, 2000, soft, hard};
    limits.axes[1] = {720, 7200, 36000, std::nullopt, std::nullopt};
    limits.axes[2] = {40, 400, 2000, soft, hard};
    limits.axes[3] = {360, 3600, 18000, std::nullopt, std::nullopt};
    return limits;
}

DriveGate::DriveGate(DriveLimits limits) : m_limits(limits) {}

bool DriveGate::still() const
{
    return std::all_of(m_velocities.begin(), m_velocities.end(), [](double velocity) { return velocity == 0; });
}

bool DriveGate::enable()
{
    if (!m_enabled && still())
        m_enabled = true;
    return m_enabled;
}

bool DriveGate::drive(const AxisValues& velocities, SteadyTime commanded, SteadyTime now)
{
    if (!m_enabled || commanded + m_limits.lease <= std::max(now, m_lastStep.value_or(now)))
        return false;
    for (std::size_t axis = 0; axis < axisCount; ++axis)
        if (!(std::abs(velocities[axis]) <= m_limits.axes[axis].maxVelocity)) // also refuses what is no number
            return false;
    m_targets = velocities;
    m_leaseEnd = commanded + m_limits.lease;
    return true;
}

void DriveGate::release()
{
    m_targets.fill(0);
    m_leaseEnd.reset();
}

void DriveGate::stop()
{
    release();
    m_enabled = false;
}

void DriveGate::cut()
{
    stop();
    m_velocities.fill(0);
}

void DriveGate::lock(StopCause cause, DriveStep& step)
{
    if (!step.stop)
        step.stop = cause;
    stop();
}

DriveStep DriveGate::step(SteadyTime now, const DriveFeedback& feedback)
{
    DriveStep step;
    m_positions = feedback.positions;
    checkHardLimits(step);
    checkForce(feedback.guidewireForce, step);
    auto from = m_lastStep.value_or(now);
    const auto watchdogEnd = from + m_limits.watchdog;
    while (from < now && from < watchdogEnd) {
        const auto partEnd = std::min({from + partLength, now, watchdogEnd});
        runPart(partEnd, secondsOf(partEnd - from), step);
        from = partEnd;
    }
    if (now > watchdogEnd && (m_enabled || !still())) {
        lock(StopCause::Watchdog, step);
        m_velocities.fill(0);
    }
    m_lastStep = std::max(now, m_lastStep.value_or(now));
    step.velocities = m_velocities;
    step.still = still() && !m_leaseEnd;
    return step;
}

void DriveGate::checkForce(double force, DriveStep& step)
{
    if (!m_leaseEnd || std::abs(force) < m_limits.forceStop)
        return;
    // Only the way that relieves the wire stays open: out when it is pushed, in when it is pulled, and no turning.
    const double wanted = m_targets[0] != 0 ? m_targets[0] : m_velocities[0];
    const bool relieves = force > 0 ? wanted < 0 : wanted > 0;
    const bool turns = m_targets[1] != 0 || m_velocities[1] != 0;
    if ((wanted != 0 && !relieves) || turns || std::isnan(force))
        lock(StopCause::ForceStop, step);
}

void DriveGate::checkHardLimits(DriveStep& step)
{
    for (std::size_t axis = 0; axis < axisCount; ++axis) {
        const auto& hard = m_limits.axes[axis].hard;
        if (!hard)
            continue;
        const double position = m_positions[axis];
        const auto beyond = [&](double velocity) {
            return !(position >= hard->low || velocity >= 0) || !(position <= hard->high || velocity <= 0) || std::isnan(position);
        };
        if (beyond(m_velocities[axis]) || (m_leaseEnd && beyond(m_targets[axis]))) {
            lock(StopCause::HardLimit, step);
            m_velocities.fill(0);
        }
    }
}

void DriveGate::runPart(SteadyTime partEnd, double seconds, DriveStep& step)
{
    if (m_leaseEnd && partEnd > *m_leaseEnd)
        lock(StopCause::LeaseOver, step);
    bool limited = false;
    for (std::size_t axis = 0; axis < axisCount; ++axis)
        limited = runAxis(axis, seconds, step) || limited;
    if (limited)
        lock(StopCause::SoftLimit, step);
}

double DriveGate::distanceAhead(std::size_t axis, double direction) const
{
    const auto& soft = m_limits.axes[axis].soft;
    if (!soft)
        return HUGE_VAL;
    return std::max(0.0, direction > 0 ? soft->high - m_positions[axis] : m_positions[axis] - soft->low);
}

// True when a soft limit keeps the axis from where it is asked to go.
bool DriveGate::runAxis(std::size_t axis, double seconds, DriveStep& step)
{
    const auto& envelope = m_limits.axes[axis];
    double& velocity = m_velocities[axis];
    const double target = m_targets[axis] * velocity < 0 ? 0 : m_targets[axis]; // a reversal stands still in between
    const bool slows = std::abs(target) < std::abs(velocity);
    double next = towards(velocity, target, (slows ? envelope.deceleration : envelope.acceleration) * seconds);
    bool limited = false;
    if (next != 0) {
        // Half the deceleration leaves room for the stop itself; the second bound never steps over the limit in one part.
        const double ahead = distanceAhead(axis, next);
        const double most = std::min(std::sqrt(envelope.deceleration * ahead), ahead / seconds);
        limited = ahead <= 1e-9 && m_leaseEnd.has_value();
        next = std::clamp(next, -most, most);
    }
    velocity = next;
    const double displacement = next * seconds;
    m_positions[axis] += displacement;
    step.displacements[axis] += displacement;
    return limited;
}

} // namespace liena::devices
