// The rules for partial messages.
#include "protocol/reassembler.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <utility>

namespace liena::protocol {

namespace {

std::string tooLong(std::uint16_t number, std::size_t maximum)
{
    return fmt::format("message 0x{:04x} is longer than the {} bytes its definition allows", number, maximum);
}

} // namespace

Reassembler::Outcome Reassembler::take(const DatagramHeader& header, std::span<const std::byte> body, std::size_t maximum)
{
    auto outcome = open(header, body.size(), maximum);
    if (!std::holds_alternative<Incomplete>(outcome))
        return outcome;
    add(body);
    return close();
}

Reassembler::Outcome Reassembler::open(const DatagramHeader& header, std::size_t length, std::size_t maximum)
{
    if (length > maximum)
        return Violation{tooLong(header.message.number, maximum)};
    if (header.moreSegments && length == 0)
        return Violation{fmt::format("message 0x{:04x} has an empty segment before its last", header.message.number)};
    auto partial = m_partials.find(header.message.number);
    if (partial != m_partials.end() && header.timestamp > partial->second.timestamp) {
        drop(partial);
        partial = m_partials.end();
    }
    if (partial == m_partials.end()) {
        if (!header.moreSegments)
            return Whole{};
        partial = begin(header, maximum);
    } else if (auto violation = judge(partial->second, header, length, maximum)) {
        return std::move(*violation);
    }
    const bool overBudget = !partial->second.discarding && !reserve(partial->second, length);
    partial->second.heard += length;
    m_open = Segment{partial, length, !header.moreSegments, overBudget};
    return Incomplete{};
}

std::optional<Reassembler::Violation> Reassembler::judge(const Partial& partial, const DatagramHeader& header, std::size_t length,
                                                         std::size_t maximum) const
{
    const auto number = header.message.number;
    if (header.timestamp < partial.timestamp)
        return Violation{fmt::format("message 0x{:04x} has an older timestamp than its partial", number)};
    if (header.target != partial.target)
        return Violation{fmt::format("message 0x{:04x} changes its target between segments", number)};
    if (length == 0)
        return Violation{fmt::format("message 0x{:04x} ends with an empty segment", number)};
    if (partial.heard + length > maximum)
        return Violation{tooLong(number, maximum)};
    return std::nullopt;
}

Reassembler::Partials::iterator Reassembler::begin(const DatagramHeader& header, std::size_t maximum)
{
    const auto partial = m_partials.emplace(header.message.number, Partial{}).first;
    partial->second.timestamp = header.timestamp;
    partial->second.target = header.target;
    const auto last = m_lastSize.find(header.message.number);
    auto buffer = m_budget.buffer(last != m_lastSize.end() ? std::min(last->second, maximum) : 0);
    partial->second.bytes = std::make_shared<FieldBytes>(std::move(buffer.bytes));
    partial->second.room = buffer.room;
    return partial;
}

/// False when it is too much: then the message is passed over.
bool Reassembler::reserve(Partial& partial, std::size_t bytes)
{
    if (m_budget.take(bytes, m_held)) {
        partial.reserved += bytes;
        m_held += bytes;
        return true;
    }
    release(partial);
    partial.bytes = nullptr;
    partial.discarding = true;
    return false;
}

void Reassembler::add(std::span<const std::byte> piece)
{
    if (!m_open || m_open->partial->second.discarding)
        return;
    auto& partial = m_open->partial->second;
    const auto place = tail(partial, piece.size());
    if (!piece.empty() && place.data() != piece.data())
        std::memcpy(place.data(), piece.data(), piece.size());
    partial.filled += piece.size();
}

Reassembler::Place Reassembler::place(std::size_t bytes)
{
    if (!m_open || m_open->partial->second.discarding || bytes == 0)
        return {};
    auto& partial = m_open->partial->second;
    return {tail(partial, bytes), partial.bytes};
}

/// The next so many bytes of its buffer, which is made longer when it must be.
std::span<std::byte> Reassembler::tail(Partial& partial, std::size_t bytes)
{
    auto& buffer = *partial.bytes;
    if (buffer.size() < partial.filled + bytes)
        buffer.resize(partial.filled + bytes, boost::container::default_init);
    return {buffer.data() + partial.filled, bytes};
}

Reassembler::Outcome Reassembler::close()
{
    const auto segment = std::exchange(m_open, std::nullopt);
    if (!segment)
        return Incomplete{};
    auto& partial = segment->partial->second;
    Outcome outcome = Incomplete{};
    if (partial.discarding)
        outcome = OverBudget{segment->overBudget ? partial.heard : segment->length, segment->overBudget};
    if (!segment->last)
        return outcome;
    release(partial);
    if (!partial.discarding) {
        partial.bytes->resize(partial.filled, boost::container::default_init);
        m_lastSize[segment->partial->first] = partial.filled;
        outcome = Assembled{takeFitting(partial)};
    }
    m_partials.erase(segment->partial);
    return outcome;
}

/// A buffer was reserved for a message as long as the one before it. What turned out to be much shorter does not keep it: whoever holds
/// messages counts them by their length.
FieldBytes Reassembler::takeFitting(Partial& partial)
{
    constexpr std::size_t worthExchanging = 65536;
    auto& bytes = *partial.bytes;
    if (bytes.capacity() < worthExchanging || bytes.capacity() <= 2 * bytes.size())
        return std::move(bytes);
    FieldBytes fitting(bytes.begin(), bytes.end());
    if (partial.bytes.use_count() == 1) // else a read in flight writes to it
        m_budget.recycle(std::move(bytes));
    return fitting;
}

void Reassembler::abandon(std::uint16_t number, Timestamp timestamp)
{
    const auto partial = m_partials.find(number);
    if (partial != m_partials.end() && partial->second.timestamp == timestamp)
        drop(partial);
}

void Reassembler::drop(Partials::iterator partial)
{
    ++m_abandoned;
    if (m_open && m_open->partial == partial)
        m_open.reset();
    release(partial->second);
    if (partial->second.bytes.use_count() == 1) // else a read in flight writes to it
        m_budget.recycle(std::move(*partial->second.bytes));
    m_partials.erase(partial);
}

void Reassembler::release(Partial& partial)
{
    const auto reserved = std::exchange(partial.reserved, 0);
    m_held -= reserved;
    m_budget.giveBack(reserved);
    m_budget.release(std::exchange(partial.room, 0));
}

void Reassembler::clear()
{
    while (!m_partials.empty())
        drop(m_partials.begin());
}

} // namespace liena::protocol
