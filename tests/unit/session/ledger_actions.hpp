// Four devices and what a ledger of incidents wants done, sorted by kind, for the tests of it.
#pragma once

#include "session/stand_by_ledger.hpp"

#include <optional>
#include <utility>
#include <variant>
#include <vector>

namespace liena::test {

inline constexpr DeviceId robot(0x00008208U);
inline constexpr DeviceId xray(0x20010208U);
inline constexpr DeviceId cockpit(0x40018208U);
inline constexpr DeviceId arm(0x60008208U);
inline constexpr session::Now now{session::Instant(std::chrono::hours(1)), Timestamp{5000}};

template <typename T>
std::vector<T> all(const session::LedgerActions& actions)
{
    std::vector<T> found;
    for (const auto& action : actions)
        if (const auto* one = std::get_if<T>(&action))
            found.push_back(*one);
    return found;
}

inline std::vector<SessionEvent::Kind> told(const session::LedgerActions& actions)
{
    std::vector<SessionEvent::Kind> kinds;
    for (const auto& tell : all<session::Tell>(actions))
        kinds.push_back(tell.event.kind);
    return kinds;
}

/// The broadcasts of message type T, each with the neighbour that is left out.
template <typename T>
std::vector<std::pair<T, std::optional<DeviceId>>> broadcasts(const session::LedgerActions& actions)
{
    std::vector<std::pair<T, std::optional<DeviceId>>> found;
    for (const auto& broadcast : all<session::Broadcast>(actions))
        if (const auto* message = std::get_if<T>(&broadcast.message))
            found.emplace_back(*message, broadcast.except);
    return found;
}

template <typename T>
std::vector<T> answers(const session::LedgerActions& actions, DeviceId to)
{
    std::vector<T> found;
    for (const auto& answer : all<session::Answer>(actions))
        if (const auto* message = std::get_if<T>(&answer.message); message != nullptr && answer.to == to)
            found.push_back(*message);
    return found;
}

/// As the end with the higher id says it.
inline protocol::StandBy standBy(IncidentId id, DeviceId a, DeviceId b, std::uint64_t since = 100)
{
    return {id, a, b, LossCause::HeartbeatLost, since, b};
}

} // namespace liena::test
