// Whether two pictures were taken alike: what may be mixed, filtered and averaged.
#pragma once

#include "model/xray_frame.hpp"

#include <opencv2/core.hpp>

namespace console {

/// From one picture to the next: a C-arm that does not turn.
inline constexpr ProjectionTolerance resting{0.05, 0.5};

/// Of one run, size, depth, encoding, step of the ladder and projection, so that a stored value stands for the same in both. Tube voltage
/// and current are not said in a picture; what they change shows in its brightness.
bool sameExposure(const XrayFrame& one, const XrayFrame& other);

/// Mean of every eighth row; 0 for no picture.
double brightnessOf(const cv::Mat& stored);

/// Two pictures of one run do not differ by more without a new gain.
bool sameBrightness(double before, double now);

} // namespace console
