// A picture ready for the screen, with everything that must be said about it.
#include "imaging/display_picture.hpp"

#include <cmath>

namespace console {

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

} // namespace console
