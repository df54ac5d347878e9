// A line in virtual time, for tests of what is measured over it.
#pragma once

#include "session/line_probing.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace liena::test {

/// A line with a delay, which loses what it is told to lose.
struct ProbedLine {
    static constexpr session::Instant start{std::chrono::hours(1)};

    session::LineProbing probing;
    session::Nanoseconds roundTrip = std::chrono::milliseconds(4);
    std::uint32_t loseEvery = 0;      ///< packets
    session::Nanoseconds imageTime{}; ///< that the line needs for one image
    session::Instant now = start;
    std::vector<session::LineProbing::Order> sent;
    std::uint32_t heard[4] = {};

    struct Echo {
        session::Instant at;
        protocol::ProbeEcho echo;
    };
    std::vector<Echo> onTheWay;
    session::Instant lineFree = start;
    session::Instant changes = session::Instant::max(); ///< of the limit for images
    std::uint64_t limitAfter = 0;

    ProbedLine(MeasurementPlan plan, MeasuringLimits limits = {}) : probing(std::move(plan), limits, start) {}

    void send(const session::LineProbing::Order& order)
    {
        sent.push_back(order);
        if (order.way == protocol::ProbeWay::Packet && loseEvery > 0 && order.sequence % loseEvery == 0)
            return;
        auto arrives = now;
        if (order.way == protocol::ProbeWay::Image)
            arrives = lineFree = std::max(lineFree, now) + imageTime;
        const auto count = ++heard[static_cast<std::size_t>(order.way)];
        onTheWay.push_back({arrives + roundTrip, {1, order.way, order.sequence, order.sentNs, count}});
    }

    /// Until nothing happens any more; true when the plan is over.
    bool run()
    {
        for (int turns = 0; turns < 2'000'000 && !probing.isOver(); ++turns) {
            while (const auto order = probing.next(now))
                send(*order);
            if (probing.isOver())
                break;
            const auto next = std::min_element(onTheWay.begin(), onTheWay.end(), [](const Echo& a, const Echo& b) { return a.at < b.at; });
            auto wake = std::max(now, probing.wakeAt());
            if (changes <= wake) {
                wake = now = std::max(now, changes);
                changes = session::Instant::max();
                probing.limitImages(limitAfter, now);
                continue;
            }
            if (next != onTheWay.end() && next->at <= wake) {
                now = std::max(now, next->at);
                const auto echo = next->echo;
                onTheWay.erase(next);
                probing.heard(echo, now);
            } else {
                now = std::max(wake, now + std::chrono::nanoseconds(1));
            }
        }
        return probing.isOver();
    }

    const PhaseFigures& phase(std::size_t place = 0) const { return probing.figures().at(place); }
};

} // namespace liena::test
