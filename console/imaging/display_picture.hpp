// A picture ready for the screen, with everything that must be said about it.
#pragma once

#include "imaging/c_arm_pose.hpp"
#include "imaging/window_level.hpp"
#include "model/picture_state.hpp"

#include <QImage>

#include <optional>

namespace console {

/// What the temporal filter made of it.
struct PictureTreatment {
    double k = 1;                 ///< 1: nothing of earlier pictures
    Duration filterDelay{};       ///< how much later a slow movement appears
    bool filterIsBounded = false; ///< weaker than asked for, so that the picture stays young enough
};

/// What each stage took.
struct StageTimes {
    Duration decode{};
    Duration temporal{};
    Duration edge{};
    Duration window{}; ///< with grey scale and shutter
};

struct DisplayPicture {
    QImage image;    ///< Format_RGB32, one pixel for each of the frame's
    XrayFrame about; ///< without its pixels
    PictureRole role = PictureRole::Live;
    int meanOf = 1; ///< pictures, of which `about` is the last; 1: it is no mean
    GreyWindow window;
    bool windowIsAutomatic = false;
    DisplaySettings settings; ///< that it was made with
    PictureTreatment treatment;
    bool isCalibrated = false; ///< to the display's measured light
    StageTimes times;

    bool isSameFrameAs(const DisplayPicture& other) const
    {
        return about.frame == other.about.frame && about.acquisition == other.about.acquisition && about.captureNs == other.about.captureNs;
    }
};

/// The C-arm at the picture's pulse; detectorSize stays empty when the pixel spacing is unknown.
CArmGeometry geometryOf(const XrayFrame& frame);

/// For a window that is set on it.
WindowBasis basisOf(const XrayFrame& frame);

/// One pixel's edge in the isocentre's plane, mm (imager spacing x SOD / SID); nothing when any of the three is unknown.
std::optional<double> pixelSizeAtIsocentre(const XrayFrame& frame);

} // namespace console
