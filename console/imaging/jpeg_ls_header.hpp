// The marker segments of a JPEG-LS picture (ISO 14495-1) up to its coded data.
#pragma once

#include <QString>

#include <cstddef>
#include <span>

namespace console {

/// One grey component in one scan. All numbers are within the standard's bounds, and no larger than the decoder's arithmetic allows.
struct JpegLsHeader {
    int bits = 0;
    int rows = 0;
    int columns = 0;
    int maximum = 0; ///< MAXVAL
    int near = 0;    ///< the largest error of a pixel
    int threshold1 = 0;
    int threshold2 = 0;
    int threshold3 = 0;
    int reset = 0;
    std::span<const std::byte> coded; ///< from the first coded byte to the end of the picture's bytes
};

/// Returns an empty text, or why this is no picture that can be decoded. Reads nothing outside `bytes`, whatever is in them.
QString readJpegLsHeader(std::span<const std::byte> bytes, JpegLsHeader& header);

} // namespace console
