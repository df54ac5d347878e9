// The simulated body of the vascular robot: instruments in the vessel, forces, drives and the magnetic tracker.
#pragma once

#include "drive_gate.hpp"
#include "noise.hpp"
#include "vessel_tree.hpp"

#include <array>
#include <chrono>
#include <cstdint>

namespace liena::devices {

enum class Gripper : std::uint8_t { Guidewire = 1, Catheter = 2 };

struct DriveReading {
    double current = 0;     ///< A
    double temperature = 0; ///< °C
    double followingError = 0;
    double busVoltage = 0; ///< V
};

struct TipReading {
    bool valid = false;
    Vector position; ///< mm
    std::array<double, 4> quaternion{1, 0, 0, 0};
    double error = 0; ///< mm, root mean square
};

/// Pure: it moves only by the displacements it is given, and time comes with them.
///
/// Force on the wire is friction that grows with the bend the wire has taken and with the drag of the wall, and contact where another
/// vessel leaves and the tip's bend points at the edge between them; a turn of the wire frees it.
class RobotSimulation {
public:
    /// `start`: arc length of the guidewire's tip in mm; the catheter stands 40 mm behind it.
    RobotSimulation(VesselWay way, double start, std::uint64_t seed);

    void move(const DriveStep& step, std::chrono::nanoseconds duration);

    /// The drives' positions in the gate's order.
    DriveFeedback feedback() const;

    void setGripper(Gripper gripper, bool closed);
    bool gripperClosed(Gripper gripper) const;

    double force() const { return m_force; }   ///< N, positive against advance
    double torque() const { return m_torque; } ///< mN·m
    const AxisValues& velocities() const { return m_velocities; }
    const VesselWay& way() const { return m_way; }

    DriveReading drive(Axis axis) const;
    bool drivesHealthy() const;

    /// A new measurement: the point on the centre line and the tracker's noise.
    TipReading tip();

private:
    void feel(double seconds);
    void warm(double seconds);
    double contact(double advance) const;

    VesselWay m_way;
    NoiseSource m_noise;
    AxisValues m_positions{};
    AxisValues m_velocities{};
    std::array<bool, 2> m_closed{true, true};
    double m_force = 0;
    double m_torque = 0;
    std::array<double, axisCount> m_currents{};
    std::array<double, axisCount> m_temperatures{};
};

/// The rotation that turns +z to `direction` (w x y z).
std::array<double, 4> quaternionTo(Vector direction);

} // namespace liena::devices
