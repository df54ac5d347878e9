// Whether two pictures were taken alike.
#include "imaging/exposure.hpp"

#include <algorithm>
#include <cmath>

namespace console {

namespace {

constexpr double gainStep = 0.1; ///< share of the brightness

} // namespace

bool sameExposure(const XrayFrame& one, const XrayFrame& other)
{
    return one.acquisition == other.acquisition && one.source == other.source && one.rows == other.rows && one.columns == other.columns &&
           one.bitsStored == other.bitsStored && one.photometric == other.photometric && one.intensity == other.intensity &&
           one.imagerPixelSpacing == other.imagerPixelSpacing && sameProjection(one.geometry, other.geometry, resting) &&
           one.rung == other.rung && one.encoding == other.encoding && one.quality == other.quality && one.mask == other.mask;
}

double brightnessOf(const cv::Mat& stored)
{
    double sum = 0;
    int rows = 0;
    for (int row = 0; row < stored.rows; row += 8, ++rows)
        sum += cv::mean(stored.row(row))[0];
    return rows > 0 ? sum / rows : 0;
}

bool sameBrightness(double before, double now) { return std::abs(now - before) <= gainStep * std::max(before, 1.0); }

} // namespace console
