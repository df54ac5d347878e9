// The instrument's tip as the scene shows it.
#pragma once

#include <QVector3D>

namespace console {

/// As the tracker reports it, in the patient frame, mm. `isStale`: the report is older than it should be.
struct TrackedTip {
    QVector3D position;
    QVector3D direction;
    float error = 0;
    bool isStale = false;

    bool operator==(const TrackedTip&) const = default;
};

} // namespace console
