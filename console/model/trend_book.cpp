// Slots, and the loss of a second from counters.
#include "model/trend_book.hpp"

#include "model/measurements.hpp"

#include <algorithm>
#include <cmath>

namespace console {

using namespace std::chrono_literals;

namespace {

constexpr Duration slotOf(TrendSpan span) { return Duration(length(span)) / static_cast<Duration::rep>(TrendBook::mostSlots); }

void put(std::deque<TrendSlot>& slots, std::optional<double> value, Instant now, Duration slot)
{
    if (slots.empty() || now - slots.back().begin >= slot) {
        if (slots.size() == TrendBook::mostSlots)
            slots.pop_front();
        // Slots follow each other without drift while they are filled.
        const bool follows = !slots.empty() && now - slots.back().begin < 2 * slot;
        slots.push_back({follows ? slots.back().begin + slot : now, value, value});
        return;
    }
    TrendSlot& present = slots.back();
    if (!value)
        return;
    present.least = std::min(present.least.value_or(*value), *value);
    present.most = std::max(present.most.value_or(*value), *value);
}

} // namespace

void TrendBook::note(const TrendReading& reading, Instant now)
{
    add(TrendFigure::RoundTrip, reading.roundTripMs, now);
    add(TrendFigure::Jitter, reading.jitterMs, now);
    add(TrendFigure::Loss, lossOf(reading, now), now);
    add(TrendFigure::Force, reading.force ? std::optional(std::abs(*reading.force)) : std::nullopt, now);
    add(TrendFigure::PictureAge, reading.pictureAgeMs, now);
}

void TrendBook::add(TrendFigure figure, std::optional<double> value, Instant now)
{
    const auto index = static_cast<std::size_t>(figure);
    m_latest.at(index) = value;
    for (const TrendSpan span : {TrendSpan::Minute, TrendSpan::TenMinutes})
        put(m_slots.at(index).at(static_cast<std::size_t>(span)), value, now, slotOf(span));
}

const std::deque<TrendSlot>& TrendBook::slots(TrendFigure figure, TrendSpan span) const
{
    return m_slots.at(static_cast<std::size_t>(figure)).at(static_cast<std::size_t>(span));
}

std::optional<double> TrendBook::mostOfSecond(TrendFigure figure) const
{
    std::optional<double> most = latest(figure);
    const auto& minute = slots(figure, TrendSpan::Minute);
    if (!most)
        return most;
    for (auto slot = minute.rbegin(); slot != minute.rend() && slot->begin > minute.back().begin - 1s; ++slot)
        most = std::max(*most, slot->most.value_or(*most));
    return most;
}

std::optional<TrendBook::Summary> TrendBook::summary(TrendFigure figure, TrendSpan span) const
{
    std::vector<double> values;
    for (const auto& slot : slots(figure, span))
        if (slot.most)
            values.push_back(*slot.most);
    if (values.empty())
        return std::nullopt;
    return Summary{*percentile(values, 0.5), *percentile(values, 0.99)};
}

/// Counters that went back are those of another session.
std::optional<double> TrendBook::lossOf(const TrendReading& reading, Instant now)
{
    if (!reading.heartbeatsReceived) {
        m_counted.reset();
        m_loss.reset();
        return std::nullopt;
    }
    const Counted counted{now, *reading.heartbeatsReceived, reading.heartbeatsMissed};
    const bool another = m_counted && (counted.received < m_counted->received || counted.missed < m_counted->missed);
    if (!m_counted || another) {
        m_counted = counted;
        m_loss.reset();
    } else if (now - m_counted->at >= 1s) {
        const auto missed = static_cast<double>(counted.missed - m_counted->missed);
        const auto expected = missed + static_cast<double>(counted.received - m_counted->received);
        m_loss = expected > 0 ? 100 * missed / expected : 100.0;
        m_counted = counted;
    }
    return m_loss;
}

} // namespace console
