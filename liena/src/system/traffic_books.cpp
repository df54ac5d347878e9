// Closing of a report's window.
#include "system/traffic_books.hpp"

#include <algorithm>
#include <limits>

namespace liena::system {

void TrafficBooks::beginWindow(Instant now)
{
    m_window = {};
    m_latencies.clear();
    m_windowBegan = now;
}

protocol::LinkReport TrafficBooks::takeReport(Instant now, std::size_t backlog)
{
    auto report = std::exchange(m_window, {});
    const auto window = m_windowBegan ? now - *m_windowBegan : std::chrono::nanoseconds::zero();
    m_windowBegan = now;
    report.windowUs = static_cast<std::uint32_t>(std::chrono::duration_cast<std::chrono::microseconds>(window).count());
    report.backlogBytes = static_cast<std::uint32_t>(std::min<std::size_t>(backlog, std::numeric_limits<std::uint32_t>::max()));
    if (!m_latencies.empty()) {
        const auto middle = m_latencies.begin() + static_cast<std::ptrdiff_t>(m_latencies.size() / 2);
        std::nth_element(m_latencies.begin(), middle, m_latencies.end());
        report.oneWayNs = static_cast<std::uint64_t>(std::max<std::int64_t>(middle->count(), 1));
        m_latencies.clear();
    }
    return report;
}

} // namespace liena::system
