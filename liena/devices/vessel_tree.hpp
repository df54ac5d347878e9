// A tree of vessels as centre line and radius, read from and written to SWC, and the wire's way through it.
#pragma once

#include "geometry.hpp"

#include "liena/error.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace liena::devices {

struct VesselPoint {
    Vector position; ///< mm
    double radius = 0;
    std::optional<std::size_t> parent; ///< position in the tree, lower than the point's own; none for the root
};

/// One root; every other point follows its parent.
struct VesselTree {
    std::vector<VesselPoint> points;

    /// SWC: `id type x y z radius parent` per line, `#` begins a comment, parent −1 is the root. Errors name `name`, line and remedy.
    static Result<VesselTree> parse(std::string_view text, const std::string& name);
    static Result<VesselTree> load(const std::filesystem::path& file);

    std::string toSwc() const;

    /// A cerebral tree made by rule: descending aorta, arch, both carotids with siphon and middle and anterior cerebral arteries, external
    /// carotids, vertebral and basilar arteries with their branches. The same points on every machine.
    static VesselTree cerebral();
};

/// Where the wire is at one arc length.
struct WayPoint {
    Vector position;
    Vector direction; ///< unit, along the way
    double radius = 0;
    double curvature = 0; ///< 1/mm
};

/// The way of guidewire and catheter: from the root to the end that is farthest along the centre line. Arc length 0 is the sheath.
class VesselWay {
public:
    /// The tree has at least two points, as parse() and cerebral() see to.
    explicit VesselWay(const VesselTree& tree);

    double length() const { return m_nodes.back().arc; }

    /// Beyond the ends it is the end.
    WayPoint at(double arc) const;

    /// Arc lengths at which another vessel leaves the way.
    const std::vector<double>& branches() const { return m_branches; }

    /// Integral of the curvature from the sheath, in rad: what the wire is bent by.
    double bendUntil(double arc) const;

    /// For each point of the tree, the arc length at which it, or the vessel that leads to it, leaves the way.
    const std::vector<double>& leaves() const { return m_leaves; }

    /// For each point of the tree, its distance from the root along the vessels.
    const std::vector<double>& distances() const { return m_distances; }

private:
    struct Node {
        Vector position;
        double radius = 0;
        double arc = 0;
        double bend = 0;
        double curvature = 0;
    };

    void collect(const VesselTree& tree);
    void measureBends();
    std::size_t nodeBefore(double arc) const;

    std::vector<Node> m_nodes;
    std::vector<double> m_branches;
    std::vector<double> m_leaves;
    std::vector<double> m_distances;
};

} // namespace liena::devices
