// Where a picture's age comes from: each stage between the pulse and the screen, over the last minute.
#pragma once

#include "model/instant.hpp"

#include <QString>

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>

namespace console {

/// In the order in which a picture goes through them; together they are its age when it is painted.
enum class PictureStage : std::uint8_t {
    Sending,     ///< at the X-ray system: from the pulse's end to the sending, reading out and encoding
    Way,         ///< from the sending to the last byte here: NET
    Waiting,     ///< for the decoder and for the screen
    Decoding,    ///< to stored values
    Filters,     ///< noise reduction and edges
    Window,      ///< window, grey scale and shutter
    FilterDelay, ///< how much later the temporal filter shows what moves
};
inline constexpr std::size_t pictureStageCount = 7;

/// `before sending`, `way to here`, `waiting`, `decoding`, …
QString word(PictureStage stage);

/// What one painted picture spent in each.
using StageShares = std::array<Duration, pictureStageCount>;

/// GUI thread only. As many as are painted in a minute, and never more than `mostPictures`.
class PictureStages {
public:
    static constexpr std::chrono::seconds span{60};
    static constexpr std::size_t mostPictures = 3600;

    struct Summary {
        double p50 = 0; ///< ms
        double p99 = 0;
    };

    void note(const StageShares& shares, Instant painted);

    /// Of the picture that was noted last: what passed after its paint until the window was handed over. What the screen itself takes, no
    /// program can measure.
    void notePresented(Duration presenting);

    /// By nearest rank; nothing when no picture was painted in the last minute.
    std::optional<Summary> of(PictureStage stage, Instant now) const;

    /// Of the age at the paint, which is the sum.
    std::optional<Summary> ofAge(Instant now) const;

    /// Comes on top of the age at the paint.
    std::optional<Summary> ofPresenting(Instant now) const;

private:
    struct Painted {
        Instant at;
        StageShares shares;
        std::optional<Duration> presenting;
    };

    template <typename Value>
    std::optional<Summary> summary(Instant now, Value value) const;

    std::deque<Painted> m_painted;
};

} // namespace console
