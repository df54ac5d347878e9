// What the three patient-side devices share: their links, the words of the person beside them, and the log.
#pragma once

#include "link_keeper.hpp"
#include "person_commands.hpp"
#include "unheard_stop.hpp"

#include "liena/distributed_system.hpp"

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace liena::devices {

/// Made before the system starts, outlives its run; everything but obey() is on the network thread.
class PatientSide {
public:
    /// Of a device that is armed.
    struct Arming {
        std::function<void(bool given)> clearance; ///< what `clear` and `wait` do
        std::function<std::string()> status;       ///< a line for `status`
    };

    /// `emergencyStop`: what `stop` typed here does.
    PatientSide(DistributedSystem& system, LogSink log, std::vector<DeviceId> keptOpen, std::function<void(std::string_view)> emergencyStop,
                Arming arming = {});

    /// Any thread: a line typed by the person.
    void obey(std::string_view line);

    void log(LogLevel level, std::string_view text) const { m_log(level, text); }
    std::string nameOf(DeviceId device) const;

    /// Devices linked to this one that are of a class.
    static std::vector<DeviceId> linked(const DistributedSystem& system, DeviceClass deviceClass);

    /// Sends EmergencyStop to every linked hand, again each 100 ms until that names it, also over a session that is opened later: the arm
    /// and the X-ray system stop the robot so. Where the topology lets none of its reports come here, once in each session.
    void stopRobots(std::string_view reason);

private:
    void carryOut(const PersonCommand& command);
    void carryOutOn(const PersonCommand& command, DeviceId peer);
    void dismiss(const PersonCommand& command);
    void tellStatus() const;
    void tellEvent(const SessionEvent& event);
    void keepLinks();
    void sendStop();
    void complain(const Result<void>& result) const;

    DistributedSystem& m_system;
    LogSink m_log;
    LinkKeeper m_keeper;
    std::function<void(std::string_view)> m_emergencyStop;
    Arming m_arming;
    UnheardStop m_stop;
    bool m_hearsRobots = false;                 ///< their reports are known here; the flows of a link may keep them away all the same
    std::map<DeviceId, std::string> m_failures; ///< what was last said of an opening that failed: it is tried every second
};

/// Turns the events of the library into one line for a log; empty for those that need none.
std::string describe(const SessionEvent& event, const SystemTopology& topology);

} // namespace liena::devices
