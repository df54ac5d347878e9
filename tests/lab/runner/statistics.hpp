// Percentiles of a handful of measured values.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace liena::lab {

class Sample {
public:
    void add(const std::optional<double>& value)
    {
        if (value)
            m_values.push_back(*value);
    }
    void add(const Sample& other) { m_values.insert(m_values.end(), other.m_values.begin(), other.m_values.end()); }
    bool empty() const { return m_values.empty(); }
    std::size_t size() const { return m_values.size(); }

    /// The smallest value that at least this part of all is not above; call it only when there is one.
    double at(double part) const
    {
        auto sorted = m_values;
        std::sort(sorted.begin(), sorted.end());
        const auto rank = static_cast<std::size_t>(std::ceil(part * static_cast<double>(sorted.size())));
        return sorted[std::clamp<std::size_t>(rank, 1, sorted.size()) - 1];
    }

private:
    std::vector<double> m_values;
};

} // namespace liena::lab
