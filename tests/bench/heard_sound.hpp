// What one output of a sound server plays, block by block as it comes, and when the alarm began to sound in it.
#pragma once

#include "model/instant.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace console::test {

struct Onsets {
    std::optional<Instant> first; ///< sample above noise, of whatever sounds
    std::optional<Instant> high;  ///< sample above noise of a burst of high priority, which is told from the others by its pitch
};

/// Samples of one channel at 44.1 kHz, on no thread of its own. A sample has the time at which its block had come, and the server had mixed
/// it before: it sounded at that time at the latest.
class HeardSound {
public:
    void add(std::span<const std::int16_t> block, Instant arrived);

    /// What sounded so far is no onset any more. The silence goes on.
    void forget();

    const Onsets& onsets() const { return m_onsets; }
    Duration silence() const; ///< in samples since the last one above noise

private:
    struct Block {
        std::size_t end = 0; ///< place after its last sample
        Instant arrived;
    };

    void lookForHigh();
    Instant timeOf(std::size_t place) const;

    std::vector<std::int16_t> m_samples; ///< since forget()
    std::vector<Block> m_blocks;
    std::size_t m_looked = 0; ///< place of the next window
    std::size_t m_quiet = 0;  ///< samples
    Onsets m_onsets;
};

} // namespace console::test
