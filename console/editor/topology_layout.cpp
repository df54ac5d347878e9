// Lanes from left to right, rows from top to bottom.
#include "editor/topology_layout.hpp"

#include <QStringList>

#include <algorithm>
#include <map>

namespace console {

namespace {

constexpr double laneWidth = 300;
constexpr double laneGap = 390;
constexpr double rowPitch = 168;
constexpr double headRoom = 56;
constexpr double firstBracket = 34;
constexpr double bracketStep = 30;
constexpr double labelRoom = 165;

QStringList sitesInOrder(const SessionModel& sessions)
{
    QStringList sites;
    if (const DeviceNode* self = sessions.self())
        sites << self->site;
    for (const DeviceNode& device : sessions.devices())
        if (!sites.contains(device.site))
            sites << device.site;
    return sites;
}

PlacedLink straight(quint32 a, quint32 b, const QRectF& from, const QRectF& to)
{
    const bool rightwards = from.center().x() < to.center().x();
    const QPointF p(rightwards ? from.right() : from.left(), from.center().y());
    const QPointF q(rightwards ? to.left() : to.right(), to.center().y());
    PlacedLink link{a, b, {p, q}, QLineF(p, q), {}, {}, false};
    link.label = link.shaft.pointAt(0.5);
    link.labelWhenBroken = link.shaft.pointAt(rightwards ? 0.76 : 0.24);
    return link;
}

PlacedLink bracket(quint32 a, quint32 b, const QRectF& from, const QRectF& to, double out)
{
    const QPointF p(from.right(), from.center().y() + nodeHeight * 0.2);
    const QPointF q(to.right(), to.center().y() - nodeHeight * 0.2);
    const double x = std::max(p.x(), q.x()) + out;
    PlacedLink link{a, b, {p, {x, p.y()}, {x, q.y()}, q}, QLineF(x, p.y(), x, q.y()), {}, {}, true};
    link.label = QPointF(x + 14, (p.y() + q.y()) / 2);
    link.labelWhenBroken = link.label;
    return link;
}

} // namespace

TopologyPlan planTopology(const SessionModel& sessions)
{
    TopologyPlan plan;
    const QStringList sites = sitesInOrder(sessions);
    std::map<quint32, std::size_t> placeOf;
    std::map<quint32, qsizetype> laneOf;
    std::vector<int> rows(std::size_t(sites.size()), 0);
    for (const DeviceNode& device : sessions.devices())
        ++rows[std::size_t(sites.indexOf(device.site))];
    const int most = rows.empty() ? 1 : std::max(1, *std::max_element(rows.begin(), rows.end()));
    const double tall = most * rowPitch;
    std::vector<int> next(std::size_t(sites.size()), 0);
    for (const DeviceNode& device : sessions.devices()) {
        const qsizetype lane = sites.indexOf(device.site);
        const double centreX = double(lane) * (laneWidth + laneGap) + laneWidth / 2;
        const double pitch = tall / rows[std::size_t(lane)];
        const double centreY = headRoom + pitch * (next[std::size_t(lane)]++ + 0.5);
        placeOf[device.id] = plan.devices.size();
        laneOf[device.id] = lane;
        plan.devices.push_back({device.id, QRectF(centreX - nodeWidth / 2, centreY - nodeHeight / 2, nodeWidth, nodeHeight)});
    }
    for (qsizetype i = 0; i < sites.size(); ++i)
        plan.lanes.push_back({sites[i], QRectF(double(i) * (laneWidth + laneGap), 0, laneWidth, headRoom + tall)});
    std::vector<int> brackets(std::size_t(sites.size()), 0);
    double right = double(sites.size()) * laneWidth + double(std::max<qsizetype>(0, sites.size() - 1)) * laneGap;
    for (const LinkNode& link : sessions.links()) {
        if (!placeOf.contains(link.a) || !placeOf.contains(link.b))
            continue;
        const QRectF& from = plan.devices[placeOf[link.a]].box;
        const QRectF& to = plan.devices[placeOf[link.b]].box;
        if (laneOf[link.a] != laneOf[link.b]) {
            plan.links.push_back(straight(link.a, link.b, from, to));
            continue;
        }
        const bool down = from.center().y() < to.center().y();
        const double out = (laneWidth - nodeWidth) / 2 + firstBracket + bracketStep * brackets[std::size_t(laneOf[link.a])]++;
        plan.links.push_back(down ? bracket(link.a, link.b, from, to, out) : bracket(link.b, link.a, to, from, out));
        right = std::max(right, plan.links.back().label.x() + labelRoom);
    }
    plan.bounds = QRectF(0, 0, right, headRoom + tall).adjusted(-12, -12, 12, 12);
    return plan;
}

} // namespace console
