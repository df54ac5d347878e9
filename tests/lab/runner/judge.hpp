// What must hold whatever fails: held against the logs of all devices, not against what a device believes of itself.
#pragma once

#include "runner/rig.hpp"

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace liena::lab {

/// Counted since the lab began.
struct Tally {
    std::uint64_t applied = 0;  ///< commands that the drive gate took
    std::uint64_t stale = 0;    ///< older than `max-age` when they arrived, or than that and the lease when they were applied
    std::uint64_t repeated = 0; ///< twice or out of order under one permit
    std::uint64_t notOpen = 0;  ///< while the robot's session with the cockpit was not open
    std::uint64_t unknown = 0;  ///< that no cockpit sent
    std::uint64_t unbidden = 0; ///< motion, arming or opening that no person asked for
    std::uint64_t torn = 0;     ///< pictures with a wrong byte
    double oldest = 0;          ///< ms, from the cockpit's composing to the drives, of commands applied
    std::uint64_t broken() const { return stale + repeated + notOpen + unknown + unbidden + torn; }
    void add(const Tally& other);
};

/// Prints the findings; true when there are none and nothing was broken.
bool concludes(const Tally& tally, const std::vector<std::string>& findings);

/// Reads the records of a rig in order, each once.
class Judge {
public:
    explicit Judge(Rig& rig) : m_rig(rig) {}

    /// Judges what was told since the last call, and has the rig forget it. `findings` gets a line for each rule that was broken.
    Tally judge(std::vector<std::string>& findings);

private:
    using Command = std::pair<std::uint64_t, std::uint64_t>; ///< permit, sequence
    struct Robot {
        bool armed = false;
        std::uint64_t lastPermit = 0;
        std::uint64_t lastSequence = 0;
        bool anyApplied = false;
        std::map<std::string, std::string> sessions;
    };
    struct Pass {
        Tally tally;
        std::vector<std::string>* findings = nullptr;
        void find(std::uint64_t& count, const RigDevice& device, const Record& record, const std::string& what);
    };

    void gather(const RigDevice& device);
    void judgeRecord(const RigDevice& device, const Record& record, Pass& pass);
    void judgeState(const RigDevice& device, const Record& record, Pass& pass);
    void judgeApplied(Robot& robot, const RigDevice& device, const Record& record, Pass& pass);
    void judgeRobot(Robot& robot, const RigDevice& device, const Record& record, Pass& pass);

    Rig& m_rig;
    std::map<Command, std::int64_t> m_sent;
    std::map<std::pair<std::string, std::string>, std::uint64_t> m_asked;  ///< openings that persons asked for, by pair
    std::map<std::pair<std::string, std::string>, std::uint64_t> m_opened; ///< by device and peer
    std::map<std::string, std::uint64_t> m_arms;                           ///< that persons asked for, by robot
    std::map<std::string, std::uint64_t> m_armed;
    std::map<std::string, Robot> m_robots;
};

} // namespace liena::lab
