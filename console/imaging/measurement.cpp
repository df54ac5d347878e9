// Distances and angles on a picture.
#include "imaging/measurement.hpp"

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

/// Of the table in the picture, as reports tell it that are not too old for it; nothing where it was on its way. A recorded picture was
/// taken at another time, whatever is reported now.
std::optional<double> heightIn(const XrayFrame& frame, const TableRest& table)
{
    constexpr std::size_t height = 2;
    const std::optional<TableWay> way = wayIn(frame, table);
    if (frame.source == PictureSource::Recorded || !way || !table.spans(frame.earliestCapture(), frame.arrival) ||
        isBeyond(way->to.at(height) - way->from.at(height)))
        return std::nullopt;
    return way->to.at(height);
}

QString centimetres(double millimetres) { return QString::number(millimetres / 10, 'f', 1); }

QString faultText(TablePlaneFault fault)
{
    switch (fault) {
    case TablePlaneFault::None:
        break;
    case TablePlaneFault::TableTopNotSetUp:
        return Text::tr("the table's top is not set up in the preferences");
    case TablePlaneFault::HeightUnknown:
        return Text::tr("the table's height in this picture is unknown");
    case TablePlaneFault::GeometryUnknown:
        return Text::tr("the picture's geometry is unknown");
    case TablePlaneFault::TooOblique:
        return Text::tr("the beam is more than 60\u00B0 from upright");
    case TablePlaneFault::SourceAbove:
        return Text::tr("the X-ray source is above the table");
    case TablePlaneFault::OutsideBeam:
        return Text::tr("the plane is not between source and detector");
    }
    return {};
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

PixelCalibration calibrationAboveTable(const XrayFrame& frame, const MeasurePlane& plane, std::optional<double> tableHeight)
{
    PixelCalibration calibration;
    calibration.fault = !plane.tableTop ? TablePlaneFault::TableTopNotSetUp : TablePlaneFault::HeightUnknown;
    if (!plane.object || !plane.tableTop || !tableHeight)
        return calibration;
    const TablePlane found = tablePlaneOf(frame, *plane.tableTop - *tableHeight, *plane.object);
    calibration.fault = found.fault;
    if (found.fault == TablePlaneFault::None)
        calibration = {CalibrationKind::Table, found.pixelSize, 0, found.distance, double(*plane.object), found.fault};
    return calibration;
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
    case CalibrationKind::Table:
        return Text::tr("%1 mm @ table plane + %2 cm (geometry)").arg(millimetres, centimetres(calibration.object));
    case CalibrationKind::Catheter:
        return Text::tr("%1 mm (%2 F catheter)").arg(millimetres, QString::number(calibration.french));
    case CalibrationKind::None:
        break;
    }
    const QString pattern =
        calibration.fault == TablePlaneFault::None ? Text::tr("%1 px (uncalibrated)") : Text::tr("%1 px (uncalibrated: no table plane)");
    return pattern.arg(std::lround(pixels));
}

// A shadow's length at the object goes with the object's distance from the source: both ways the share is the same.
QString depthText(const PixelCalibration& calibration)
{
    if (calibration.kind == CalibrationKind::Catheter)
        return Text::tr("true in the catheter's plane only");
    if (calibration.kind == CalibrationKind::None || !(calibration.distance > 0))
        return faultText(calibration.fault);
    return Text::tr("object 5 cm nearer or farther: \u2248 %1 % off").arg(100 * offPlane / calibration.distance, 0, 'f', 0);
}

QString planeText(const MeasurePlane& plane)
{
    return plane.object ? Text::tr("lengths by geometry: table plane + %1 cm").arg(centimetres(*plane.object))
                        : Text::tr("lengths by geometry: isocentre plane");
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
    if (!m_frame)
        return {};
    return m_plane.object ? calibrationAboveTable(*m_frame, m_plane, m_tableHeight) : calibrationOf(*m_frame);
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
    m_tableHeight = heightIn(frame, table);
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
