// Edge enhancement that leaves noise alone.
#pragma once

#include "imaging/noise_model.hpp"

#include <opencv2/core.hpp>

namespace console {

/// Unsharp mask: X + g · (X − Gσ∗X), of which the part of X − Gσ∗X within twice the local noise is left out. Without noise its transfer is
/// 1 + g · (1 − exp(−2π²σ²f²)). Strength as Display Filter Percentage (0028,9411): 0 = none, 100 = g of 2 (DICOM PS3.17 FFF.2.3.1).
/// One thread at a time.
class EdgeEnhancement {
public:
    static constexpr double sigma = 1.5; ///< pixels
    static constexpr double strongest = 2;

    /// In place, on CV_32FC1. Borders repeat their last pixel.
    void apply(cv::Mat& picture, int percent, const NoiseModel& noise);

private:
    cv::Mat m_smooth;
};

} // namespace console
