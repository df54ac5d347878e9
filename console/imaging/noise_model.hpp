// How noisy a picture is at each brightness: variance = slope · value + offset (quanta, and the electronics; Poisson and Gauss).
#pragma once

#include <opencv2/core.hpp>

namespace console {

/// In the units of the picture it was estimated from.
struct NoiseModel {
    double slope = 0;
    double offset = 0;

    /// Never below zero.
    double variance(double value) const;

    /// For a picture whose noise has `share` of the variance.
    NoiseModel scaled(double share) const { return {slope * share, offset * share}; }
};

/// From one picture (CV_32FC1): medians of the second difference along the rows, in classes of brightness, and a straight line through
/// them. Edges are few, and the median does not see them. A picture too small to tell has no noise.
NoiseModel estimateNoise(const cv::Mat& picture);

} // namespace console
