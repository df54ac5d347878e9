// The monotonic and the wall clock at one moment, for little more than the price of one.
#pragma once

#include "session/instant.hpp"

#include <chrono>

namespace liena::system {

/// Network thread. Reading the clocks is a good part of what a small message costs, so the wall clock is read once a millisecond and
/// counted on by the monotonic one between: they run apart by less than a microsecond in that time (adjtimex(2): 500 ppm at the most), and
/// a wall clock that is set is noticed a millisecond later.
class PairedClocks {
public:
    session::Now now()
    {
        constexpr std::chrono::milliseconds longest{1};
        const auto mono = std::chrono::steady_clock::now();
        if (mono - m_read.mono > longest)
            m_read = {mono, Timestamp::now()};
        const auto since = std::chrono::duration_cast<std::chrono::nanoseconds>(mono - m_read.mono);
        return {mono, Timestamp{m_read.wall.ns + static_cast<std::uint64_t>(since.count())}};
    }

private:
    session::Now m_read{};
};

} // namespace liena::system
