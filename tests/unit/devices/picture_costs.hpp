// What pictures come to in each encoding, of a raw one.
#pragma once

#include "picture_ladder.hpp"

namespace liena::test {

inline double shareOf(const devices::PictureRung& rung)
{
    using devices::Encoding;
    if (rung.encoding == Encoding::Raw)
        return 1;
    if (rung.encoding == Encoding::JpegLs)
        return 0.28; // of the computed fluoroscopy, 12 bits in two bytes; so are the next
    return rung.quality >= 90 ? 0.07 : rung.quality >= 75 ? 0.041 : 0.028;
}

} // namespace liena::test
