// An emergency stop that was said at this device, until each robot has named it.
#pragma once

#include "liena/device_id.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace liena::devices {

/// What was handed over may be thrown away before it leaves: only the robot's report says that it heard, and it goes there until then. To a
/// robot whose reports cannot come it goes once in each session: nothing would end the repetition, and it would undo each reset. Pure.
class UnheardStop {
public:
    /// Takes the place of one that was said before. `mute`: those of the robots whose reports cannot come.
    void say(std::uint64_t token, std::string_view reason, std::vector<DeviceId> robots, std::set<DeviceId> mute = {})
    {
        m_token = token;
        m_reason = reason;
        m_robots = std::move(robots);
        m_mute = std::move(mute);
        m_given.clear();
        m_troubles.clear();
    }

    /// A robot names the stop in force that it heard last; 0: none is. Another one says nothing of ours: that one may be reset.
    void reported(DeviceId robot, std::uint64_t named)
    {
        if (named == m_token)
            std::erase(m_robots, robot);
    }

    /// It was handed over to the present session with that robot.
    void given(DeviceId robot)
    {
        if (m_mute.contains(robot))
            m_given.insert(robot);
    }

    /// A session with it has begun, or is open again after it was interrupted: what was under way may have gone with the one before.
    void sessionBegan(DeviceId robot) { m_given.erase(robot); }

    /// Those to which it goes now.
    std::vector<DeviceId> due() const
    {
        auto robots = m_robots;
        std::erase_if(robots, [this](DeviceId robot) { return m_given.contains(robot); });
        return robots;
    }

    /// True where a person has to be told: it did not leave, and for another reason than the last time. Empty: it left.
    bool isNews(DeviceId robot, const std::string& trouble)
    {
        return std::exchange(m_troubles[robot], trouble) != trouble && !trouble.empty();
    }

    /// Those that have not named it; none where none was said.
    const std::vector<DeviceId>& robots() const { return m_robots; }
    std::uint64_t token() const { return m_token; }
    const std::string& reason() const { return m_reason; }

private:
    std::uint64_t m_token = 0;
    std::string m_reason;
    std::vector<DeviceId> m_robots;
    std::set<DeviceId> m_mute;
    std::set<DeviceId> m_given;                 ///< of these, those that got it in their present session
    std::map<DeviceId, std::string> m_troubles; ///< why it did not leave when it was sent last
};

} // namespace liena::devices
