// Distances and angles on a picture.
#include "imaging/measurement.hpp"

#include "imaging/display_picture.hpp"
#include "model/roadmap_state.hpp"

#include <QCoreApplication>
#include <QtMath>

#include <algorithm>
#include <cmath>

namespace console {

namespace {

constexpr double thinnestCatheter = 1; ///< Fr
constexpr double thickestCatheter = 34;
constexpr int smallestCatheter = 4; ///< of those that a key chooses
constexpr int largestCatheter = 8;
constexpr double offPlane = 50; ///< mm, those that the text names

struct Text {
    Q_DECLARE_TR_FUNCTIONS(console::Measurement)
};

bool sameView(const XrayFrame& a, const XrayFrame& b)
{
    return a.rows == b.rows && a.columns == b.columns && a.imagerPixelSpacing == b.imagerPixelSpacing &&
           sameProjection(a.geometry, b.geometry);
}

/// By how much the table carried the patient from one place to the other, in the scene's frame.
QVector3D movement(const std::array<double, 3>& from, const std::array<double, 3>& to)
{
    const auto along = [&](std::size_t axis) { return static_cast<float>(to.at(axis) - from.at(axis)); };
    return toScene({along(0), -along(2), along(1)});
}

/// Negated, so that a number that is none counts as a movement.
bool isBeyond(double millimetres) { return !(std::abs(millimetres) <= RoadmapState::tableTolerance); }

bool isMoved(const QVector3D& way) { return isBeyond(way.x()) || isBeyond(way.y()) || isBeyond(way.z()); }

/// Along the beam: that changes how much larger its shadow is.
bool isMovedInDepth(const QVector3D& way, const XrayGeometry& geometry)
{
    return isBeyond(QVector3D::dotProduct(way, axesOf(geometry.primaryAngle, geometry.secondaryAngle).beam));
}

/// On a slow line the table may have moved while the picture was on its way here.
std::optional<TableWay> wayIn(const XrayFrame& frame, const TableRest& table)
{
    return table.wayOf(frame.earliestCapture(), frame.arrival);
}

/// Where the table was on its way it may have been at either end.
template <typename Test>
bool mayHave(const TableWay& before, const TableWay& now, Test test)
{
    return test(movement(before.from, now.from)) || test(movement(before.from, now.to)) || test(movement(before.to, now.from)) ||
           test(movement(before.to, now.to));
}

} // namespace

PixelCalibration calibrationOf(const XrayFrame& frame)
{
    const std::optional<double> size = pixelSizeAtIsocentre(frame);
    return size ? PixelCalibration{CalibrationKind::Geometry, *size, 0, frame.geometry.sourceObjectDistance} : PixelCalibration{};
}

PixelCalibration calibrationBy(double french, double widthPixels)
{
    if (!(french >= thinnestCatheter) || french > thickestCatheter || !(widthPixels > 0) || !std::isfinite(widthPixels))
        return {};
    return {CalibrationKind::Catheter, french / 3 / widthPixels, french, 0};
}

QString lengthText(double pixels, const PixelCalibration& calibration)
{
    const auto millimetres = QString::number(pixels * calibration.pixelSize, 'f', 1);
    switch (calibration.kind) {
    case CalibrationKind::Geometry:
        return Text::tr("%1 mm @ isocentre plane (geometry)").arg(millimetres);
    case CalibrationKind::Catheter:
        return Text::tr("%1 mm (%2 F catheter)").arg(millimetres, QString::number(calibration.french));
    case CalibrationKind::None:
        break;
    }
    return Text::tr("%1 px (uncalibrated)").arg(std::lround(pixels));
}

// A shadow's length at the object goes with the object's distance from the source: both ways the share is the same.
QString depthText(const PixelCalibration& calibration)
{
    if (calibration.kind == CalibrationKind::Catheter)
        return Text::tr("true in the catheter's plane only");
    if (calibration.kind != CalibrationKind::Geometry || !(calibration.distance > 0))
        return {};
    return Text::tr("object 5 cm nearer or farther: \u2248 %1 % off").arg(100 * offPlane / calibration.distance, 0, 'f', 0);
}

std::optional<double> angleAt(QPointF corner, QPointF one, QPointF other)
{
    const QPointF a = one - corner;
    const QPointF b = other - corner;
    const double lengths = std::hypot(a.x(), a.y()) * std::hypot(b.x(), b.y());
    if (!(lengths > 0))
        return std::nullopt;
    return qRadiansToDegrees(std::acos(std::clamp(QPointF::dotProduct(a, b) / lengths, -1.0, 1.0)));
}

void Measurement::setMode(MeasureMode mode)
{
    if (m_mode == mode)
        return;
    m_mode = mode;
    clear();
}

void Measurement::add(QPointF point)
{
    if (m_mode == MeasureMode::Off)
        return;
    if (isComplete())
        clear();
    m_points.push_back(point);
}

bool Measurement::isComplete() const { return m_mode != MeasureMode::Off && m_points.size() == wanted(); }

std::optional<double> Measurement::pixels() const
{
    if (m_mode != MeasureMode::Distance || !isComplete())
        return std::nullopt;
    const QPointF between = m_points[1] - m_points[0];
    return std::hypot(between.x(), between.y());
}

QString Measurement::text() const
{
    if (!isComplete())
        return {};
    if (const auto length = pixels())
        return lengthText(*length, calibration());
    const std::optional<double> angle = angleAt(m_points[1], m_points[0], m_points[2]);
    return angle ? Text::tr("%1\u00B0 in the picture's plane").arg(*angle, 0, 'f', 1) : Text::tr("no angle: two points are one");
}

QString Measurement::depthText() const { return pixels() ? console::depthText(calibration()) : QString(); }

void Measurement::nextCatheter()
{
    const double width = pixels().value_or(0);
    if (!(width > 0))
        return;
    if (!isCatheter()) {
        m_catheterWidth = width;
        m_catheterTable = m_table;
        m_french = smallestCatheter;
    } else if (++m_french > largestCatheter) {
        m_catheterWidth = 0;
        m_french = 0;
    }
}

PixelCalibration Measurement::calibration() const
{
    if (m_catheterWidth > 0)
        return calibrationBy(m_french, m_catheterWidth);
    return m_frame ? calibrationOf(*m_frame) : PixelCalibration{};
}

void Measurement::follow(const XrayFrame& frame, const TableRest& table)
{
    if (m_frame && !sameView(*m_frame, frame)) {
        clear();
        m_catheterWidth = 0;
    }
    // Drawn anew with other settings it is the same picture, of the same place.
    const bool another =
        !m_frame || m_frame->frame != frame.frame || m_frame->acquisition != frame.acquisition || m_frame->captureNs != frame.captureNs;
    if (!m_table && m_frame) // what is first reported stood so before
        m_table = m_catheterTable = wayIn(*m_frame, table);
    if (const auto stood = wayIn(frame, table); another && stood)
        moveTable(*stood, frame.geometry);
    const bool holds = m_frame && (!m_points.empty() || m_catheterWidth > 0);
    const XrayGeometry geometry = holds ? m_frame->geometry : frame.geometry; // a C-arm that creeps is to be noticed
    m_frame = frame;
    m_frame->geometry = geometry;
    m_frame->owner.reset();
    m_frame->pixels = {};
}

void Measurement::moveTable(const TableWay& table, const XrayGeometry& geometry)
{
    if (m_table && mayHave(*m_table, table, isMoved))
        clear();
    if (m_catheterTable && mayHave(*m_catheterTable, table, [&geometry](const QVector3D& way) { return isMovedInDepth(way, geometry); }))
        m_catheterWidth = 0;
    if (m_points.empty()) // a table that creeps is to be noticed
        m_table = table;
}

} // namespace console
