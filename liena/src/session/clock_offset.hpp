// The offset between a peer's clock and ours from heartbeat echoes (protocol section 9; RFC 5905 section 8).
#pragma once

#include "session/instant.hpp"

#include <array>
#include <cstddef>
#include <optional>

namespace liena::session {

/// A heartbeat of ours and the peer's that echoes it. Our times are monotonic: a clock of ours that is set says nothing about the way.
struct Exchange {
    Instant sent;      ///< t1, ours left
    Timestamp heardBy; ///< t2, the peer heard it, on its clock
    Timestamp answer;  ///< t3, the peer sent its own, on its clock
    Now heard;         ///< t4, that came

    /// The way there and back, without the peer's holding time; nothing when the peer's clock was stepped while it held.
    std::optional<Nanoseconds> delay() const;

    /// Peer's clock − ours as it is at t4, if both ways take the same time.
    Nanoseconds offset() const;
};

/// Keeps a sliding window of 64 samples and believes the one of least delay. A sample that contradicts it, or the newest, shows that a
/// clock was stepped: then all before it are forgotten, and the offset is unknown again for 8 samples.
class ClockOffset {
public:
    /// False when it shows that a clock was stepped.
    bool add(const Exchange& exchange);

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
        Instant taken;
    };
    const Sample* best() const;
    const Sample* leastDelayed() const { return &m_samples[m_best]; }                  ///< of at least one
    const Sample& newest() const { return m_samples[(m_next + window - 1) % window]; } ///< of at least one
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
