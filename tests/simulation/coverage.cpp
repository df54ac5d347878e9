// The expected transitions, and the tables.
#include "coverage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace liena::simulation {

namespace {

using S = SessionState;

std::string_view stateName(std::size_t state) { return toString(static_cast<S>(state)); }

constexpr std::array possible{
    std::pair(S::Closed, S::Opening),       std::pair(S::Closed, S::Reopening),     std::pair(S::Closed, S::StandBy),
    std::pair(S::Opening, S::Open),         std::pair(S::Opening, S::Closed),       std::pair(S::Opening, S::StandBy),
    std::pair(S::Opening, S::Reopening),    std::pair(S::Reopening, S::Open),       std::pair(S::Reopening, S::StandBy),
    std::pair(S::Reopening, S::Closed),     std::pair(S::Open, S::Suspect),         std::pair(S::Open, S::Reconnecting),
    std::pair(S::Open, S::StandBy),         std::pair(S::Open, S::Closing),         std::pair(S::Suspect, S::Open),
    std::pair(S::Suspect, S::Reconnecting), std::pair(S::Suspect, S::StandBy),      std::pair(S::Suspect, S::Closing),
    std::pair(S::Reconnecting, S::Open),    std::pair(S::Reconnecting, S::StandBy), std::pair(S::Reconnecting, S::Closing),
    std::pair(S::StandBy, S::Reopening),    std::pair(S::StandBy, S::Closed),       std::pair(S::Closing, S::Closed),
    std::pair(S::Closing, S::StandBy),      std::pair(S::Reopening, S::Opening)};

bool isPossible(std::size_t from, std::size_t to)
{
    return std::find(possible.begin(), possible.end(), std::pair(static_cast<S>(from), static_cast<S>(to))) != possible.end();
}

} // namespace

void Coverage::add(const Coverage& other)
{
    for (std::size_t from = 0; from < sessionStates; ++from)
        for (std::size_t to = 0; to < sessionStates; ++to)
            m_transitions[from][to] += other.m_transitions[from][to];
    for (std::size_t kind = 0; kind < faultKinds; ++kind)
        for (std::size_t state = 0; state < sessionStates; ++state)
            m_faults[kind][state] += other.m_faults[kind][state];
}

std::vector<std::string> Coverage::missingTransitions() const
{
    std::vector<std::string> missing;
    for (const auto& [from, to] : possible)
        if (m_transitions[static_cast<std::size_t>(from)][static_cast<std::size_t>(to)] == 0)
            missing.push_back(fmt::format("{} -> {}", toString(from), toString(to)));
    return missing;
}

std::vector<std::string> Coverage::unknownTransitions() const
{
    std::vector<std::string> unknown;
    for (std::size_t from = 0; from < sessionStates; ++from)
        for (std::size_t to = 0; to < sessionStates; ++to)
            if (m_transitions[from][to] != 0 && !isPossible(from, to))
                unknown.push_back(fmt::format("{} -> {}", stateName(from), stateName(to)));
    return unknown;
}

std::vector<std::string> Coverage::missingFaults() const
{
    std::vector<std::string> missing;
    for (std::size_t kind = 0; kind < faultKinds; ++kind)
        for (std::size_t state = 0; state < sessionStates; ++state)
            if (m_faults[kind][state] == 0)
                missing.push_back(fmt::format("{} in {}", nameOf(static_cast<FaultKind>(kind)), stateName(state)));
    return missing;
}

std::string Coverage::table() const
{
    std::string text = fmt::format("{:<18}", "from \\ to");
    for (std::size_t state = 0; state < sessionStates; ++state)
        text += fmt::format("{:>13}", stateName(state));
    for (std::size_t from = 0; from < sessionStates; ++from) {
        text += fmt::format("\n{:<18}", stateName(from));
        for (std::size_t to = 0; to < sessionStates; ++to)
            text += isPossible(from, to) || m_transitions[from][to] != 0 ? fmt::format("{:>13}", m_transitions[from][to])
                                                                         : fmt::format("{:>13}", "");
    }
    text += fmt::format("\n\n{:<18}", "fault \\ in state");
    for (std::size_t state = 0; state < sessionStates; ++state)
        text += fmt::format("{:>13}", stateName(state));
    for (std::size_t kind = 0; kind < faultKinds; ++kind) {
        text += fmt::format("\n{:<18}", nameOf(static_cast<FaultKind>(kind)));
        for (const auto count : m_faults[kind])
            text += fmt::format("{:>13}", count);
    }
    return text + "\n";
}

} // namespace liena::simulation
