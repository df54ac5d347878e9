// The built-in cerebral tree, made by rule.
#include "vessel_tree.hpp"

#include <algorithm>

namespace liena::devices {

namespace {

constexpr double spacing = 2.6; // mm between points

// Its own generator: the library's distributions differ between implementations, and the tree must not.
class Draw {
public:
    explicit Draw(std::uint64_t seed) : m_state(seed) {}

    double between(double low, double high)
    {
        m_state += 0x9E3779B97F4A7C15ULL;
        std::uint64_t mixed = m_state;
        mixed = (mixed ^ (mixed >> 30U)) * 0xBF58476D1CE4E5B9ULL;
        mixed = (mixed ^ (mixed >> 27U)) * 0x94D049BB133111EBULL;
        mixed ^= mixed >> 31U;
        return low + (high - low) * static_cast<double>(mixed >> 11U) * 0x1.0p-53;
    }

private:
    std::uint64_t m_state;
};

struct Knot {
    Vector position;
    double radius = 0;
};

Vector spline(Vector a, Vector b, Vector c, Vector d, double t)
{
    return (b * 2 + (c - a) * t + (a * 2 - b * 5 + c * 4 - d) * (t * t) + (b * 3 - a - c * 3 + d) * (t * t * t)) * 0.5;
}

class TreeBuilder {
public:
    // A vessel through the knots, from `parent` on; the index of its last point. Without a parent the first knot is the root.
    std::size_t grow(std::optional<std::size_t> parent, std::vector<Knot> knots)
    {
        std::size_t last = parent ? *parent : add(knots.front(), std::nullopt);
        if (parent)
            knots.insert(knots.begin(), {m_tree.points[last].position, std::min(m_tree.points[last].radius, knots.front().radius * 1.3)});
        for (std::size_t index = 0; index + 1 < knots.size(); ++index)
            last = growPiece(last, knots, index);
        return last;
    }

    // The point nearest to a place: where another vessel leaves.
    std::size_t nearest(Vector place) const
    {
        const auto nearer = [&](const VesselPoint& a, const VesselPoint& b) {
            return length(a.position - place) < length(b.position - place);
        };
        return static_cast<std::size_t>(std::min_element(m_tree.points.begin(), m_tree.points.end(), nearer) - m_tree.points.begin());
    }

    // Small vessels that fork and wander outwards, `levels` deep.
    void sprout(std::size_t from, Vector direction, double reach, int levels, Draw& draw)
    {
        if (levels == 0)
            return;
        const VesselPoint start = m_tree.points[from];
        const Vector sideways{draw.between(-1, 1), draw.between(-1, 1), draw.between(-1, 1)};
        const Vector heading = normalised(normalised(direction) + sideways * 0.45);
        const double radius = std::max(0.35, start.radius * 0.8);
        const Vector bow = cross(heading, normalised(sideways)) * (reach * 0.12);
        const std::size_t end =
            grow(from, {{start.position + heading * (reach * 0.5) + bow, radius}, {start.position + heading * reach, radius * 0.85}});
        sprout(end, heading, reach * 0.75, levels - 1, draw);
        sprout(end, heading + sideways * -0.8, reach * 0.7, levels - 1, draw);
    }

    VesselTree take() { return std::move(m_tree); }

private:
    std::size_t add(const Knot& knot, std::optional<std::size_t> parent)
    {
        // Rounded as the file is, so that a tree from the file is the same tree.
        const auto rounded = [](double value) { return std::round(value * 1000) / 1000; };
        const Vector position{rounded(knot.position.x), rounded(knot.position.y), rounded(knot.position.z)};
        m_tree.points.push_back({position, rounded(knot.radius), parent});
        return m_tree.points.size() - 1;
    }

    std::size_t growPiece(std::size_t last, const std::vector<Knot>& knots, std::size_t index)
    {
        const Knot& from = knots[index];
        const Knot& to = knots[index + 1];
        const Vector before = index > 0 ? knots[index - 1].position : from.position * 2 - to.position;
        const Vector after = index + 2 < knots.size() ? knots[index + 2].position : to.position * 2 - from.position;
        const int steps = std::max(1, static_cast<int>(std::lround(length(to.position - from.position) / spacing)));
        for (int step = 1; step <= steps; ++step) {
            const double t = static_cast<double>(step) / steps;
            last = add({spline(before, from.position, to.position, after, t), from.radius + (to.radius - from.radius) * t}, last);
        }
        return last;
    }

