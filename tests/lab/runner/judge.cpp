// What must hold whatever fails: implementation.
#include "runner/judge.hpp"

#include <algorithm>
#include <cstdio>

namespace liena::lab {

namespace {

constexpr std::int64_t maxAge = 50'000'000; // MotionCommand in the robot's message set
constexpr std::int64_t lease = 50'000'000;  // of the drive gate
constexpr std::size_t mostFindings = 20;
constexpr Milliseconds drain{30};

std::pair<std::string, std::string> pairOf(const std::string& a, const std::string& b) { return a < b ? std::pair{a, b} : std::pair{b, a}; }

bool isOpen(const std::string& state) { return state == "open" || state == "suspect"; }

} // namespace

void Tally::add(const Tally& other)
{
    applied += other.applied;
    stale += other.stale;
    repeated += other.repeated;
    notOpen += other.notOpen;
    unknown += other.unknown;
    unbidden += other.unbidden;
    torn += other.torn;
    oldest = std::max(oldest, other.oldest);
}

void Judge::Pass::find(std::uint64_t& count, const RigDevice& device, const Record& record, const std::string& what)
{
    ++count;
    if (findings->size() == mostFindings)
        return;
    std::string line = device.name + " at " + std::to_string(record.at) + ": " + what + " (";
    for (const auto& word : record.words)
        line += word + " ";
    line.back() = ')';
    findings->push_back(line);
}

Tally Judge::judge(std::vector<std::string>& findings)
{
    m_rig.settle(drain); // what one device heard, another has told before
    Pass pass{{}, &findings};
    for (const auto& device : m_rig.devices())
        gather(*device);
    for (const auto& device : m_rig.devices())
        for (const auto& record : device->records)
            judgeRecord(*device, record, pass);
    m_rig.forget();
    if (!m_sent.empty()) { // what is more than one repetition old has been judged
        const auto limit = nowNs() - std::int64_t{60'000'000'000};
        std::erase_if(m_sent, [&](const auto& sent) { return sent.second < limit; });
    }
    return pass.tally;
}

void Judge::gather(const RigDevice& device)
{
    for (const auto& record : device.records) {
        if (record.kind() == "sent")
            m_sent[{record.number(1), record.number(2)}] = record.at;
        else if (record.kind() == "person" && (record.word(1) == "open" || record.word(1) == "reopen"))
            ++m_asked[pairOf(device.name, record.word(2))];
        else if (record.kind() == "obeyed" && record.word(1) == "arm")
            ++m_arms[record.word(2)];
    }
}

void Judge::judgeRecord(const RigDevice& device, const Record& record, Pass& pass)
{
    const auto& kind = record.kind();
    Robot& robot = m_robots[device.name];
    if (kind == "started") {
        robot = {};
        return;
    }
    if (kind == "state")
        judgeState(device, record, pass);
    else if (kind == "picture" && record.word(2) != "whole")
        pass.find(pass.tally.torn, device, record, "a picture arrived with wrong bytes");
    else if (kind == "applied")
        judgeApplied(robot, device, record, pass);
    else
        judgeRobot(robot, device, record, pass);
}

void Judge::judgeState(const RigDevice& device, const Record& record, Pass& pass)
{
    const auto& peer = record.word(1);
    const auto& from = record.word(2);
    const auto& to = record.word(3);
    Robot& robot = m_robots[device.name];
    robot.sessions[peer] = to;
    if (!isOpen(to) && peer == "cockpit")
        robot.armed = false;
    if (from == "stand-by" && isOpen(to))
        pass.find(pass.tally.unbidden, device, record, "a session left stand-by by itself");
    if (isOpen(to) && (from == "opening" || from == "re-opening") && ++m_opened[{device.name, peer}] > m_asked[pairOf(device.name, peer)])
        pass.find(pass.tally.unbidden, device, record, "a session opened that no person asked for");
}

void Judge::judgeApplied(Robot& robot, const RigDevice& device, const Record& record, Pass& pass)
{
    ++pass.tally.applied;
    const Command command{record.number(1), record.number(2)};
    const auto arrival = static_cast<std::int64_t>(record.number(3));
    if (robot.anyApplied && command.first == robot.lastPermit && command.second <= robot.lastSequence)
        pass.find(pass.tally.repeated, device, record, "a command was applied twice or out of order");
    robot.anyApplied = true;
    robot.lastPermit = command.first;
    robot.lastSequence = command.second;
    if (!isOpen(robot.sessions["cockpit"]))
        pass.find(pass.tally.notOpen, device, record, "a command was applied while the session was not open");
    const auto sent = m_sent.find(command);
    if (sent == m_sent.end())
        return pass.find(pass.tally.unknown, device, record, "a command was applied that no cockpit sent");
    const auto age = record.at - sent->second;
    pass.tally.oldest = std::max(pass.tally.oldest, static_cast<double>(age) / 1e6);
    if (arrival - sent->second > maxAge || age > maxAge + lease)
        pass.find(pass.tally.stale, device, record, "a command of " + std::to_string(age / 1000) + " us was applied");
}

void Judge::judgeRobot(Robot& robot, const RigDevice& device, const Record& record, Pass& pass)
{
    const auto& kind = record.kind();
    const auto& what = record.word(1);
    const bool ends = kind == "event" && (what == "interrupted" || what == "stand-by-began" || what == "local-stall");
    if (ends || (kind == "robot" && what == "Hold"))
        robot.armed = false;
    if (kind == "robot" && what == "Armed") {
        // Armed follows Engaged too, when the dead-man is lifted: only the way from Ready is an arming.
        if (!robot.armed && ++m_armed[device.name] > m_arms[device.name])
            pass.find(pass.tally.unbidden, device, record, "the robot armed and no person asked for it");
        robot.armed = true;
    }
    if (kind == "moves" && !robot.armed)
        pass.find(pass.tally.unbidden, device, record, "the drives began to move without having been armed anew");
}

bool concludes(const Tally& tally, const std::vector<std::string>& findings)
{
    for (const auto& finding : findings)
        std::printf("    BROKEN: %s\n", finding.c_str());
    std::fflush(stdout);
    return findings.empty() && tally.broken() == 0;
}

} // namespace liena::lab
