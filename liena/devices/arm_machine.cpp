// The robotic arm: implementation.
#include "arm_machine.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace liena::devices {

namespace {

constexpr Joints fullSpeed{0.6, 0.6, 0.8, 1.2, 1.2, 1.6}; // rad/s
constexpr double acceleration = 1.0;                      // rad/s²
constexpr double deceleration = 8.0;                      // rad/s²
constexpr double reached = 1e-4;                          // rad

double slowed(double velocity, double most) { return velocity > 0 ? std::max(0.0, velocity - most) : std::min(0.0, velocity + most); }

} // namespace

ArmMachine::ArmMachine() : m_positions{0, -0.6, 1.1, 0, 0.7, 0}, m_targets(m_positions) {}

bool ArmMachine::still() const
{
    return std::all_of(m_velocities.begin(), m_velocities.end(), [](double velocity) { return velocity == 0; });
}

bool ArmMachine::refuse(std::string_view reason)
{
    ++m_refused;
    m_reason = reason;
    return false;
}

// What barred the move may go away by itself, and must not set the stream going that it barred.
bool ArmMachine::bar(DeviceId origin, std::string_view reason)
{
    m_unlocked.erase(origin);
    return refuse(reason);
}

void ArmMachine::stop()
{
    m_state = ArmState::Hold;
    m_owner.reset();
}

void ArmMachine::interrupt(std::string_view reason)
{
    if (m_state != ArmState::Moving)
        return;
    m_reason = reason;
    m_unlocked.clear();
    stop();
}

// The stop makes the robot hold, which is what the first of a stream of moves may wait for.
void ArmMachine::lock(std::string_view reason)
{
    interrupt(reason);
    m_unlocked.clear();
}

bool ArmMachine::robotHolds(SteadyTime now) const { return m_robotHeld && now - *m_robotHeld <= robotFresh; }

bool ArmMachine::command(const ArmRequest& request, SteadyTime now)
{
    if (request.origin.classNumber() != static_cast<std::uint8_t>(DeviceClass::Brain))
        return refuse("only a cockpit commands the arm");
    if (!request.move) {
        if (m_owner && *m_owner != request.origin)
            m_unlocked.erase(*m_owner); // its next repeat would undo this hold
        m_unlocked.insert(request.origin);
        stop();
        return true;
    }
    if (m_owner && *m_owner != request.origin)
        return bar(request.origin, "another cockpit is moving it");
    if (!m_unlocked.contains(request.origin))
        return refuse("a move was refused, it was stopped, or the session is new; send hold before the next move");
    if (m_standBy)
        return bar(request.origin, "the system stands by");
    if (!robotHolds(now))
        return bar(request.origin, "the vascular robot does not report that it holds");
    const bool sane = std::all_of(request.targets.begin(), request.targets.end(), [](double target) { return std::abs(target) <= 3.15; });
    if (!sane || !(request.speedScale >= 0 && request.speedScale <= 1))
        return refuse("a target or the speed is outside its bounds");
    m_state = ArmState::Moving;
    m_owner = request.origin;
    m_targets = request.targets;
    m_speedScale = request.speedScale;
    m_leaseEnd = now + lease;
    return true;
}

void ArmMachine::robotReported(bool holds, SteadyTime arrived)
{
    m_robotHeld = holds ? std::optional(arrived) : std::nullopt;
    if (!holds)
        interrupt("the vascular robot no longer holds");
}

void ArmMachine::robotNamesStop(std::uint64_t token)
{
    if (std::exchange(m_robotStop, token) != token && token != 0)
        lock("the vascular robot was stopped");
}

void ArmMachine::sessionLost(DeviceId peer)
{
    if (m_owner == peer)
        interrupt("the commanding cockpit's session is not open");
    m_unlocked.erase(peer);
}

void ArmMachine::setStandBy(bool standsBy)
{
    m_standBy = standsBy;
    if (standsBy)
        lock("the system stands by");
}

void ArmMachine::step(SteadyTime now)
{
    if (!robotHolds(now))
        interrupt("the vascular robot's hold is no longer reported");
    if (now > m_leaseEnd)
        interrupt("the command stream ended");
    const double seconds = std::chrono::duration<double>(now - m_lastStep.value_or(now)).count();
    m_lastStep = now;
    moveJoints(std::clamp(seconds, 0.0, 0.02)); // a late run is not made up for
    if (m_state == ArmState::Moving && still()) {
        bool there = true;
        for (std::size_t joint = 0; joint < jointCount; ++joint)
            there = there && std::abs(m_targets[joint] - m_positions[joint]) <= reached;
        if (there)
            stop();
    }
}

void ArmMachine::moveJoints(double seconds)
{
    if (seconds <= 0)
        return;
    for (std::size_t joint = 0; joint < jointCount; ++joint) {
        double& velocity = m_velocities[joint];
        const double way = m_targets[joint] - m_positions[joint];
        if (m_state != ArmState::Moving || way * velocity < 0) {
            velocity = slowed(velocity, deceleration * seconds);
        } else {
            const double most =
                std::min({fullSpeed[joint] * m_speedScale, std::sqrt(acceleration * std::abs(way)), std::abs(way) / seconds});
            velocity = std::copysign(std::min(std::abs(velocity) + acceleration * seconds, most), way);
        }
        if (m_state == ArmState::Moving && std::abs(way) <= reached)
            velocity = 0;
        m_positions[joint] += velocity * seconds;
    }
}

Joints ArmMachine::torques() const
{
    constexpr Joints load{0, 62, 28, 2, 6, 0.5}; // N·m with the limb stretched out
    Joints torques{};
    for (std::size_t joint = 0; joint < jointCount; ++joint)
        torques[joint] = load[joint] * std::cos(m_positions[1] + (joint >= 2 ? m_positions[2] : 0)) + 4 * m_velocities[joint];
    return torques;
}

} // namespace liena::devices
