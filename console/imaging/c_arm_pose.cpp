// Where the X-ray source and the detector stand in space, and the way from the patient frame to the scene.
#include "imaging/c_arm_pose.hpp"

#include <QtMath>

#include <cmath>

namespace console {

namespace {

QVector3D vector(double x, double y, double z) { return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)}; }

bool makesSense(const CArmGeometry& geometry)
{
    return std::isfinite(geometry.primaryAngle) && std::isfinite(geometry.secondaryAngle) && geometry.sourceObjectDistance > 0 &&
           geometry.sourceDetectorDistance > geometry.sourceObjectDistance && geometry.sourceDetectorDistance <= 2000 &&
           geometry.detectorSize.width() > 0 && geometry.detectorSize.width() < 5000 && geometry.detectorSize.height() > 0 &&
           geometry.detectorSize.height() < 5000;
}

} // namespace

QVector3D toScene(const QVector3D& patient) { return {-patient.x(), patient.y(), patient.z()}; }

PictureAxes axesOf(double primaryAngle, double secondaryAngle)
{
    const double p = qDegreesToRadians(primaryAngle);
    const double s = qDegreesToRadians(secondaryAngle);
    // At 0/0 the detector is in front of the patient; LAO carries it to the left, CRA to the head.
    return {vector(std::cos(p), std::sin(p), 0), vector(-std::sin(p) * std::sin(s), std::cos(p) * std::sin(s), std::cos(s)),
            vector(std::sin(p) * std::cos(s), -std::cos(p) * std::cos(s), std::sin(s))};
}

QChar sideLetter(const QVector3D& direction)
{
    const float x = std::abs(direction.x());
    const float y = std::abs(direction.y());
    const float z = std::abs(direction.z());
    if (x >= y && x >= z)
        return QLatin1Char(direction.x() > 0 ? 'L' : 'R');
    if (y >= z)
        return QLatin1Char(direction.y() > 0 ? 'P' : 'A');
    return QLatin1Char(direction.z() > 0 ? 'H' : 'F');
}

QVector3D CArmPose::corner(double horizontal, double vertical) const
{
    return detector + axes.right * static_cast<float>(horizontal * detectorSize.width() / 2) +
           axes.up * static_cast<float>(vertical * detectorSize.height() / 2);
}

std::optional<CArmPose> poseOf(const CArmGeometry& geometry)
{
    if (!makesSense(geometry))
        return std::nullopt;
    CArmPose pose;
    pose.axes = axesOf(geometry.primaryAngle, geometry.secondaryAngle);
    // The table carries the patient; seen from the patient the C-arm moves the other way.
    const QVector3D isocentre = -toScene({geometry.table.x(), -geometry.table.z(), geometry.table.y()});
    pose.source = isocentre - pose.axes.beam * static_cast<float>(geometry.sourceObjectDistance);
    pose.detector = isocentre + pose.axes.beam * static_cast<float>(geometry.sourceDetectorDistance - geometry.sourceObjectDistance);
    pose.detectorSize = geometry.detectorSize;
    return pose;
}

} // namespace console
