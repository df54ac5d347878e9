// What a path did of late: implementation.
#include "tasks/path_memory.hpp"

#include <algorithm>
#include <utility>

namespace liena::tasks {

namespace {

constexpr std::chrono::seconds lately{3}; // in which a queue of ours has drained at least once
constexpr int roundTripsKept = 4;
constexpr std::chrono::milliseconds settles{300};            // of the smoothed round trip, after a queue
constexpr std::chrono::seconds doubt{20};                    // after a sign that was none
constexpr std::chrono::nanoseconds shortestPiece{1'000'000}; // that is told from what else makes round trips vary

constexpr std::chrono::seconds steadily{1};
constexpr std::chrono::milliseconds gone{50};
constexpr double shownFrom = 0.5; // of a piece's time
constexpr double healedBelow = 0.4;

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

void PathPieces::queued(Instant now) { m_settled = now + settles; }

bool PathPieces::note(Nanoseconds late, Nanoseconds piece, Instant now)
{
    if (piece < shortestPiece) {
        *this = {};
        return false;
    }
    if (now < m_settled)
        return false;
    const double pieces = static_cast<double>(late.count()) / static_cast<double>(piece.count());
    if (pieces > shownFrom) {
        if (!m_shownSince || std::exchange(m_goneSince, std::nullopt)) // it comes and goes
            begin(now);
        m_shown = m_shown || now - *m_shownSince >= steadily;
        return false;
    }
    if (pieces > healedBelow)
        return false;
    if (!m_shown) {
        m_shownSince.reset();
        return false;
    }
    if (!m_goneSince)
        m_goneSince = now;
    if (now - *m_goneSince < gone)
        return false;
    m_shown = false;
    m_shownSince.reset();
    m_goneSince.reset();
    if (now < m_believed)
        return false;
    m_believed = now + doubt;
    return true;
}

void PathPieces::begin(Instant now)
{
    m_shown = false;
    m_shownSince = now;
}

std::optional<RoundTripOfLate::Nanoseconds> RoundTripOfLate::note(Nanoseconds roundTrip, Instant now)
{
    if (now - m_begun > 2 * lately) { // nothing was sent: nothing is known
        m_begun = now;
        m_shortest = roundTrip;
        m_before.reset();
    } else if (now - m_begun > lately) {
        m_begun = now;
        m_before = std::exchange(m_shortest, roundTrip);
    }
    m_shortest = std::min(m_shortest, roundTrip);
    return m_before ? std::optional(std::min(*m_before, m_shortest)) : std::nullopt;
}

} // namespace liena::tasks
