// Percentiles of measured times, printed in a line.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

/// By nearest rank; `values` is not empty.
inline double percentileOf(std::vector<double> values, double part)
{
    std::sort(values.begin(), values.end());
    const auto rank = static_cast<std::size_t>(std::ceil(part * static_cast<double>(values.size())));
    return values[std::clamp<std::size_t>(rank, 1, values.size()) - 1];
}

inline void printPercentiles(const char* what, const std::vector<double>& values)
{
    if (values.empty())
        std::printf("  %-58s not measured\n", what);
    else
        std::printf("  %-58s p50 %7.1f   p99 %7.1f   max %7.1f ms   (%zu)\n", what, percentileOf(values, 0.50), percentileOf(values, 0.99),
                    percentileOf(values, 1.0), values.size());
}
