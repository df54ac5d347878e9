// The Grayscale Standard Display Function, and the table of a measured display.
#include "imaging/grey_scale.hpp"

#include <algorithm>
#include <cmath>

namespace console {

namespace {

constexpr double lowest = 1;
constexpr double highest = 1023;

/// The level that gives this much light, between the measured ones.
double levelOf(double luminance, const std::vector<MeasuredGrey>& greys)
{
    const auto above =
        std::find_if(greys.begin(), greys.end(), [luminance](const MeasuredGrey& grey) { return grey.luminance >= luminance; });
    if (above == greys.begin())
        return greys.front().level;
    if (above == greys.end())
        return greys.back().level;
    const MeasuredGrey& below = *(above - 1);
    const double share = (luminance - below.luminance) / (above->luminance - below.luminance);
    return below.level + share * (above->level - below.level);
}

} // namespace

double gsdfLuminance(double index)
{
    // PS3.14, section 7.1.
    constexpr double a = -1.3011877, b = -2.5840191e-2, c = 8.0242636e-2, d = -1.0320229e-1, e = 1.3646699e-1;
    constexpr double f = 2.8745620e-2, g = -2.5468404e-2, h = -3.1978977e-3, k = 1.2992634e-4, m = 1.3635334e-3;
    const double x = std::log(std::clamp(index, lowest, highest));
    const double above = a + x * (c + x * (e + x * (g + x * m)));
    const double below = 1 + x * (b + x * (d + x * (f + x * (h + x * k))));
    return std::pow(10, above / below);
}

double gsdfIndex(double luminance)
{
    double low = lowest;
    double high = highest;
    for (int halving = 0; halving < 60; ++halving) {
        const double middle = (low + high) / 2;
        (gsdfLuminance(middle) < luminance ? low : high) = middle;
    }
    return (low + high) / 2;
}

GreyScale::GreyScale(const DisplayMeasurement& measurement)
{
    if (measurement.greys.size() < 2)
        return;
    m_calibrated = true;
    std::vector<MeasuredGrey> seen = measurement.greys;
    for (MeasuredGrey& grey : seen)
        grey.luminance += measurement.ambient;
    const double first = gsdfIndex(seen.front().luminance);
    const double last = gsdfIndex(seen.back().luminance);
    for (int step = 0; step <= steps; ++step) {
        const double index = first + (last - first) * step / steps;
        m_levels.at(static_cast<std::size_t>(step)) = levelOf(gsdfLuminance(index), seen);
    }
}

double GreyScale::level(double presentation) const
{
    const double place = std::clamp(presentation, 0.0, 1.0) * steps;
    if (!m_calibrated)
        return std::clamp(presentation, 0.0, 1.0) * 255;
    const auto below = static_cast<std::size_t>(std::min(place, steps - 1.0));
    return m_levels.at(below) + (place - static_cast<double>(below)) * (m_levels.at(below + 1) - m_levels.at(below));
}

} // namespace console
