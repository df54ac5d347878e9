// How far a picture is from what was asked for, as the X-ray system says in each one.
#pragma once

#include "model/xray_frame.hpp"

#include <QString>

namespace console {

/// A step on the X-ray system's declared ladder; nothing of it is worked out here.
struct PictureReduction {
    int rung = 0;         ///< 0: as asked for
    double rate = 0;      ///< per second; 0 = not said
    double askedRate = 0; ///< per second; 0 = not said
    PixelEncoding encoding = PixelEncoding::Raw;
    int quality = 0; ///< as XrayFrame has it

    bool stands() const { return rung > 0; }

    /// False for lossless pictures at the full rate: those are encoded otherwise than asked for, and the same on the screen.
    bool losesInformation() const;

    friend bool operator==(const PictureReduction&, const PictureReduction&) = default;
};

/// The default value for a picture that is as asked for.
PictureReduction reductionOf(const XrayFrame& frame);

/// `REDUCED 7.5 of 15 /s`, and `lossy 75`; together with a comma the line for chip and log. Empty when it does not stand.
QString rateWords(const PictureReduction& reduction);
QString encodingWords(const PictureReduction& reduction);
QString line(const PictureReduction& reduction);

} // namespace console
