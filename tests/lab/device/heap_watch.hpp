// How much of the heap is in use: what the soak judges, since memory once taken from the system is not given back when it is free.
#pragma once

#include "device/line_log.hpp"

#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <cstddef>

namespace liena::lab {

/// Tells `heap BYTES` every second: the least that was in use in it, which leaves out what was on its way through.
class HeapWatch {
public:
    using Time = std::chrono::steady_clock::time_point;

    void tick(Time now)
    {
        if (now < m_nextLook)
            return;
        m_nextLook = now + std::chrono::milliseconds(50);
        const auto facts = ::mallinfo2();
        m_least = m_looks == 0 ? facts.uordblks + facts.hblkhd : std::min(m_least, facts.uordblks + facts.hblkhd);
        if (++m_looks < looksPerLine)
            return;
        tell(now, {"heap", m_least});
        m_looks = 0;
    }

private:
    static constexpr int looksPerLine = 20;

    Time m_nextLook{};
    std::size_t m_least = 0;
    int m_looks = 0;
};

} // namespace liena::lab
