// The cockpit of the lab: a person who arms, and a hand that never lets go of the pedal by itself.
#pragma once

#include "device/device_part.hpp"

#include <cstdint>
#include <map>
#include <optional>

namespace liena::lab {

/// Commands one robot at 500 Hz under the permit it armed with, and goes on doing so whatever happens to the session, until told to `arm`
/// anew: nothing on this side helps the robot to stop.
///
/// Tells the runner: `sent <permit> <sequence>` for each command at the moment it is composed, `heard <robot> <state> <permit>`,
/// and `picture <frame> whole|torn <rung> <bytes>`.
class CockpitPart : public DevicePart {
public:
    struct Options {
        bool hoardsPictures = false; ///< leaves them in the cache and never drains it
    };

    CockpitPart(DistributedSystem& system, Options options);

    void tick(std::chrono::steady_clock::time_point now) override;

    /// `arm ROBOT`, `lift`; `pedal DEVICE` and `pedal up`: pictures of that X-ray system, which are not the lab's own then.
    bool obey(const std::string& verb, std::istringstream& rest) override;

private:
    struct Robot {
        int state = 0;
        std::uint32_t permit = 0;
    };

    void onRobotStatus(const Message& message);
    void onPicture(const Message& message);
    bool arm(const std::string& name);
    bool press(const std::string& name);
    void repeatPedal(std::chrono::steady_clock::time_point now);
    void command(bool engaged);

    DistributedSystem& m_system;
    std::map<DeviceId, Robot> m_robots;
    DeviceId m_target;
    std::uint32_t m_asked = 0;  ///< permit of an arm request without an answer yet
    std::uint32_t m_permit = 0; ///< 0: not armed
    std::uint32_t m_sequence = 0;
    unsigned m_neutral = 0;         ///< commands with the pedal lifted that are still to come
    std::optional<DeviceId> m_xray; ///< whose pedal is down
    std::uint32_t m_press = 0;
    bool m_begins = false; ///< the X-ray system has not heard yet that the pedal was up before this press
    std::chrono::steady_clock::time_point m_nextPedal;
};

} // namespace liena::lab
