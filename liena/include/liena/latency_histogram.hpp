// Counts latencies in buckets whose width grows with the value: small, of fixed size, and no allocation while measuring.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace liena {

/// Nanoseconds. Each doubling is cut into 64 buckets, so that what it says is at most 1/64 above the true value.
class LatencyHistogram {
public:
    /// Negative values (clocks never go back, but programs have bugs) count as 0; values beyond `highest` as `highest`.
    void record(std::int64_t nanoseconds, std::uint64_t times = 1)
    {
        const auto value = clamp(nanoseconds);
        m_counts[bucketOf(value)] += times;
        m_count += times;
        if (value > m_max)
            m_max = value;
        if (value < m_least)
            m_least = value;
    }

    std::uint64_t count() const { return m_count; }
    std::uint64_t max() const { return m_max; }
    std::uint64_t least() const { return m_count > 0 ? m_least : 0; }

    /// The least value that `fraction` of the records do not exceed, rounded up to its bucket's end; 0 when nothing was recorded.
    std::uint64_t quantile(double fraction) const;

    /// Whether so many were recorded that this quantile is more than just the greatest of them: 100 for 99 %.
    bool tells(double fraction) const { return static_cast<double>(m_count) * (1 - fraction) > 1 - 1e-9; }

    /// Calls `tell(value, count)` for each bucket that is not empty, in order; `value` is its end, or the greatest that was recorded.
    /// Recording these values again gives the same quantiles.
    template <typename Tell>
    void forEach(Tell&& tell) const
    {
        for (std::size_t bucket = 0; bucket < buckets; ++bucket)
            if (m_counts[bucket] > 0)
                tell(endOf(bucket) < m_max ? endOf(bucket) : m_max, m_counts[bucket]);
    }

    static constexpr std::uint64_t highest = (std::uint64_t{1} << 36U) - 1; ///< 68 s

private:
    static constexpr unsigned partBits = 6;
    static constexpr std::uint64_t parts = std::uint64_t{1} << partBits;
    static constexpr std::size_t buckets = parts * (36 - partBits + 1);

    static std::uint64_t clamp(std::int64_t value)
    {
        const auto positive = value < 0 ? std::uint64_t{0} : static_cast<std::uint64_t>(value);
        return positive > highest ? highest : positive;
    }

    /// Values below `parts` have a bucket each; above, the highest bits after the first choose the part of the doubling.
    static std::size_t bucketOf(std::uint64_t value)
    {
        if (value < parts)
            return value;
        const auto shift = static_cast<unsigned>(std::bit_width(value)) - partBits - 1;
        return parts * (shift + 1) + ((value >> shift) - parts);
    }

    static std::uint64_t endOf(std::size_t bucket)
    {
        if (bucket < parts)
            return bucket;
        const auto shift = bucket / parts - 1;
        return ((parts + bucket % parts + 1) << shift) - 1;
    }

    std::array<std::uint64_t, buckets> m_counts{};
    std::uint64_t m_count = 0;
    std::uint64_t m_max = 0;
    std::uint64_t m_least = highest;
};

} // namespace liena
