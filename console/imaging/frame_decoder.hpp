// From a frame's encoded bytes to stored values.
#pragma once

#include "model/xray_frame.hpp"

#include <QString>

#include <opencv2/core.hpp>

namespace console {

inline constexpr int largestEdge = 4096;
inline constexpr std::size_t largestEncoding = 16777216; ///< bytes, as the message set says

/// Writes CV_8UC1 (1 to 8 bits stored) or CV_16UC1 into `stored`, and reuses its memory when it fits. Returns an empty text, or why the
/// picture is refused; `stored` then holds nothing to be shown. Sizes are checked before memory is taken; nothing is thrown. A picture
/// whose bytes contradict what the message says of it is refused, never repaired: a wrong picture is worse than none.
QString decodeFrame(const XrayFrame& frame, cv::Mat& stored);

} // namespace console
