// The vascular tree as centre lines with radii, read from an SWC file, and the way along it to a point.
#pragma once

#include <QString>
#include <QVector3D>

#include <optional>
#include <vector>

namespace console {

/// Points of the patient frame, in mm. `parent` is the place of the parent in `VesselTree::points`, −1 at a root; a parent stands before
/// its children.
struct VesselPoint {
    QVector3D position;
    float radius = 0;
    int parent = -1;
};

struct VesselTree {
    std::vector<VesselPoint> points;

    bool isEmpty() const { return points.empty(); }

    /// Centre-line points from a root to the point next to `target`, root first. Empty when no point is within `reach` mm of it: a wire is
    /// never drawn along a vessel in which the tip is not.
    std::vector<QVector3D> wayTo(const QVector3D& target, float reach) const;
};

struct VesselTreeResult {
    std::optional<VesselTree> tree;
    QString error; ///< Names file, line and remedy when there is no tree.
};

/// SWC: number, kind, x, y, z, radius, parent's number; `#` starts a comment. Refuses more than 200 000 points and lengths that are not
/// finite.
VesselTreeResult readVesselTree(const QString& path);

} // namespace console
