// Whether a quantity grows: implementation.
#include "runner/trend.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace liena::lab {

namespace {

double mean(const std::vector<double>& values)
{
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

} // namespace

void Trend::add(double hours, double value)
{
    m_hours.push_back(hours);
    m_values.push_back(value);
}

Trend Trend::between(double from, double to) const
{
    Trend part;
    const auto place = [&](double share) { return static_cast<std::size_t>(share * static_cast<double>(size())); };
    for (auto i = place(from); i < place(to); ++i)
        part.add(m_hours[i], m_values[i]);
    return part;
}

double Trend::slope() const
{
    if (size() < 2)
        return 0;
    const double hours = mean(m_hours);
    const double value = mean(m_values);
    double covariance = 0;
    double variance = 0;
    for (std::size_t i = 0; i < size(); ++i) {
        covariance += (m_hours[i] - hours) * (m_values[i] - value);
        variance += (m_hours[i] - hours) * (m_hours[i] - hours);
    }
    return variance > 0 ? covariance / variance : 0;
}

double Trend::uncertainty() const
{
    if (size() < 3)
        return 0;
    const double hours = mean(m_hours);
    const double value = mean(m_values);
    const double tilt = slope();
    double residual = 0;
    double variance = 0;
    for (std::size_t i = 0; i < size(); ++i) {
        const double miss = m_values[i] - value - tilt * (m_hours[i] - hours);
        residual += miss * miss;
        variance += (m_hours[i] - hours) * (m_hours[i] - hours);
    }
    return variance > 0 ? std::sqrt(residual / static_cast<double>(size() - 2) / variance) : 0;
}

double Trend::largestOf(double from, double to) const
{
    const auto place = [&](double part) { return static_cast<std::ptrdiff_t>(part * static_cast<double>(size())); };
    const auto begin = m_values.begin() + place(from);
    const auto end = m_values.begin() + std::max(place(to), place(from) + 1);
    return *std::max_element(begin, std::min(end, m_values.end()));
}

} // namespace liena::lab
