// Since when the table stood where it stood in a picture.
#pragma once

#include "model/instant.hpp"

#include <array>
#include <cstddef>
#include <deque>
#include <optional>

namespace console {

/// From the X-ray system's reports: pictures do not say where the table was. A movement lies somewhere between the last report of before
/// it and the first one after it, and what falls between the two counts for neither place. GUI thread only.
class TableRest {
public:
    static constexpr std::size_t movementsKept = 64;

    /// mm, as the X-ray system reported it.
    void note(const std::array<double, 3>& table, Instant at);

    /// What was taken from then on, and not after a picture that arrived at `arrival`, shows the patient where that picture does.
    /// Instant::max() when nothing but itself does for certain; nothing before a report has come after that picture: until then the table
    /// may have moved.
    std::optional<Instant> since(Instant arrival) const;

private:
    struct Movement {
        Instant after; ///< the last report of before it
        Instant until; ///< the first one of where it led to
    };

    std::optional<Instant> m_reported;
    std::array<double, 3> m_table{};  ///< mm, where the last movement led to
    std::deque<Movement> m_movements; ///< the oldest first; before the first report the table may have been anywhere
};

} // namespace console
