// What runs on the simulated devices: the real robot and drive gate, a cockpit that commands, and devices that report.
#pragma once

#include "scenario.hpp"
#include "simulated_device.hpp"

#include "drive_gate.hpp"
#include "robot_machine.hpp"

#include <map>
#include <memory>
#include <optional>

namespace liena::simulation {

/// One kind of message, filled again and again.
class Form {
public:
    Form(std::shared_ptr<const MessageSet> set, std::string_view name);
    Message& message() { return m_message; }
    template <typename T>
    Form& set(std::string_view field, const T& value)
    {
        m_message.set(field, value);
        return *this;
    }

private:
    Message m_message;
};

/// Plays RobotDevice around the real RobotMachine and DriveGate.
class RobotPart : public Application {
public:
    RobotPart(const Scenario& scenario, std::uint32_t firstPermit);
    void start(SimulatedDevice& device) override;
    void heard(const SessionEvent& event) override;
    void delivered(HostIndex peer, const Message& message) override;

private:
    bool handle(const devices::RobotEvent& event, const devices::MotionCommanded* motion = nullptr);
    void actOnDrives(devices::RobotActions::Drives drives, const devices::MotionCommanded* motion);
    void control();
    void observeDrives(const devices::DriveStep& step, Nanoseconds passed);
    void publishStatus();
    void onMotion(HostIndex peer, const Message& message);

    const Scenario& m_scenario;
    SimulatedDevice* m_device = nullptr;
    devices::DriveGate m_gate;
    devices::RobotMachine m_machine;
    devices::AxisValues m_positions{100, 0, 100, 0};
    devices::AxisValues m_velocities{};
    std::optional<Instant> m_lastControl;
    Instant m_commanded;
    bool m_wasMoving = false;
    std::optional<Form> m_status;
};

/// The surgeon's console: arms when the robot is ready, and streams commands; the dead-man comes and goes.
class CockpitPart : public Application {
public:
    CockpitPart(const Scenario& scenario, SeededRandom random) : m_scenario(scenario), m_random(random) {}
    void start(SimulatedDevice& device) override;
    void heard(const SessionEvent& event) override;
    void delivered(HostIndex peer, const Message& message) override;

private:
    struct Robot {
        std::uint32_t permit = 0;
        devices::RobotState state = devices::RobotState::Off;
        std::uint64_t stop = 0;
        std::uint32_t sequence = 0;
        std::uint32_t neutralUnder = 0; ///< the permit under which a neutral command was sent
        Instant nextRequest;
    };

    void command();
    void commandRobot(HostIndex peer, Robot& robot);
    void request(HostIndex peer, Robot& robot);

    const Scenario& m_scenario;
    SeededRandom m_random;
    SimulatedDevice* m_device = nullptr;
    std::map<HostIndex, Robot> m_robots;
    std::map<HostIndex, Form> m_others; ///< what is commanded of the arms and the X-ray systems
    std::optional<Form> m_motion;
    std::optional<Form> m_permit;
    std::optional<Form> m_status;
    bool m_pressed = false;
    Instant m_nextPress;
};

/// An arm or an X-ray system: reports, and sends pictures when there are any.
class ReportingPart : public Application {
public:
    ReportingPart(const Scenario& scenario, SeededRandom random) : m_scenario(scenario), m_random(random) {}
    void start(SimulatedDevice& device) override;
    void heard(const SessionEvent&) override {}
    void delivered(HostIndex, const Message&) override {}

private:
    const Scenario& m_scenario;
    SeededRandom m_random;
    std::optional<Form> m_status;
    std::optional<Form> m_picture;
};

std::unique_ptr<Application> applicationFor(const Scenario& scenario, HostIndex host, SeededRandom random);

} // namespace liena::simulation
