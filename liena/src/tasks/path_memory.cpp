// What a path did of late: implementation.
#include "tasks/path_memory.hpp"

#include <algorithm>
#include <utility>

namespace liena::tasks {

namespace {

constexpr int roundTripsKept = 4;
constexpr std::chrono::seconds lately{3}; // in which a queue of ours has drained at least once

} // namespace

double PathCourse::rate(PathPoint beginning, PathPoint now, std::chrono::nanoseconds span)
{
    m_beginnings.note(beginning);
    auto since = m_beginnings.back(1);
    for (std::size_t steps = 2; steps <= m_beginnings.count() && now.at - since.at < span; ++steps)
        since = m_beginnings.back(steps);
    m_since = since.at;
    return static_cast<double>(now.bytes - since.bytes) / std::chrono::duration<double>(now.at - since.at).count();
}

void PathDepartures::note(PathPoint sent, std::chrono::nanoseconds roundTrip)
{
    constexpr auto ofEach = decltype(m_noted)::most / roundTripsKept;
    if (m_noted.count() == 0 || sent.at - m_noted.back(1).at >= roundTrip / static_cast<int>(ofEach))
        m_noted.note(sent);
}

std::optional<std::uint64_t> PathDepartures::until(Instant then) const
{
    for (std::size_t steps = 1; steps <= m_noted.count(); ++steps)
        if (m_noted.back(steps).at <= then)
            return m_noted.back(steps).bytes;
    return std::nullopt;
}

std::optional<double> PathDepartures::about(Instant then) const
{
    for (std::size_t steps = 1; steps <= m_noted.count(); ++steps) {
        const auto& before = m_noted.back(steps);
        if (before.at > then)
            continue;
        const auto bytes = static_cast<double>(before.bytes);
        if (steps == 1)
            return bytes;
        const auto& after = m_noted.back(steps - 1);
        const std::chrono::duration<double> gone = then - before.at;
        return bytes + static_cast<double>(after.bytes - before.bytes) * (gone / (after.at - before.at));
    }
    return std::nullopt;
}

SharedBytes::Bytes SharedBytes::note(Bytes own, std::size_t lanes)
{
    const auto sent = wholeOf(own.sent);
    m_acknowledged = std::max(m_acknowledged, wholeOf(own.acknowledged));
    if (lanes != back(1).lanes)
        m_changes[m_count++ % m_changes.size()] = {own.sent, sent, lanes};
    return {sent, m_acknowledged};
}

/// TCP counts its SYN among what is acknowledged: that may be more than was sent.
std::uint64_t SharedBytes::wholeOf(std::uint64_t own) const
{
    const auto known = std::min(m_count, m_changes.size());
    for (std::size_t steps = 1; steps <= known; ++steps)
        if (const auto& change = back(steps); own >= change.sent)
            return change.whole + (own - change.sent) * change.lanes;
    const auto& oldest = back(known);
    return oldest.whole - std::min(oldest.whole, oldest.sent - own);
}

std::optional<RoundTripOfLate::Nanoseconds> RoundTripOfLate::note(Nanoseconds roundTrip, Instant now)
{
    if (now - m_begun > 2 * lately) { // nothing was sent: what was looked at since may have been too little to know
        m_begun = now;
        if (m_before)
            m_before = std::min(*m_before, m_shortest);
        m_shortest = roundTrip;
    } else if (now - m_begun > lately) {
        m_begun = now;
        m_before = std::exchange(m_shortest, roundTrip);
    }
    m_shortest = std::min(m_shortest, roundTrip);
    if (m_proven && now < m_provenUntil)
        return m_proven = std::min(*m_proven, roundTrip);
    m_proven.reset();
    return m_before ? std::optional(std::min(*m_before, m_shortest)) : std::nullopt;
}

void RoundTripOfLate::prove(Nanoseconds roundTrip, Instant now)
{
    m_proven = roundTrip;
    m_provenUntil = now + 2 * lately;
}

StandingWait::Says StandingWait::look(const Seen& seen, Nanoseconds roundTrip)
{
    constexpr std::uint64_t enough = 32768; // bytes, to smooth a round trip anew
    constexpr std::uint64_t nearlyAll = 85; // of a hundred that were sent
    constexpr double much = 0.5;            // of what came
    constexpr double few = 8192;            // bytes, under way to the kernel
    if (!m_since)
        return Says::Nothing;
    if (std::chrono::abs(seen.waiting - m_since->waiting) > m_since->waiting / 8) {
        m_since.reset();
        return Says::Nothing;
    }
    const auto came = seen.bytesAcknowledged - m_since->bytesAcknowledged;
    const auto sent = seen.bytesSent - m_since->bytesSent;
    if (came * 100 < sent * nearlyAll)
        return Says::Nothing;
    const auto elapsed = seen.at - m_since->at;
    if (elapsed < m_since->waiting * 3 / 2 + roundTrip || came < enough) {
        // Else TCP may send as fast as the path carries, behind a full queue.
        const bool isLess = static_cast<double>(sent) < m_carried * much * std::chrono::duration<double>(elapsed).count() + few;
        return isLess ? Says::NotYet : Says::Nothing;
    }
    m_since.reset();
    return Says::OfThePath;
}

void UsualWait::note(Nanoseconds waiting, Instant now)
{
    constexpr std::chrono::milliseconds span{100};
    if (m_begun && now - *m_begun > span) {
        m_calmest = std::min(m_calmest.value_or(m_longest), m_longest);
        m_begun.reset();
    }
    if (!m_begun) {
        m_begun = now;
        m_longest = Nanoseconds::zero();
    }
    m_longest = std::max(m_longest, waiting);
}

} // namespace liena::tasks
