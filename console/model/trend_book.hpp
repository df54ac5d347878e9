// The course of the figures that a surgeon watches, over the last minute and the last ten.
#pragma once

#include "model/instant.hpp"

#include <QtGlobal>

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>

namespace console {

enum class TrendFigure : std::uint8_t {
    RoundTrip,  ///< ms, of the robot's link
    Jitter,     ///< ms, of the robot's link
    Loss,       ///< percent of the robot's heartbeats in the last second
    Force,      ///< N, magnitude on the guidewire
    PictureAge, ///< ms, of the newest painted picture
};
inline constexpr std::size_t trendFigures = 5;

enum class TrendSpan : std::uint8_t { Minute, TenMinutes };
constexpr std::chrono::seconds length(TrendSpan span)
{
    return span == TrendSpan::Minute ? std::chrono::seconds(60) : std::chrono::seconds(600);
}

/// What a figure did in one slot of time: a short peak is kept however long the slot is.
struct TrendSlot {
    Instant begin;
    std::optional<double> least; ///< nothing: it was not known at any moment of the slot
    std::optional<double> most;
};

/// What is known at one moment; what is not known, or not fresh, is nothing.
struct TrendReading {
    std::optional<double> roundTripMs;
    std::optional<double> jitterMs;
    std::optional<quint64> heartbeatsReceived; ///< of the robot, counted since the console began
    quint64 heartbeatsMissed = 0;
    std::optional<double> force;
    std::optional<double> pictureAgeMs;
};

/// GUI thread only. Six hundred slots for each figure and span, whatever happens.
class TrendBook {
public:
    static constexpr std::size_t mostSlots = 600;

    /// Several times a second; readings of one slot are put together.
    void note(const TrendReading& reading, Instant now);

    /// Oldest first; gaps in which nobody noted anything have no slots.
    const std::deque<TrendSlot>& slots(TrendFigure figure, TrendSpan span) const;

    /// By nearest rank of what the slots had at most: in a minute that is each reading, in ten minutes the largest of each second.
    struct Summary {
        double p50 = 0;
        double p99 = 0;
    };
    std::optional<Summary> summary(TrendFigure figure, TrendSpan span) const;

    /// The newest value; nothing when it is not known now.
    std::optional<double> latest(TrendFigure figure) const { return m_latest.at(static_cast<std::size_t>(figure)); }

    /// The largest of the last second, for what rises and falls with each picture: one moment of it says little. Nothing when the newest
    /// value is not known.
    std::optional<double> mostOfSecond(TrendFigure figure) const;

private:
    struct Counted {
        Instant at;
        quint64 received = 0;
        quint64 missed = 0;
    };

    void add(TrendFigure figure, std::optional<double> value, Instant now);
    std::optional<double> lossOf(const TrendReading& reading, Instant now);

    std::array<std::array<std::deque<TrendSlot>, 2>, trendFigures> m_slots;
    std::array<std::optional<double>, trendFigures> m_latest;
    std::optional<Counted> m_counted; ///< at the begin of the present second
    std::optional<double> m_loss;     ///< of the second before
};

} // namespace console
