// A picture ready for the screen, with everything that must be said about it.
#pragma once

#include "imaging/c_arm_pose.hpp"
#include "imaging/window_level.hpp"
#include "model/picture_state.hpp"

#include <QImage>

#include <cstdint>
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
    QImage image;        ///< Format_RGB32, one pixel for each of the frame's
    QImage presentation; ///< the same in P-values (PS3.14) where `image` has a calibrated display's levels; else null
    XrayFrame about;     ///< without its pixels
    PictureRole role = PictureRole::Live;
    int meanOf = 1; ///< pictures, of which `about` is the last; 1: it is no mean
    GreyWindow window;
    bool windowIsAutomatic = false;
    DisplaySettings settings; ///< that it was made with
    PictureTreatment treatment;
    bool isCalibrated = false; ///< to the display's measured light
    StageTimes times;

    /// As another display should show it, too.
    const QImage& pValues() const { return presentation.isNull() ? image : presentation; }

    bool isSameFrameAs(const DisplayPicture& other) const
    {
        return about.frame == other.about.frame && about.acquisition == other.about.acquisition && about.captureNs == other.about.captureNs;
    }
};

/// The C-arm at the picture's pulse; detectorSize stays empty when the pixel spacing is unknown.
CArmGeometry geometryOf(const XrayFrame& frame);

/// For a window that is set on it.
WindowBasis basisOf(const XrayFrame& frame);

/// One pixel's edge in the isocentre's plane, mm (imager spacing x SOD / SID); nothing when any of the three is unknown. That plane is
/// square to the beam, so it is true at every angle of the C-arm.
std::optional<double> pixelSizeAtIsocentre(const XrayFrame& frame);

/// Why no length is known in a plane above the table.
enum class TablePlaneFault : std::uint8_t {
    None,
    TableTopNotSetUp, ///< how far it is below the isocentre at the reported height 0
    HeightUnknown,    ///< not reported for this picture, or on its way
    GeometryUnknown,
    TooOblique, ///< the beam is too far from upright for the model
    SourceAbove,
    OutsideBeam, ///< the plane is not between source and detector
};

struct TablePlane {
    double pixelSize = 0; ///< mm
    double distance = 0;  ///< mm from the source to the plane along the beam's middle
    TablePlaneFault fault = TablePlaneFault::None;
};

/// One pixel's edge where the beam's middle meets the plane `object` mm above the table's top, which is `tableTop` mm below the isocentre
/// (negative: above it). DICOM's model, PS3.3 C.8.19.6.9.1: imager spacing x SOD / SID with SOD = ISO - (TH - TO) / cos(beam angle), and
/// cos(beam angle) = |cos primary| x |cos secondary| for a patient on the back or the belly, PS3.17 FFF.1.3. TH is `tableTop`, TO is
/// `object`, ISO the frame's SOD, which the message sets count to the isocentre. Past 60 degrees the standard does not trust it; nor does
/// it hold for a source above the table, which angles of a patient on the back tell. Then, and where a number is none, there is a fault
/// and no size: never that of another plane.
TablePlane tablePlaneOf(const XrayFrame& frame, double tableTop, double object);

} // namespace console
