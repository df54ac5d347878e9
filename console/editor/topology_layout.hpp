// Where devices and links of a topology stand on the canvas: lanes by site, rows in the topology's order. Pure and deterministic.
#pragma once

#include "model/session_model.hpp"

#include <QLineF>
#include <QPointF>
#include <QRectF>
#include <QString>

#include <vector>

namespace console {

struct PlacedDevice {
    quint32 id = 0;
    QRectF box;
};

/// A link within one lane goes out beside it and back; a link between lanes is one straight way.
struct PlacedLink {
    quint32 a = 0;
    quint32 b = 0;
    std::vector<QPointF> way; ///< 2 or 4 points, from a to b
    QLineF shaft;             ///< the part that carries the arrows
    QPointF label;            ///< centre of the label between lanes, its left edge's centre beside a lane
    QPointF labelWhenBroken;  ///< leaves the cross in the middle free
    bool besideLane = false;
};

struct Lane {
    QString site;
    QRectF area;
};

struct TopologyPlan {
    std::vector<Lane> lanes;
    std::vector<PlacedDevice> devices;
    std::vector<PlacedLink> links;
    QRectF bounds;
};

inline constexpr double nodeWidth = 264;
inline constexpr double nodeHeight = 96;

/// The console's own site is the first lane. The same devices and links give the same plan.
TopologyPlan planTopology(const SessionModel& sessions);

} // namespace console
