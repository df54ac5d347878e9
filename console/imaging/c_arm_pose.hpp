// Where the X-ray source and the detector stand in space, and the way from the patient frame to the scene.
#pragma once

#include <QChar>
#include <QSizeF>
#include <QVector3D>

#include <optional>

namespace console {

/// The patient frame of the message sets has x to the patient's right, y to the back and z to the head, and is left-handed. The scene draws
/// in the right-handed frame of DICOM (x left, y back, z head); this is the only place where the one becomes the other.
QVector3D toScene(const QVector3D& patient);

/// As the X-ray system reports it: DICOM positioner angles in degrees (LAO and CRA positive), distances in mm.
struct CArmGeometry {
    double primaryAngle = 0;
    double secondaryAngle = 0;
    double sourceDetectorDistance = 0;
    double sourceObjectDistance = 0;
    QSizeF detectorSize; ///< Width and height of the picture at the detector, mm; empty when the pixel spacing is unknown.
    QVector3D table;     ///< Lateral, longitudinal, height, mm.

    bool operator==(const CArmGeometry&) const = default;
};

/// The picture's axes in the scene's frame, unit length; they follow from the angles alone.
struct PictureAxes {
    QVector3D right; ///< along the rows
    QVector3D up;    ///< against the columns
    QVector3D beam;  ///< from the source to the detector
};

PictureAxes axesOf(double primaryAngle, double secondaryAngle);

/// L, R, A, P, H or F: the side of the patient that lies most in this direction of the scene.
QChar sideLetter(const QVector3D& direction);

/// In the scene's frame. With the table at zero the isocentre is the origin of the patient frame.
struct CArmPose {
    QVector3D source;
    QVector3D detector; ///< The detector's middle.
    PictureAxes axes;
    QSizeF detectorSize;

    QVector3D corner(double horizontal, double vertical) const; ///< ±1 each.
};

/// Nothing when the geometry is unknown or makes no sense (SOD not between 0 and SID).
std::optional<CArmPose> poseOf(const CArmGeometry& geometry);

} // namespace console
