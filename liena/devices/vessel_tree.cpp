// The wire's way through a vessel tree.
#include "vessel_tree.hpp"

#include <algorithm>

namespace liena::devices {

VesselWay::VesselWay(const VesselTree& tree)
{
    collect(tree);
    measureBends();
}

void VesselWay::collect(const VesselTree& tree)
{
    const auto& points = tree.points;
    m_distances.assign(points.size(), 0);
    std::vector<std::size_t> children(points.size(), 0);
    for (std::size_t index = 0; index < points.size(); ++index)
        if (const auto parent = points[index].parent) {
            m_distances[index] = m_distances[*parent] + devices::length(points[index].position - points[*parent].position);
            ++children[*parent];
        }
    const auto end = std::max_element(m_distances.begin(), m_distances.end()) - m_distances.begin();
    std::vector<bool> onWay(points.size(), false);
    for (std::optional<std::size_t> index = static_cast<std::size_t>(end); index; index = points[*index].parent)
        onWay[*index] = true;
    m_leaves.assign(points.size(), 0);
    for (std::size_t index = 0; index < points.size(); ++index) {
        m_leaves[index] = onWay[index] || !points[index].parent ? m_distances[index] : m_leaves[*points[index].parent];
        if (!onWay[index])
            continue;
        m_nodes.push_back({points[index].position, points[index].radius, m_distances[index]});
        if (children[index] > 1)
            m_branches.push_back(m_distances[index]);
    }
}

// Curvature from the turn of the direction over some millimetres: scanned centre lines are too ragged for less.
void VesselWay::measureBends()
{
    constexpr double reach = 4;
    for (auto& node : m_nodes) {
        const Vector before = node.position - at(node.arc - reach).position;
        const Vector after = at(node.arc + reach).position - node.position;
        const double turn = std::acos(std::clamp(dot(normalised(before), normalised(after)), -1.0, 1.0));
        const double span = (devices::length(before) + devices::length(after)) / 2;
        const bool measurable = devices::length(before) > 0 && devices::length(after) > 0;
        node.curvature = measurable ? turn / span : 0;
    }
    for (std::size_t index = 1; index < m_nodes.size(); ++index) {
        const auto& previous = m_nodes[index - 1];
        auto& node = m_nodes[index];
        node.bend = previous.bend + (previous.curvature + node.curvature) / 2 * (node.arc - previous.arc);
    }
}

std::size_t VesselWay::nodeBefore(double arc) const
{
    const auto after =
        std::upper_bound(m_nodes.begin(), m_nodes.end(), arc, [](double value, const Node& node) { return value < node.arc; });
    const auto index = static_cast<std::size_t>(after - m_nodes.begin());
    return std::clamp<std::size_t>(index, 1, m_nodes.size() - 1) - 1;
}

WayPoint VesselWay::at(double arc) const
{
    const auto& a = m_nodes[nodeBefore(arc)];
    const auto& b = m_nodes[nodeBefore(arc) + 1];
    const double span = b.arc - a.arc;
    const double part = span > 0 ? std::clamp((arc - a.arc) / span, 0.0, 1.0) : 0;
    return {a.position + (b.position - a.position) * part, normalised(b.position - a.position), a.radius + (b.radius - a.radius) * part,
            a.curvature + (b.curvature - a.curvature) * part};
}

double VesselWay::bendUntil(double arc) const
{
    const auto& a = m_nodes[nodeBefore(arc)];
    const auto& b = m_nodes[nodeBefore(arc) + 1];
    const double span = b.arc - a.arc;
    const double part = span > 0 ? std::clamp((arc - a.arc) / span, 0.0, 1.0) : 0;
    return a.bend + (b.bend - a.bend) * part;
}

} // namespace liena::devices
