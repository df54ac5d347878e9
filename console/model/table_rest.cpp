// Since when the table stood where it stood in a picture.
#include "model/table_rest.hpp"

#include <algorithm>
#include <cmath>

namespace console {

namespace {

constexpr double otherPlace = 0.1; ///< mm, from which on it is another place: less than half a pixel

/// Negated, so that a number that is none counts as a movement.
bool isElsewhere(const std::array<double, 3>& one, const std::array<double, 3>& other)
{
    const auto moved = [](double before, double now) { return !(std::abs(now - before) <= otherPlace); };
    return moved(one[0], other[0]) || moved(one[1], other[1]) || moved(one[2], other[2]);
}

} // namespace

void TableRest::note(const std::array<double, 3>& table, Instant at)
{
    if (!m_reported || isElsewhere(m_table, table)) {
        m_movements.push_back({m_reported.value_or(Instant::min()), at});
        m_table = table;
    }
    if (m_movements.size() > movementsKept)
        m_movements.pop_front();
    m_reported = at;
}

std::optional<Instant> TableRest::since(Instant arrival) const
{
    if (!m_reported || *m_reported <= arrival)
        return std::nullopt;
    const auto last = std::find_if(m_movements.rbegin(), m_movements.rend(), [arrival](const Movement& m) { return m.after < arrival; });
    return last == m_movements.rend() ? Instant::max() : last->until;
}

} // namespace console
