// Where the table stood in a picture, and since when.
#pragma once

#include "model/instant.hpp"

#include <array>
#include <cstddef>
#include <deque>
#include <optional>

namespace console {

/// mm. From one place to the other; the same where the table rested.
struct TableWay {
    std::array<double, 3> from{};
    std::array<double, 3> to{};
};

/// From the X-ray system's reports: pictures do not say where the table was. A movement lies somewhere between the last report of before
/// it and the first one after it, and what falls between the two counts for neither place. GUI thread only.
class TableRest {
public:
    static constexpr std::size_t movementsKept = 64;
    static constexpr std::chrono::milliseconds slack{500}; ///< for so long a report stands for the table

    /// mm, as the X-ray system reported it.
    void note(const std::array<double, 3>& table, Instant at);

    /// What was taken from then on, and not after a picture that arrived at `arrival`, shows the patient where that picture does.
    /// Instant::max() when nothing but itself does for certain; nothing before a report has come after that picture: until then the table
    /// may have moved.
    std::optional<Instant> since(Instant arrival) const;

    /// Where the table was in a picture that was taken at `taken` at the earliest and was here at `arrival`, within 0.1 mm; where it was on
    /// its way in between, both ends. What is later than the last report is taken for there, and what is earlier than the first one for
    /// where that found the table. No numbers for what is older than the movements that are kept; nothing without a report.
    std::optional<TableWay> wayOf(Instant taken, Instant arrival) const;

    /// Whether reports reach from `taken` to `arrival`, but for `slack` at either end: then wayOf() is no guess there. In a longer gap
    /// between two reports the table may have gone and come back.
    bool spans(Instant taken, Instant arrival) const;

private:
    struct Movement {
        Instant after; ///< the last report of before it
        Instant until; ///< the first one of where it led to
        std::array<double, 3> to{};
    };

    struct Gap {
        Instant from; ///< the last report before it
        Instant to;   ///< the first one after it
    };

    TableWay wayAt(Instant moment) const;

    std::optional<Instant> m_reported;
    std::deque<Movement> m_movements; ///< the oldest first; before the first report the table may have been anywhere
    std::deque<Gap> m_gaps;           ///< longer than `slack`; the oldest first
};

} // namespace console
