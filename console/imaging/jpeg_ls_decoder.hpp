// The coded data of a JPEG-LS picture (ISO 14495-1, annex A) to stored values.
#pragma once

#include "imaging/jpeg_ls_header.hpp"

#include <opencv2/core.hpp>

namespace console {

/// `stored` has the header's size and is CV_8UC1 or, above 8 bits, CV_16UC1. False when the data are damaged or do not end with the
/// picture.
///
/// Why this is written here: CharLS 2.4.1, as Debian 12 has it, loops without end on some damaged data and aborts on others. This decoder
/// does a bounded amount of work per pixel whatever the bytes are, and stops at the first line that cannot be right.
bool decodeJpegLs(const JpegLsHeader& header, cv::Mat& stored);

} // namespace console
