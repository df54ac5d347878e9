// The simulated body of the vascular robot: implementation.
#include "robot_simulation.hpp"

#include <algorithm>

namespace liena::devices {

namespace {

constexpr double trackerNoise = 0.3;    // mm per coordinate
constexpr double room = 24;             // °C
constexpr double hottest = 90;          // °C
constexpr double frictionPerRad = 0.03; // N per rad of bend
constexpr double dragPerMillimetre = 0.0004;

} // namespace

std::array<double, 4> quaternionTo(Vector direction)
{
    const Vector to = normalised(direction);
    const double w = std::sqrt(std::max(0.0, (1 + to.z) / 2));
    if (w < 1e-6)
        return {0, 1, 0, 0};
    const Vector axis = cross({0, 0, 1}, to) * (1 / (2 * w));
    return {w, axis.x, axis.y, axis.z};
}

RobotSimulation::RobotSimulation(VesselWay way, double start, std::uint64_t seed) : m_way(std::move(way)), m_noise(seed)
{
    m_positions[0] = std::clamp(start, 0.0, m_way.length() - 5);
    m_positions[2] = std::max(0.0, m_positions[0] - 40);
    m_temperatures.fill(room + 6);
}

DriveFeedback RobotSimulation::feedback() const { return {m_positions, m_force}; }

void RobotSimulation::setGripper(Gripper gripper, bool closed) { m_closed[gripper == Gripper::Guidewire ? 0 : 1] = closed; }

bool RobotSimulation::gripperClosed(Gripper gripper) const { return m_closed[gripper == Gripper::Guidewire ? 0 : 1]; }

void RobotSimulation::move(const DriveStep& step, std::chrono::nanoseconds duration)
{
    for (std::size_t axis = 0; axis < axisCount; ++axis) {
        const bool held = m_closed[axis / 2]; // an open gripper slides along its instrument
        m_velocities[axis] = held ? step.velocities[axis] : 0;
        m_positions[axis] += held ? step.displacements[axis] : 0;
    }
    const double seconds = std::chrono::duration<double>(duration).count();
    feel(seconds);
    warm(seconds);
}

// The tip's bend looks towards the leaving vessel or away from it, by the wire's angle; each branch has its own good angle.
double RobotSimulation::contact(double advance) const
{
    constexpr double reach = 6;
    double most = 0;
    for (const double branch : m_way.branches()) {
        const double distance = std::abs(m_positions[0] - branch);
        if (distance >= reach)
            continue;
        const double wrong = (1 - std::cos(radians(m_positions[1] + branch * 37))) / 2;
        most = std::max(most, wrong * (1 - distance / reach));
    }
    const double narrow = std::max(0.0, 1.2 - m_way.at(m_positions[0]).radius) * 0.3;
    return advance > 0 ? 1.2 * most + narrow : 0;
}

void RobotSimulation::feel(double seconds)
{
    const double advance = m_velocities[0];
    const double friction = 0.04 + frictionPerRad * m_way.bendUntil(m_positions[0]) + dragPerMillimetre * m_positions[0];
    const double wanted = friction * std::tanh(advance / 2) + contact(advance) * std::tanh(advance / 5);
    // The wire stores some of the push when it stands, and lets go of it slowly.
    const double time = advance != 0 ? 0.06 : 0.8;
    m_force = std::clamp(m_force + (wanted - m_force) * (1 - std::exp(-seconds / time)), -5.0, 5.0);
    const double turn = m_velocities[1];
    const double wantedTorque = (1.5 + 4 * friction) * std::tanh(turn / 40);
    m_torque = std::clamp(m_torque + (wantedTorque - m_torque) * (1 - std::exp(-seconds / time)), -50.0, 50.0);
}

void RobotSimulation::warm(double seconds)
{
    constexpr std::array<double, axisCount> perSpeed{0.012, 0.0008, 0.014, 0.0012};
    for (std::size_t axis = 0; axis < axisCount; ++axis) {
        const double load = axis == 0 ? 0.15 * m_force : axis == 1 ? 0.02 * m_torque : 0;
        const double speed = m_velocities[axis];
        m_currents[axis] = 0.08 + perSpeed[axis] * std::abs(speed) + std::abs(load);
        const double settled = room + 6 + 22 * m_currents[axis] * m_currents[axis];
        m_temperatures[axis] += (settled - m_temperatures[axis]) * std::min(1.0, seconds / 180);
    }
}

DriveReading RobotSimulation::drive(Axis axis) const
{
    const auto index = static_cast<std::size_t>(axis);
    const double total = m_currents[0] + m_currents[1] + m_currents[2] + m_currents[3];
    return {m_currents[index], m_temperatures[index], m_velocities[index] * 0.002, 24 - 0.1 * total};
}

bool RobotSimulation::drivesHealthy() const
{
    return std::all_of(m_temperatures.begin(), m_temperatures.end(), [](double temperature) { return temperature < hottest; });
}

TipReading RobotSimulation::tip()
{
    const WayPoint place = m_way.at(m_positions[0]);
    TipReading reading;
    reading.valid = true;
    const Vector noise{m_noise.normal(), m_noise.normal(), m_noise.normal()};
    reading.position = place.position + noise * trackerNoise;
    const Vector tilt{m_noise.normal(), m_noise.normal(), m_noise.normal()};
    reading.quaternion = quaternionTo(place.direction + tilt * 0.01);
    reading.error = trackerNoise * std::sqrt(3.0);
    return reading;
}

} // namespace liena::devices
