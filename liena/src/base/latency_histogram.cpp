// Reading the buckets.
#include "liena/latency_histogram.hpp"

#include <algorithm>
#include <cmath>

namespace liena {

std::uint64_t LatencyHistogram::quantile(double fraction) const
{
    if (m_count == 0)
        return 0;
    const auto wanted = std::max<std::uint64_t>(1, static_cast<std::uint64_t>(std::ceil(fraction * static_cast<double>(m_count))));
    std::uint64_t seen = 0;
    for (std::size_t bucket = 0; bucket < buckets; ++bucket) {
        seen += m_counts[bucket];
        if (seen >= wanted)
            return std::min(endOf(bucket), m_max);
    }
    return m_max;
}

} // namespace liena
