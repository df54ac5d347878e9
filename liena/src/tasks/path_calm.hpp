// How quiet a long path is by itself.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>

namespace liena::tasks {

/// Pure. Round trips of a long path vary without any queue, and nothing tells how much while bulk leaves as fast as the path carries it. So
/// after a queue was met bulk leaves clearly slower for a few verdicts, and how late acknowledgements come then is the path's own. Where
/// that is little the path is calm: a queue is told from it early, and what the path was seen to carry is believed. The latest of these
/// verdicts is left out, since a computer that stands still for a moment tells nothing of the path.
class PathCalm {
public:
    using Instant = std::chrono::steady_clock::time_point;
    using Nanoseconds = std::chrono::nanoseconds;

    static constexpr double slower = 0.85; ///< of the rate that met a queue, while it listens

    /// What is known is old, or nothing is.
    bool isDue(Instant now) const { return now >= m_next; }

    /// Bulk leaves slower from now on.
    void begin()
    {
        m_left = verdicts;
        m_overheard = 0;
        m_latest = m_latestButOne = {};
    }
    void stop() { m_left = 0; }
    bool listens() const { return m_left > 0; }

    enum class Heard : std::uint8_t {
        NotAll,
        Calm,
        Doubtful, ///< it may have been a queue that still stood: to be heard again, slower
        Unquiet,
    };

    /// So late acknowledgements came this time.
    Heard hear(Nanoseconds late, Instant now)
    {
        m_latestButOne = std::max(m_latestButOne, std::min(m_latest, late));
        m_latest = std::max(m_latest, late);
        if (--m_left > 0)
            return Heard::NotAll;
        m_heard = heardOf(m_latestButOne);
        const bool isFirst = m_pause == Nanoseconds::zero();
        m_unrest = m_heard <= most ? m_heard : usual;
        m_pause = isCalm() ? longest : std::clamp(m_pause * 2, shortest, longest);
        m_next = now + m_pause;
        if (isCalm())
            return Heard::Calm;
        return isFirst ? Heard::Doubtful : Heard::Unquiet;
    }

    /// So late acknowledgements came while bulk left as fast as it may, and met no queue: that tells of a calm path only.
    void overhear(Nanoseconds late)
    {
        m_latest = m_overheard == 0 ? late : std::max(m_latest, late);
        if (++m_overheard < verdicts)
            return;
        m_overheard = 0;
        if (const auto heard = heardOf(m_latest); heard <= most)
            m_unrest = heard;
    }

    /// By so much round trips vary, as far as it was heard; of a path that is not calm what is usual.
    Nanoseconds unrest() const { return m_unrest; }
    Nanoseconds heard() const { return m_heard; } ///< last, however much it was
    bool isCalm() const { return m_unrest < usual; }

private:
    static constexpr int verdicts = 6;
    static constexpr Nanoseconds usual = std::chrono::microseconds(500); ///< what is assumed of a path that was not heard
    static constexpr Nanoseconds most = std::chrono::microseconds(350);  ///< of a calm one, a quarter of what was heard included
    static constexpr Nanoseconds least = std::chrono::microseconds(50);
    static constexpr Nanoseconds longest = std::chrono::seconds(10);        ///< what was heard may have changed since
    static constexpr Nanoseconds shortest = std::chrono::milliseconds(500); ///< what was heard may have been left of a queue

    static Nanoseconds heardOf(Nanoseconds latest) { return std::max(latest * 5 / 4, least); }

    int m_left = 0;
    int m_overheard = 0;
    Nanoseconds m_latest{};
    Nanoseconds m_latestButOne{};
    Nanoseconds m_heard{};
    Nanoseconds m_unrest = usual;
    Nanoseconds m_pause{}; ///< until it is due again; 0: it was never heard
    Instant m_next{};
};

} // namespace liena::tasks
