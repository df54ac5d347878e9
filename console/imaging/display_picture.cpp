// A picture ready for the screen, with everything that must be said about it.
#include "imaging/display_picture.hpp"

#include <QtMath>

#include <cmath>

namespace console {

namespace {

constexpr double farthestFromUpright = 60 + 1e-6; ///< deg; 60 itself is within, whatever its cosine is rounded to

} // namespace

CArmGeometry geometryOf(const XrayFrame& frame)
{
    return {frame.geometry.primaryAngle,
            frame.geometry.secondaryAngle,
            frame.geometry.sourceDetectorDistance,
            frame.geometry.sourceObjectDistance,
            QSizeF(frame.columns, frame.rows) * frame.imagerPixelSpacing,
            {}};
}

WindowBasis basisOf(const XrayFrame& frame) { return {frame.bitsStored, {frame.windowCentre, frame.windowWidth}}; }

std::optional<double> pixelSizeAtIsocentre(const XrayFrame& frame)
{
    const XrayGeometry& geometry = frame.geometry;
    const bool known = frame.imagerPixelSpacing > 0 && geometry.sourceObjectDistance > 0 &&
                       geometry.sourceDetectorDistance >= geometry.sourceObjectDistance;
    if (!known)
        return std::nullopt;
    const double size = frame.imagerPixelSpacing * geometry.sourceObjectDistance / geometry.sourceDetectorDistance;
    return std::isfinite(size) && size > 0 ? std::optional(size) : std::nullopt;
}

TablePlane tablePlaneOf(const XrayFrame& frame, double tableTop, double object)
{
    const auto refuse = [](TablePlaneFault fault) { return TablePlane{0, 0, fault}; };
    const XrayGeometry& geometry = frame.geometry;
    const double cosine = std::cos(qDegreesToRadians(geometry.primaryAngle)) * std::cos(qDegreesToRadians(geometry.secondaryAngle));
    if (!pixelSizeAtIsocentre(frame) || !std::isfinite(cosine))
        return refuse(TablePlaneFault::GeometryUnknown);
    if (!std::isfinite(tableTop) || !std::isfinite(object))
        return refuse(TablePlaneFault::HeightUnknown);
    if (qRadiansToDegrees(std::acos(std::abs(cosine))) > farthestFromUpright)
        return refuse(TablePlaneFault::TooOblique);
    if (cosine < 0)
        return refuse(TablePlaneFault::SourceAbove);
    const double distance = geometry.sourceObjectDistance - (tableTop - object) / cosine;
    if (!(distance > 0) || !(distance < geometry.sourceDetectorDistance))
        return refuse(TablePlaneFault::OutsideBeam);
    return {frame.imagerPixelSpacing * distance / geometry.sourceDetectorDistance, distance, TablePlaneFault::None};
}

} // namespace console
