// Faults that are put into the simulated shell on purpose: the reference model must find each.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace liena::simulation {

enum class Mutant : std::uint8_t {
    None,
    NoEpochCheck,        ///< a command of an older epoch passes
    NoSequenceCheck,     ///< a command that came before passes
    NoAgeCheck,          ///< a command older than its max-age passes
    AutoResume,          ///< stand-by is left without a person
    SameEpoch,           ///< what is re-opened goes on in the epoch of before
    HeartbeatStateless,  ///< heartbeats always say Open
    LeaseNotCleared,     ///< the robot is not told that its session or the system's readiness ended
    QueueNotDropped,     ///< what was queued before a loss leaves after it
    OriginNotCompared,   ///< the origin in a header is believed
    ConfirmNotBound,     ///< a confirmation for an older incident re-opens
    SecondLegNotBound,   ///< any connection of the peer is taken as the session's lane 0
    LimitAfterAllocation ///< a partial message may grow beyond its definition
};

inline constexpr std::array mutants{Mutant::NoEpochCheck,    Mutant::NoSequenceCheck,   Mutant::NoAgeCheck,
                                    Mutant::AutoResume,      Mutant::SameEpoch,         Mutant::HeartbeatStateless,
                                    Mutant::LeaseNotCleared, Mutant::QueueNotDropped,   Mutant::OriginNotCompared,
                                    Mutant::ConfirmNotBound, Mutant::SecondLegNotBound, Mutant::LimitAfterAllocation};

constexpr std::string_view nameOf(Mutant mutant)
{
    constexpr std::array<std::string_view, 13> names{"none",
                                                     "no-epoch-check",
                                                     "no-sequence-check",
                                                     "no-age-check",
                                                     "auto-resume",
                                                     "same-epoch",
                                                     "heartbeat-stateless",
                                                     "lease-not-cleared",
                                                     "queue-not-dropped",
                                                     "origin-not-compared",
                                                     "confirm-not-bound",
                                                     "second-leg-not-bound",
                                                     "limit-after-allocation"};
    return names[static_cast<std::size_t>(mutant)];
}

} // namespace liena::simulation
