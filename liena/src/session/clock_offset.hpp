// The offset between a peer's clock and ours from heartbeat echoes (protocol section 9; RFC 5905 section 8).
#pragma once

#include "session/instant.hpp"

#include <array>
#include <cstddef>
#include <optional>

namespace liena::session {

/// Keeps a sliding window of 64 samples and believes the one of least delay. A sample that contradicts it shows that a clock was stepped:
/// then all before it are forgotten, and the offset is unknown again for 8 samples.
class ClockOffset {
public:
    /// t1 our send, t2 the peer's receipt, t3 the peer's send, t4 our receipt; each on the clock of its side.
    void add(Timestamp t1, Timestamp t2, Timestamp t3, Timestamp t4);

    void reset() { *this = ClockOffset(); }

    std::size_t samples() const { return m_count; }

    /// Peer's clock − ours; nothing before 8 samples.
    std::optional<Nanoseconds> offset() const;

    /// Half the least delay: the error of offset() is not larger.
    Nanoseconds uncertainty() const;

    /// Delay of the newest sample: the round trip without the peer's holding time.
    std::optional<Nanoseconds> lastDelay() const;

private:
    struct Sample {
        Nanoseconds offset{};
        Nanoseconds delay{};
    };
    const Sample* best() const;
    const Sample* leastDelayed() const { return &m_samples[m_best]; } ///< of at least one
    bool contradicts(const Sample& sample) const;

    static constexpr std::size_t window = 64;
    static constexpr std::size_t needed = 8;
    std::array<Sample, window> m_samples{};
    std::size_t m_count = 0; ///< at most `window`
    std::size_t m_next = 0;
    std::size_t m_best = 0; ///< asked for with each message, so it is kept
    std::optional<Nanoseconds> m_lastDelay;
};

} // namespace liena::session
