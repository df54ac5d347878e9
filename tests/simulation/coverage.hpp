// What must have happened at least once in a run of many seeds: transitions, and fault kinds in session states.
#pragma once

#include "scenario.hpp"

#include "liena/session_state.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace liena::simulation {

inline constexpr std::size_t sessionStates = 8;

class Coverage {
public:
    void transition(SessionState from, SessionState to) { ++m_transitions[static_cast<std::size_t>(from)][static_cast<std::size_t>(to)]; }
    void fault(FaultKind kind, SessionState state) { ++m_faults[static_cast<std::size_t>(kind)][static_cast<std::size_t>(state)]; }
    void add(const Coverage& other);

    /// Transitions of the session machine that can happen and did not; faults that never met a state.
    std::vector<std::string> missingTransitions() const;
    std::vector<std::string> missingFaults() const;

    /// Transitions that happened and that the machine's diagram does not have.
    std::vector<std::string> unknownTransitions() const;

    std::string table() const;

private:
    std::array<std::array<std::uint64_t, sessionStates>, sessionStates> m_transitions{};
    std::array<std::array<std::uint64_t, sessionStates>, faultKinds> m_faults{};
};

} // namespace liena::simulation
