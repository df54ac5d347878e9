// A picture ready for the screen, with everything that must be said about it.
#pragma once

#include "imaging/c_arm_pose.hpp"
#include "imaging/window_level.hpp"
#include "model/xray_frame.hpp"

#include <QImage>

#include <optional>

namespace console {

struct DisplayPicture {
    QImage image;    ///< Format_RGB32, one pixel for each of the frame's
    XrayFrame about; ///< without its pixels
    GreyWindow window;
    bool windowIsAutomatic = false;
    Duration decodeTime{};
    Duration windowTime{};

    bool isSameFrameAs(const DisplayPicture& other) const
    {
        return about.frame == other.about.frame && about.acquisition == other.about.acquisition && about.captureNs == other.about.captureNs;
    }
};

/// The C-arm at the picture's pulse; detectorSize stays empty when the pixel spacing is unknown.
CArmGeometry geometryOf(const XrayFrame& frame);

/// One pixel's edge in the isocentre's plane, mm (imager spacing x SOD / SID); nothing when any of the three is unknown.
std::optional<double> pixelSizeAtIsocentre(const XrayFrame& frame);

} // namespace console
