// A queue on its way out in tests, read segment by segment as text.
#pragma once

#include "support/hex.hpp"
#include "tasks/output_queue.hpp"

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace liena::test {

inline constexpr std::chrono::steady_clock::time_point now{std::chrono::hours(1)};

/// What it says of a message that was begun and given up is `A` and the message's number.
struct Lane {
    using OutputQueue = tasks::OutputQueue;
    using Rank = tasks::Rank;

    std::vector<std::pair<std::uint16_t, OutputQueue::Fate>> reports;
    OutputQueue queue;

    explicit Lane(OutputQueue::Limits limits = {})
        : queue([this](const OutputQueue::Entry& entry,
                       OutputQueue::Fate fate) { reports.emplace_back(entry.message.header.message.number, fate); },
                [](const protocol::DatagramHeader& begun) {
                    return protocol::EncodedMessage{{{begun.message.origin, 0x0051}, begun.target, Timestamp{2}},
                                                    {static_cast<std::byte>('A'), static_cast<std::byte>(begun.message.number)}};
                },
                limits)
    {}

    static OutputQueue::Entry entry(std::uint16_t number, Rank rank, const std::string& text, std::uint32_t history = 0,
                                    DeviceId target = DeviceId(0x40018208U))
    {
        OutputQueue::Entry made{{{{DeviceId(0x20010208U), number}, target, Timestamp{1}}, {}}, rank, history, std::nullopt, {}};
        const auto bytes = bytesOfText(text);
        made.message.part.assign(bytes.begin(), bytes.end());
        return made;
    }

    bool push(std::uint16_t number, Rank rank, const std::string& text, std::uint32_t history = 0)
    {
        return queue.push(entry(number, rank, text, history));
    }

    /// The body of the next segment, with `+` behind it when more follow; `-` when nothing waits.
    std::string next(std::size_t maximum = 100, std::chrono::steady_clock::time_point at = now)
    {
        std::vector<std::byte> out;
        if (!queue.appendNext(maximum, at, out))
            return out.empty() ? "-" : "(bytes without a segment)";
        const auto header = protocol::decodeHeader(std::span<const std::byte, protocol::headerSize>(out.data(), protocol::headerSize));
        const auto body = std::span(out).subspan(protocol::headerSize);
        if (header.length != body.size())
            return "(another length)";
        return std::string(reinterpret_cast<const char*>(body.data()), body.size()) + (header.moreSegments ? "+" : "");
    }
};

} // namespace liena::test