    VesselTree m_tree;
};

// `side` is −1 for the patient's left, +1 for the right.
Vector mirrored(Vector position, double side) { return {position.x * side, position.y, position.z}; }

std::vector<Knot> mirrored(std::vector<Knot> knots, double side)
{
    for (auto& knot : knots)
        knot.position = mirrored(knot.position, side);
    return knots;
}

void growMiddleCerebral(TreeBuilder& tree, std::size_t carotidEnd, double side, Draw& draw)
{
    const std::size_t fork = tree.grow(carotidEnd, mirrored({{{22, -8, -13}, 1.5}, {{32, -7, -11}, 1.4}, {{41, -4, -9}, 1.3}}, side));
    const std::size_t upper = tree.grow(fork, mirrored({{{47, -2, -2}, 1.1},
                                                        {{50, 4, 9}, 1.0},
                                                        {{51, 14, 20}, 0.9},
                                                        {{53, 27, 30}, 0.8},
                                                        {{50, 42, 38}, 0.7},
                                                        {{44, 54, 44}, 0.6},
                                                        {{36, 62, 50}, 0.5}},
                                                       side));
    const std::size_t lower =
        tree.grow(fork, mirrored({{{48, 4, -8}, 1.1}, {{53, 16, -4}, 0.9}, {{56, 30, 2}, 0.8}, {{54, 44, 8}, 0.7}}, side));
    tree.sprout(lower, mirrored({0, 1, 0.3}, side), 16, 3, draw);
    tree.sprout(tree.nearest(mirrored({50, 4, 9}, side)), mirrored({0.5, -0.6, 1}, side), 20, 4, draw);
    tree.sprout(tree.nearest(mirrored({53, 27, 30}, side)), mirrored({0.3, 0.1, 1}, side), 16, 3, draw);
    tree.sprout(upper, mirrored({-0.6, 0.5, 0.4}, side), 7, 2, draw);
}

void growAnteriorCerebral(TreeBuilder& tree, std::size_t carotidEnd, double side, Draw& draw)
{
    const std::size_t end = tree.grow(carotidEnd, mirrored({{{9, -13, -13}, 1.2},
                                                            {{3.5, -18, -10}, 1.1},
                                                            {{3, -27, 0}, 1.0},
                                                            {{3, -38, 12}, 0.95},
                                                            {{3, -42, 26}, 0.9},
                                                            {{3, -34, 40}, 0.8},
                                                            {{3, -18, 49}, 0.7}},
                                                           side));
    tree.sprout(end, mirrored({0.1, 1, 0.3}, side), 16, 3, draw);
    tree.sprout(tree.nearest(mirrored({3, -38, 12}, side)), mirrored({0.2, -0.8, 0.8}, side), 15, 3, draw);
}

void growExternalCarotid(TreeBuilder& tree, std::size_t bifurcation, double side, Draw& draw)
{
    const std::size_t end = tree.grow(bifurcation, mirrored({{{32, -6, -122}, 2.0},
                                                             {{39, -10, -104}, 1.8},
                                                             {{50, -4, -84}, 1.6},
                                                             {{60, 4, -62}, 1.3},
                                                             {{68, 4, -38}, 1.1},
                                                             {{72, 2, -12}, 0.9}},
                                                            side));
    tree.sprout(end, mirrored({0.1, -0.4, 1}, side), 18, 3, draw);
    tree.sprout(tree.nearest(mirrored({39, -10, -104}, side)), mirrored({0, -1, 0.3}, side), 20, 2, draw);
}

void growCarotid(TreeBuilder& tree, std::size_t from, std::vector<Knot> common, double side, Draw& draw)
{
    const std::size_t bifurcation = tree.grow(from, std::move(common));
    const std::size_t end = tree.grow(bifurcation, mirrored({{{31, 9, -120}, 2.6},
                                                             {{29, 8, -100}, 2.4},
                                                             {{27, 2, -80}, 2.4},
                                                             {{29, 1, -62}, 2.3},
                                                             {{26, 0, -50}, 2.2},
                                                             {{17, -5, -45}, 2.2},
                                                             {{13, -14, -39}, 2.1},
                                                             {{13, -24, -33}, 2.0},
                                                             {{14, -28, -27}, 1.9},
                                                             {{14, -24, -21}, 1.9},
                                                             {{14, -16, -18}, 1.8},
                                                             {{15, -9, -15}, 1.7}},
                                                            side));
    growMiddleCerebral(tree, end, side, draw);
    growAnteriorCerebral(tree, end, side, draw);
    growExternalCarotid(tree, bifurcation, side, draw);
    const std::size_t communicating = tree.nearest(mirrored({14, -20, -19}, side));
    tree.grow(communicating, mirrored({{{12, -8, -20}, 0.7}, {{9, 4, -19}, 0.7}}, side));
}

void growVertebrals(TreeBuilder& tree, std::size_t leftSubclavian, std::size_t rightSubclavian, Draw& draw)
{
    const std::vector<Knot> neck{
        {{20, 18, -175}, 1.7}, {{19, 19, -140}, 1.6}, {{19, 20, -110}, 1.6}, {{23, 24, -94}, 1.6}, {{14, 30, -84}, 1.5}};
    const std::size_t left = tree.grow(leftSubclavian, mirrored(neck, -1));
    const std::size_t junction = tree.grow(left, {{{-6, 20, -68}, 1.5}, {{0, 13, -56}, 1.7}});
    const std::size_t right = tree.grow(rightSubclavian, mirrored(neck, 1));
    tree.grow(right, {{{6, 20, -68}, 1.4}, {{1.5, 14.5, -58}, 1.3}});
    const std::size_t basilar = tree.grow(junction, {{{0.5, 8, -42}, 1.7}, {{-0.5, 5, -28}, 1.6}, {{0, 6, -18}, 1.5}});
    for (const double side : {-1.0, 1.0}) {
        const std::size_t end = tree.grow(
            basilar,
            mirrored({{{7, 6, -17}, 1.2}, {{17, 14, -15}, 1.1}, {{22, 28, -12}, 1.0}, {{19, 44, -6}, 0.9}, {{14, 58, 0}, 0.8}}, side));
        tree.sprout(end, mirrored({0, 1, 0.4}, side), 14, 3, draw);
        const std::size_t cerebellar = tree.grow(tree.nearest({0.5, 8, -42}), mirrored({{{12, 16, -44}, 0.7}, {{26, 30, -46}, 0.6}}, side));
        tree.sprout(cerebellar, mirrored({0.4, 1, -0.2}, side), 14, 2, draw);
    }
}

} // namespace

VesselTree VesselTree::cerebral()
{
    TreeBuilder tree;
    Draw draw(20240501);
    const std::size_t arch =
        tree.grow(std::nullopt,
                  {{{-12, 48, -440}, 11}, {{-13, 46, -390}, 11}, {{-14, 42, -340}, 11.5}, {{-15, 32, -300}, 12}, {{-12, 12, -282}, 12.5}});
    tree.grow(arch, {{{0, -6, -282}, 13}, {{12, -22, -300}, 13.5}, {{12, -26, -330}, 14}});
    growCarotid(tree, arch,
                {{{-14, 8, -268}, 3.6}, {{-18, 6, -240}, 3.3}, {{-22, 4, -200}, 3.2}, {{-26, 4, -165}, 3.2}, {{-28, 4, -138}, 3.6}}, -1,
                draw);
    const std::size_t trunk = tree.grow(tree.nearest({0, -6, -282}), {{{4, -4, -262}, 5.5}, {{12, -2, -244}, 5.0}});
    growCarotid(tree, trunk, {{{18, 2, -225}, 3.3}, {{22, 4, -200}, 3.2}, {{26, 4, -165}, 3.2}, {{28, 4, -138}, 3.6}}, 1, draw);
    tree.grow(trunk, {{{26, 8, -232}, 4.2}, {{44, 12, -230}, 4.0}, {{70, 14, -238}, 3.6}});
    tree.grow(tree.nearest({-14, 26, -293}),
              {{{-20, 24, -268}, 4.5}, {{-28, 16, -240}, 4.2}, {{-46, 14, -230}, 4.0}, {{-72, 14, -238}, 3.6}});
    growVertebrals(tree, tree.nearest({-28, 16, -240}), tree.nearest({26, 8, -232}), draw);
    return tree.take();
}

} // namespace liena::devices
