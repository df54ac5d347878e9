// Whether a line's jitter or loss is above its limit, and its packets pass, told so that it does not chatter.
#pragma once

#include "model/instant.hpp"
#include "model/link_figures.hpp"
#include "model/profile_limits.hpp"

#include <chrono>
#include <deque>
#include <optional>

namespace console {

/// One per link. Pure but for what it remembers: the last ten seconds, and no more than `mostMarks` entries.
class LineQuality {
public:
    static constexpr std::chrono::seconds lossSpan{10};
    static constexpr std::chrono::seconds leastSpan{5}; ///< before that much is counted, loss is not judged
    static constexpr std::chrono::seconds raiseAfter{2};
    static constexpr std::chrono::seconds clearAfter{5};
    static constexpr std::size_t mostMarks = 200;

    /// While the link is up, with its figures of now.
    void note(const LinkFigures& figures, const LineLimits& limits, Instant now);

    /// The link is down: what was measured belongs to the session that ended.
    void forget() { *this = {}; }

    bool jittery() const { return m_jitter.above; }
    bool lossy() const { return m_loss.above; }

    /// They passed in this session, and do so no more: what went two ways goes one.
    bool packetsLost() const { return m_packets.above; }

    /// Of the last ten seconds; nothing before enough was counted.
    std::optional<double> lossPercent() const;

private:
    /// Above since a while, or good since a while; what lies between changes nothing.
    struct Threshold {
        bool above = false;
        std::optional<Instant> since; ///< the other judgement holds since then

        void judge(std::optional<double> value, double bad, double good, Instant now);
    };
    struct Mark {
        Instant at;
        quint64 received = 0;
        quint64 missed = 0;
    };

    Threshold m_jitter;
    Threshold m_loss;
    Threshold m_packets;
    bool m_packetsPassed = false;
    std::deque<Mark> m_marks;
};

} // namespace console
