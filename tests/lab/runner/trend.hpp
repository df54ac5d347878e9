// Whether a quantity grows: the straight line of least squares through its samples.
#pragma once

#include <cstddef>
#include <vector>

namespace liena::lab {

class Trend {
public:
    void add(double hours, double value);

    std::size_t size() const { return m_hours.size(); }
    Trend between(double from, double to) const;    ///< these parts of the series, 0 to 1
    double slope() const;                           ///< per hour
    double uncertainty() const;                     ///< standard error of the slope; 0 with fewer than three samples
    double largestOf(double from, double to) const; ///< within these parts of the series, 0 to 1
    double first() const { return m_values.front(); }
    double last() const { return m_values.back(); }

private:
    std::vector<double> m_hours;
    std::vector<double> m_values;
};

} // namespace liena::lab
