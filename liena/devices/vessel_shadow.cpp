// Where vessels and instruments fall on the detector: implementation.
#include "vessel_shadow.hpp"

#include <algorithm>
#include <cmath>

namespace liena::devices {

namespace {

using Spot = CArmProjection::Spot;

struct Piece {
    Spot from;
    Spot to;
    double fromRadius = 0; ///< pixels
    double toRadius = 0;
    double slant = 1; ///< how much longer than across the ray's way through the vessel is
};

// Of the pixel to the piece's axis: distance in pixels, and the place along it, 0 to 1 inside.
std::pair<double, double> placeOn(const Piece& piece, double column, double row)
{
    const double x = piece.to.column - piece.from.column;
    const double y = piece.to.row - piece.from.row;
    const double square = x * x + y * y;
    const double along = square > 1e-12 ? ((column - piece.from.column) * x + (row - piece.from.row) * y) / square : 0;
    const double inside = std::clamp(along, 0.0, 1.0);
    const double distance = std::hypot(column - piece.from.column - inside * x, row - piece.from.row - inside * y);
    return {distance, along};
}

int within(double value, int size) { return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(size))); }

// Calls use(row, column) for the pixels within `reach` of the piece.
template <typename Use>
void visit(const Piece& piece, double reach, int size, Use use)
{
    const int bottom = within(std::max(piece.from.row, piece.to.row) + reach + 1, size);
    const int right = within(std::max(piece.from.column, piece.to.column) + reach + 1, size);
    for (int row = within(std::min(piece.from.row, piece.to.row) - reach, size); row < bottom; ++row)
        for (int column = within(std::min(piece.from.column, piece.to.column) - reach, size); column < right; ++column)
            use(row, column);
}

Piece pieceBetween(const CArmProjection& projection, const VesselPoint& from, const VesselPoint& to)
{
    Piece piece{projection.project(from.position), projection.project(to.position)};
    piece.fromRadius = from.radius * piece.from.magnification;
    piece.toRadius = to.radius * piece.to.magnification;
    const Vector ray = normalised(to.position - projection.source());
    const double across = length(cross(normalised(to.position - from.position), ray));
    piece.slant = 1 / std::max(across, 0.35);
    return piece;
}

void addCrossings(const Piece& piece, std::uint32_t point, int size, std::vector<VesselCrossing>& crossings)
{
    const double reach = std::max(piece.fromRadius, piece.toRadius);
    visit(piece, reach, size, [&](int row, int column) {
        const auto [distance, along] = placeOn(piece, column, row);
        if (along < 0 || along >= 1)
            return;
        const double radius = piece.fromRadius + (piece.toRadius - piece.fromRadius) * along;
        if (distance >= radius)
            return;
        const double thickness = 2 * std::sqrt(radius * radius - distance * distance) / piece.to.magnification * piece.slant;
        crossings.push_back({static_cast<std::uint32_t>(row * size + column), point, static_cast<float>(thickness)});
    });
}

struct Instrument {
    double diameter = 0;    ///< mm
    double attenuation = 0; ///< 1/mm
};

constexpr Instrument wireBody{0.36, 1.6};
constexpr Instrument wireTip{0.36, 4.0}; // platinum coil
constexpr Instrument catheterWall{1.9, 0.16};
constexpr double tipLength = 30;
constexpr double bendLength = 6;

// Of one piece of an instrument; what lies there already stays if it is more, so that the joints of pieces do not show.
void addPiece(const Piece& piece, const Instrument& instrument, int size, std::vector<float>& lines)
{
    const double radius = instrument.diameter / 2 * piece.from.magnification;
    visit(piece, radius + 1, size, [&](int row, int column) {
        const double distance = placeOn(piece, column, row).first;
        // The pixel sees the mean over its own width: a wire thinner than a pixel is paler, not thinner.
        const double covered = std::clamp(radius + 0.5 - distance, 0.0, std::min(1.0, 2 * radius));
        const double depth = instrument.diameter * instrument.attenuation * covered;
        float& line = lines[static_cast<std::size_t>(row) * size + column];
        line = std::max(line, static_cast<float>(depth));
    });
}

// The tip's pre-formed bend leans towards the wall, by the wire's angle.
Vector wirePlace(const VesselWay& way, double arc, const InstrumentView& view)
{
    const WayPoint place = way.at(arc);
    const double part = std::max(0.0, 1 - (view.guidewire - arc) / bendLength);
    const Vector reference = std::abs(place.direction.z) < 0.9 ? Vector{0, 0, 1} : Vector{1, 0, 0};
    const Vector side = normalised(cross(place.direction, reference));
    const Vector other = cross(place.direction, side);
    const double angle = radians(view.guidewireAngle);
    const double lean = 0.7 * place.radius * part * part;
    return place.position + side * (lean * std::cos(angle)) + other * (lean * std::sin(angle));
}

} // namespace

std::vector<VesselCrossing> vesselShadow(const CArmProjection& projection, const VesselTree& tree)
{
    std::vector<VesselCrossing> crossings;
    for (std::size_t index = 0; index < tree.points.size(); ++index) {
        const VesselPoint& point = tree.points[index];
        if (point.parent)
            addCrossings(pieceBetween(projection, tree.points[*point.parent], point), static_cast<std::uint32_t>(index), projection.size(),
                         crossings);
    }
    return crossings;
}

void addInstruments(const CArmProjection& projection, const VesselWay& way, const InstrumentView& view, std::vector<float>& lines)
{
    if (!view.present)
        return;
    constexpr double step = 1;
    Spot last = projection.project(way.at(0).position);
    for (double arc = 0; arc < view.catheter; arc += step) {
        const Spot next = projection.project(way.at(std::min(arc + step, view.catheter)).position);
        addPiece({last, next}, catheterWall, projection.size(), lines);
        last = next;
    }
    last = projection.project(wirePlace(way, 0, view));
    for (double arc = 0; arc < view.guidewire; arc += step) {
        const double until = std::min(arc + step, view.guidewire);
        const Spot next = projection.project(wirePlace(way, until, view));
        addPiece({last, next}, until > view.guidewire - tipLength ? wireTip : wireBody, projection.size(), lines);
        last = next;
    }
}

} // namespace liena::devices
