// Whether the narrowest place of a path has become wider.
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <optional>

namespace liena::tasks {

/// Pure. Where a path is slow, what is sent in one piece is late by what the narrowest place takes for it, however little is sent (the
/// dispersion of a packet pair: Keshav, A control-theoretic approach to flow control, SIGCOMM 1991). When that is over the path carries
/// more than before, which is known long before anybody sends more. Before a token bucket a piece passes at once, as a rule: there it was
/// never late, and tells nothing.
class PieceWait {
public:
    using Instant = std::chrono::steady_clock::time_point;
    using Nanoseconds = std::chrono::nanoseconds;

    void forget() { *this = {}; }

    /// Without a queue a piece waited for so long, and takes `own` at the rate that the path is known to carry. True: all of the last
    /// second were late by a quarter of that, and the last three by less than half of it. What was before is forgotten then.
    bool isOver(Nanoseconds waiting, Nanoseconds own, Instant now)
    {
        if (m_least[0] && m_least[1]) {
            const auto least = std::min(*m_least[0], *m_least[1]);
            if (least > own / 4 && waiting < least / 2) {
                m_less = std::max(m_less, waiting);
                if (++m_times < enough)
                    return false;
                forget();
                return true;
            }
        }
        // So short a while was chance.
        note(m_times > 0 ? std::min(waiting, m_less) : waiting, now);
        m_times = 0;
        m_less = Nanoseconds::zero();
        return false;
    }

private:
    void note(Nanoseconds waiting, Instant now)
    {
        constexpr std::chrono::milliseconds span{500};
        if (m_begun && now - *m_begun > span) {
            m_least = {m_present, m_least[0]};
            m_begun.reset();
        }
        if (!m_begun) {
            m_begun = now;
            m_present = waiting;
        }
        m_present = std::min(m_present, waiting);
    }

    static constexpr int enough = 3;

    std::array<std::optional<Nanoseconds>, 2> m_least; ///< of the last two spans that are over
    std::optional<Instant> m_begun;                    ///< the span of now
    Nanoseconds m_present{};                           ///< the least since then
    int m_times = 0;                                   ///< in a row so much less
    Nanoseconds m_less{};                              ///< the longest of these
};

} // namespace liena::tasks
