// Latencies, each of them: a histogram's buckets would be half as wide as the limits on a line of 20 ms.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace liena::compare {

/// Nanoseconds.
class LatencySamples {
public:
    LatencySamples() { m_values.reserve(room); }

    void record(std::int64_t nanoseconds) { m_values.push_back(static_cast<std::uint64_t>(std::max<std::int64_t>(nanoseconds, 0))); }

    std::uint64_t count() const { return m_values.size(); }
    std::uint64_t max() const { return quantile(1); }

    /// By nearest rank; 0 when nothing was recorded.
    std::uint64_t quantile(double fraction) const
    {
        if (m_values.empty())
            return 0;
        auto sorted = m_values;
        const auto rank = static_cast<std::size_t>(std::ceil(fraction * static_cast<double>(sorted.size())));
        const auto place = static_cast<std::ptrdiff_t>(std::clamp<std::size_t>(rank, 1, sorted.size()) - 1);
        std::nth_element(sorted.begin(), sorted.begin() + place, sorted.end());
        return sorted[static_cast<std::size_t>(place)];
    }

private:
    static constexpr std::size_t room = std::size_t{1} << 16U; ///< so that none is asked for while it is measured

    std::vector<std::uint64_t> m_values;
};

} // namespace liena::compare
