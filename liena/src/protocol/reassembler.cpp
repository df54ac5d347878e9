// The rules for partial messages.
#include "protocol/reassembler.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace liena::protocol {

Reassembler::Outcome Reassembler::take(const DatagramHeader& header, std::span<const std::byte> body, std::size_t maximum)
{
    if (body.size() > maximum)
        return Violation{fmt::format("message 0x{:04x} is longer than the {} bytes its definition allows", header.message.number, maximum)};
    if (header.moreSegments && body.empty())
        return Violation{fmt::format("message 0x{:04x} has an empty segment before its last", header.message.number)};
    const auto partial = m_partials.find(header.message.number);
    if (partial == m_partials.end())
        return begin(header, body);
    if (header.timestamp < partial->second.timestamp)
        return Violation{fmt::format("message 0x{:04x} has an older timestamp than its partial", header.message.number)};
    if (header.timestamp > partial->second.timestamp) {
        drop(partial);
        return begin(header, body);
    }
    return extend(partial, header, body, maximum);
}

Reassembler::Outcome Reassembler::begin(const DatagramHeader& header, std::span<const std::byte> body)
{
    if (!header.moreSegments)
        return Whole{};
    auto& partial = m_partials[header.message.number];
    partial.timestamp = header.timestamp;
    partial.target = header.target;
    return append(partial, body);
}

Reassembler::Outcome Reassembler::extend(Partials::iterator partial, const DatagramHeader& header, std::span<const std::byte> body,
                                         std::size_t maximum)
{
    auto& state = partial->second;
    if (header.target != state.target)
        return Violation{fmt::format("message 0x{:04x} changes its target between segments", header.message.number)};
    if (body.empty())
        return Violation{fmt::format("message 0x{:04x} ends with an empty segment", header.message.number)};
    if (state.heard + body.size() > maximum)
        return Violation{fmt::format("message 0x{:04x} is longer than the {} bytes its definition allows", header.message.number, maximum)};
    auto outcome = append(state, body);
    if (header.moreSegments)
        return outcome;
    if (!state.discarding)
        outcome = Assembled{std::move(state.bytes)};
    m_budget.giveBack(state.reserved);
    m_partials.erase(partial);
    return outcome;
}

Reassembler::Outcome Reassembler::append(Partial& partial, std::span<const std::byte> body)
{
    partial.heard += body.size();
    if (partial.discarding)
        return Incomplete{};
    if (!m_budget.take(body.size())) {
        m_budget.giveBack(partial.reserved);
        partial.reserved = 0;
        partial.bytes = {};
        partial.discarding = true;
        return OverBudget{};
    }
    partial.reserved += body.size();
    partial.bytes.insert(partial.bytes.end(), body.begin(), body.end());
    return Incomplete{};
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
    m_budget.giveBack(partial->second.reserved);
    m_partials.erase(partial);
}

void Reassembler::clear()
{
    while (!m_partials.empty())
        drop(m_partials.begin());
}

} // namespace liena::protocol
