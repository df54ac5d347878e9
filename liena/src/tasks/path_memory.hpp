// What a path did of late, as PathRate looks back on it.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace liena::tasks {

struct PathPoint {
    std::chrono::steady_clock::time_point at;
    std::uint64_t bytes = 0; ///< until then
};

/// Pure. The last points that were noted.
template <std::size_t Most>
class PathPoints {
public:
    static constexpr std::size_t most = Most;

    void forget() { m_count = 0; }
    void note(PathPoint point) { m_noted[m_count++ % Most] = point; }
    std::size_t count() const { return m_count < Most ? m_count : Most; }

    /// 1: the newest; at most count().
    const PathPoint& back(std::size_t steps) const { return m_noted[(m_count - steps) % Most]; }

private:
    std::array<PathPoint, Most> m_noted;
    std::size_t m_count = 0; ///< so many were noted
};

/// Pure. How acknowledgements came.
class PathCourse {
public:
    using Instant = std::chrono::steady_clock::time_point;

    void forget() { m_beginnings.forget(); }

    /// Bytes per second of what came until `now`, since the newest beginning that is at least `span` ago, or else since the oldest that is
    /// known. `beginning`: a new one, before now.
    double rate(PathPoint beginning, PathPoint now, std::chrono::nanoseconds span);
    Instant since() const { return m_since; } ///< of what was counted for it

private:
    PathPoints<32> m_beginnings;
    Instant m_since{};
};

/// Pure. What had been sent when, over the last four round trips.
class PathDepartures {
public:
    using Instant = std::chrono::steady_clock::time_point;

    void note(PathPoint sent, std::chrono::nanoseconds roundTrip);

    /// No more than what had been sent by then; nothing when that is not known.
    std::optional<std::uint64_t> until(Instant then) const;

    /// What had been sent by then, as if it had left evenly between two points; nothing when that is not known.
    std::optional<double> about(Instant then) const;

private:
    PathPoints<128> m_noted;
};

/// Pure. A lane's bytes as those of its whole session, whose lanes share the path: what left while so many were in a burst counts as often.
/// Of a lane alone it is what it is.
class SharedBytes {
public:
    struct Bytes {
        std::uint64_t sent = 0;
        std::uint64_t acknowledged = 0;
    };

    /// Until now, of this connection. What leaves from now on does so while `lanes` are in a burst.
    Bytes note(Bytes own, std::size_t lanes);

private:
    struct Change {
        std::uint64_t sent = 0;  ///< of the lane, until then
        std::uint64_t whole = 0; ///< of the session, until then
        std::uint64_t lanes = 1; ///< from then on
    };

    std::uint64_t wholeOf(std::uint64_t own) const;
    const Change& back(std::size_t steps) const { return m_changes[(m_count - steps) % m_changes.size()]; }

    std::array<Change, 128> m_changes{};
    std::size_t m_count = 1;          ///< so many were noted; the first is the beginning
    std::uint64_t m_acknowledged = 0; ///< of the session
};

/// Pure. The shortest round trip of late, for a path that has become longer: the kernel remembers its shortest for minutes.
class RoundTripOfLate {
public:
    using Instant = std::chrono::steady_clock::time_point;
    using Nanoseconds = std::chrono::nanoseconds;

    /// Of those noted within the last three to six seconds, in which a queue of ours has drained at least once; nothing until so long was
    /// looked at, but for what was proven.
    std::optional<Nanoseconds> note(Nanoseconds roundTrip, Instant now);

    /// A queue of ours would have drained: until that long is over this is the path's.
    void prove(Nanoseconds roundTrip, Instant now);
    bool isProven() const { return m_proven.has_value(); }

private:
    Instant m_begun{};
    Nanoseconds m_shortest = Nanoseconds::max();
    std::optional<Nanoseconds> m_before; ///< of the span before
    std::optional<Nanoseconds> m_proven;
    Instant m_provenUntil{};
};

/// Pure. Whether that acknowledgements are late is a queue of ours: it becomes shorter once less is sent.
class StandingWait {
public:
    using Instant = std::chrono::steady_clock::time_point;
    using Nanoseconds = std::chrono::nanoseconds;

    struct Seen {
        Instant at;
        Nanoseconds waiting{};
        std::uint64_t bytesSent = 0;
        std::uint64_t bytesAcknowledged = 0;
    };

    /// From now on so little is sent that it drains; what came until then, in bytes per second.
    void yielded(const Seen& seen, double carried)
    {
        if (m_since)
            return;
        m_since = seen;
        m_carried = carried;
    }

    enum class Says : std::uint8_t {
        Nothing,
        NotYet,    ///< it is as late as before, while much less leaves and all of it comes: whether it drains is still to be seen
        OfThePath, ///< it would have drained
    };
    Says look(const Seen& seen, Nanoseconds roundTrip);
    void forget() { m_since.reset(); }

private:
    std::optional<Seen> m_since;
    double m_carried = 0;
};

/// Pure. How late acknowledgements come while no queue of ours stands: on a narrow line by what a piece takes to pass it, behind a token
/// bucket by next to nothing.
class UsualWait {
public:
    using Instant = std::chrono::steady_clock::time_point;
    using Nanoseconds = std::chrono::nanoseconds;

    void note(Nanoseconds waiting, Instant now);
    void forget() { *this = {}; }

    /// The longest in the calmest tenth of a second; nothing until one was looked at.
    std::optional<Nanoseconds> calmest() const { return m_calmest; }

private:
    std::optional<Instant> m_begun;
    Nanoseconds m_longest{}; ///< since then
    std::optional<Nanoseconds> m_calmest;
};

} // namespace liena::tasks
