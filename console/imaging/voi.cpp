// The VOI LUT functions. Each has one division, so that halves stay exact.
#include "imaging/voi.hpp"

#include <algorithm>
#include <cmath>

namespace console {

namespace {

double linear(double stored, GreyWindow window, double largest)
{
    const double width = std::max(window.width, 1.0);
    const double middle = window.centre - 0.5;
    const double half = (width - 1) / 2;
    if (stored <= middle - half)
        return 0;
    if (stored > middle + half)
        return largest;
    return (2 * (stored - middle) + (width - 1)) * largest / (2 * (width - 1));
}

double linearExact(double stored, GreyWindow window, double largest)
{
    if (stored <= window.centre - window.width / 2)
        return 0;
    if (stored > window.centre + window.width / 2)
        return largest;
    return (2 * (stored - window.centre) + window.width) * largest / (2 * window.width);
}

} // namespace

double voiValue(double stored, GreyWindow window, VoiFunction function, double largest)
{
    switch (function) {
    case VoiFunction::Linear:
        break;
    case VoiFunction::LinearExact:
        return linearExact(stored, window, largest);
    case VoiFunction::Sigmoid:
        return largest / (1 + std::exp(-4 * (stored - window.centre) / window.width));
    }
    return linear(stored, window, largest);
}

} // namespace console
