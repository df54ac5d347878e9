// The head phantom: its parts and their projection.
#include "head_phantom.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

namespace liena::devices {

namespace {

struct Ellipsoid {
    Vector centre; ///< mm
    Vector radii;
    double attenuation = 0; ///< 1/mm, added to what is there already
};

constexpr double tissue = 0.019; // 1/mm, water at the beam's mean energy

// Head, neck and chest; where they overlap there is tissue once.
constexpr std::array<Ellipsoid, 3> body{
    {{{0, 5, -8}, {78, 98, 104}, tissue}, {{0, 14, -140}, {66, 74, 125}, tissue}, {{0, 25, -330}, {175, 105, 130}, tissue}}};

constexpr Ellipsoid skullOutside{{0, 5, -2}, {73, 92, 94}, 0.026};
constexpr Ellipsoid skullInside{{0, 5, -1}, {67, 86, 88}, -0.026};

std::vector<Ellipsoid> skeleton()
{
    std::vector<Ellipsoid> parts{skullOutside,
                                 skullInside,
                                 {{0, 2, -52}, {52, 56, 8}, 0.0045},    // base of the skull
                                 {{0, -36, -108}, {44, 46, 14}, 0.009}, // mandible
                                 {{0, -28, -104}, {36, 42, 18}, -0.007},
                                 {{0, -92, -4}, {20, 5, 11}, -0.016},   // frontal sinus
                                 {{0, -40, -38}, {14, 12, 11}, -0.017}, // sphenoid sinus
                                 {{0, -2, -165}, {8, 8, 75}, -0.018}};  // trachea
    for (const double side : {-1.0, 1.0}) {
        parts.push_back({{side * 34, 16, -46}, {27, 9, 9}, 0.022});     // petrous bone
        parts.push_back({{side * 31, -66, -36}, {17, 18, 16}, -0.006}); // orbit
        parts.push_back({{side * 26, -66, -70}, {13, 15, 15}, -0.017}); // maxillary sinus
        parts.push_back({{side * 66, 22, -58}, {9, 12, 12}, -0.008});   // mastoid cells
    }
    for (int vertebra = 0; vertebra < 14; ++vertebra)
        parts.push_back({{0, 34.0 + vertebra * 0.8, -78.0 - vertebra * 17.5}, {13.0 + vertebra * 0.3, 13, 6.8}, 0.019});
    return parts;
}

// The rays to the pixels, scaled so that an ellipsoid is the unit sphere.
class ScaledRays {
public:
    ScaledRays(const CArmProjection& projection, const Ellipsoid& ellipsoid, Vector origin) : m_radii(ellipsoid.radii)
    {
        m_start = scaled(projection.source() - origin - ellipsoid.centre);
        m_corner = scaled(projection.detectorCorner() - projection.source());
        m_column = scaled(projection.columnStep());
        m_row = scaled(projection.rowStep());
        m_outside = dot(m_start, m_start) - 1;
    }

    // Entry and exit as parts of the way from the source to the detector; equal when the ray misses.
    std::pair<double, double> interval(int row, int column) const
    {
        const Vector ray = m_corner + m_column * column + m_row * row;
        const double square = dot(ray, ray);
        const double along = -dot(m_start, ray);
        const double discriminant = along * along - square * m_outside;
        if (discriminant <= 0)
            return {0, 0};
        const double half = std::sqrt(discriminant);
        return {(along - half) / square, (along + half) / square};
    }

private:
    Vector scaled(Vector vector) const { return {vector.x / m_radii.x, vector.y / m_radii.y, vector.z / m_radii.z}; }

    Vector m_radii;
    Vector m_start;
    Vector m_corner;
    Vector m_column;
    Vector m_row;
    double m_outside = 0;
};

struct Box {
    int top = 0;
    int bottom = 0; ///< one beyond
    int left = 0;
    int right = 0;
};

// The pixels that the ellipsoid's shadow can touch.
Box shadow(const CArmProjection& projection, const Ellipsoid& ellipsoid, Vector origin)
{
    const auto spot = projection.project(origin + ellipsoid.centre);
    const double largest = std::max({ellipsoid.radii.x, ellipsoid.radii.y, ellipsoid.radii.z});
    const double reach = largest * spot.magnification * 1.25 + 2;
    const auto clamp = [&](double value) { return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(projection.size()))); };
    return {clamp(spot.row - reach), clamp(spot.row + reach + 1), clamp(spot.column - reach), clamp(spot.column + reach + 1)};
}

double rayLength(const CArmProjection& projection, int row, int column)
{
    return length(projection.detectorCorner() + projection.columnStep() * column + projection.rowStep() * row - projection.source());
}

double unionLength(std::span<std::pair<double, double>> intervals)
{
    std::sort(intervals.begin(), intervals.end());
    double total = 0;
    double until = 0;
    for (const auto& [entry, exit] : intervals) {
        total += std::max(0.0, exit - std::max(entry, until));
        until = std::max(until, exit);
    }
    return total;
}

void addBody(const CArmProjection& projection, Vector origin, std::vector<float>& lines)
{
    const std::array rays{ScaledRays(projection, body[0], origin), ScaledRays(projection, body[1], origin),
                          ScaledRays(projection, body[2], origin)};
    auto line = lines.begin();
    for (int row = 0; row < projection.size(); ++row)
        for (int column = 0; column < projection.size(); ++column, ++line) {
            std::array intervals{rays[0].interval(row, column), rays[1].interval(row, column), rays[2].interval(row, column)};
            *line = static_cast<float>(tissue * unionLength(intervals) * rayLength(projection, row, column));
        }
}

void addPart(const CArmProjection& projection, const Ellipsoid& part, Vector origin, std::vector<float>& lines)
{
    const ScaledRays rays(projection, part, origin);
    const Box box = shadow(projection, part, origin);
    for (int row = box.top; row < box.bottom; ++row)
        for (int column = box.left; column < box.right; ++column) {
            const auto [entry, exit] = rays.interval(row, column);
            if (exit > entry)
                lines[static_cast<std::size_t>(row) * projection.size() + column] +=
                    static_cast<float>(part.attenuation * (exit - entry) * rayLength(projection, row, column));
        }
}

} // namespace

std::vector<float> headAttenuation(const CArmProjection& projection, Vector origin)
{
    std::vector<float> lines(static_cast<std::size_t>(projection.size()) * projection.size());
    addBody(projection, origin, lines);
    for (const Ellipsoid& part : skeleton())
        addPart(projection, part, origin, lines);
    for (float& line : lines)
        line = std::max(line, 0.0F);
    return lines;
}

} // namespace liena::devices
