// Where the table stood in a picture, and since when.
#include "model/table_rest.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace console {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr std::array<double, 3> nowhere{none, none, none}; ///< any other place is elsewhere, and so is this one
constexpr double otherPlace = 0.1;                         ///< mm, from which on it is another place: less than half a pixel

/// Negated, so that a number that is none counts as a movement.
bool isElsewhere(const std::array<double, 3>& one, const std::array<double, 3>& other)
{
    const auto moved = [](double before, double now) { return !(std::abs(now - before) <= otherPlace); };
    return moved(one[0], other[0]) || moved(one[1], other[1]) || moved(one[2], other[2]);
}

} // namespace

void TableRest::note(const std::array<double, 3>& table, Instant at)
{
    if (!m_reported || isElsewhere(m_movements.back().to, table))
        m_movements.push_back({m_reported.value_or(Instant::min()), at, table});
    if (m_movements.size() > movementsKept)
        m_movements.pop_front();
    if (m_reported && at - *m_reported > slack)
        m_gaps.push_back({*m_reported, at});
    if (m_gaps.size() > movementsKept)
        m_gaps.pop_front();
    m_reported = at;
}

std::optional<Instant> TableRest::since(Instant arrival) const
{
    if (!m_reported || *m_reported <= arrival)
        return std::nullopt;
    const auto last = std::find_if(m_movements.rbegin(), m_movements.rend(), [arrival](const Movement& m) { return m.after < arrival; });
    return last == m_movements.rend() ? Instant::max() : last->until;
}

std::optional<TableWay> TableRest::wayOf(Instant taken, Instant arrival) const
{
    if (!m_reported)
        return std::nullopt;
    return TableWay{wayAt(taken).from, wayAt(arrival).to};
}

bool TableRest::spans(Instant taken, Instant arrival) const
{
    if (!m_reported || *m_reported + slack < arrival)
        return false;
    const auto covers = [&](const Gap& gap) { return arrival > gap.from + slack && taken < gap.to - slack; };
    if (std::any_of(m_gaps.begin(), m_gaps.end(), covers))
        return false;
    const Movement& oldest = m_movements.front();
    return oldest.after != Instant::min() || oldest.until <= taken + slack;
}

TableWay TableRest::wayAt(Instant moment) const
{
    const auto last = std::find_if(m_movements.rbegin(), m_movements.rend(), [moment](const Movement& m) { return m.after < moment; });
    if (last == m_movements.rend())
        return TableWay{nowhere, nowhere};
    const bool first = last->after == Instant::min();
    if (first || last->until <= moment)
        return TableWay{last->to, last->to};
    const auto before = std::next(last);
    return TableWay{before == m_movements.rend() ? nowhere : before->to, last->to};
}

} // namespace console
