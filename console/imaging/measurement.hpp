// Distances and angles on a picture, each with the word for how its millimetres are known.
#pragma once

#include "imaging/display_picture.hpp"
#include "model/display_state.hpp"
#include "model/table_rest.hpp"
#include "model/xray_frame.hpp"

#include <QPointF>
#include <QString>

#include <optional>
#include <vector>

namespace console {

/// Where the length of a pixel comes from.
enum class CalibrationKind : std::uint8_t {
    None,     ///< pixels only
    Geometry, ///< imager spacing x SOD / SID: true in the isocentre's plane
    Table,    ///< by the height of the table: true in a plane above it
    Catheter, ///< a catheter of known size was measured: true in its plane
};

struct PixelCalibration {
    CalibrationKind kind = CalibrationKind::None;
    double pixelSize = 0;                          ///< mm in the plane it is true for
    double french = 0;                             ///< of the catheter
    double distance = 0;                           ///< mm from the source to that plane; 0 = unknown
    double object = 0;                             ///< mm of that plane above the table's top
    TablePlaneFault fault = TablePlaneFault::None; ///< with None: why a plane above the table, which was chosen, has no lengths

    bool operator==(const PixelCalibration&) const = default;
};

/// From the frame's geometry; none when any of it is unknown. The plane is the isocentre's, square to the beam, as the frame's own SOD
/// places it: neither the table nor the beam's angle enters.
PixelCalibration calibrationOf(const XrayFrame& frame);

/// In the plane above the table that is chosen, of a picture in which the table was reported at `tableHeight` mm (nothing: unknown). None,
/// with the fault, where that plane is not known: the isocentre's does not take its place.
PixelCalibration calibrationAboveTable(const XrayFrame& frame, const MeasurePlane& plane, std::optional<double> tableHeight);

/// A catheter of `french` (1 Fr = 1/3 mm) that is `widthPixels` wide in the picture; none for numbers that mean nothing.
PixelCalibration calibrationBy(double french, double widthPixels);

/// `12.4 mm @ isocentre plane (geometry)`, `12.4 mm @ table plane + 10.0 cm (geometry)`, `12.4 mm (8 F catheter)`, `41 px (uncalibrated)`,
/// `41 px (uncalibrated: no table plane)`.
QString lengthText(double pixels, const PixelCalibration& calibration);

/// What such a length is worth off its plane: by how many per cent the truth differs 5 cm nearer to the source or farther from it, where
/// that is known, or in which plane alone it holds. Of pixels why there is no plane above the table, where that was chosen; else empty.
QString depthText(const PixelCalibration& calibration);

/// `lengths by geometry: table plane + 10.0 cm`, or `isocentre plane`.
QString planeText(const MeasurePlane& plane);

/// Of the angle at `corner`, 0 … 180 degrees; nothing when an arm has no length.
std::optional<double> angleAt(QPointF corner, QPointF one, QPointF other);

/// What a person measures on one picture: two points or three, in pixels of the picture. A new point behind the last begins anew.
class Measurement {
public:
    void setMode(MeasureMode mode);
    MeasureMode mode() const { return m_mode; }

    void add(QPointF point);
    void clear() { m_points.clear(); }
    const std::vector<QPointF>& points() const { return m_points; }
    std::size_t wanted() const { return m_mode == MeasureMode::Angle ? 3 : 2; }
    bool isComplete() const;

    /// The pixels between the two points of a complete distance.
    std::optional<double> pixels() const;

    /// Empty until complete. An angle is that of the shadows in the picture's plane, and says so.
    QString text() const;

    /// What the length is worth off its plane, or why the plane above the table has none; empty where there is no complete distance.
    QString depthText() const;

    /// The distance that stands is the width of a catheter: of 4 F, at the next call of 5 F, … 8 F, and then of none. Another distance
    /// begins with 4 F again, whatever catheter was measured before. Without a distance it does nothing.
    void nextCatheter();

    /// The distance that stands is the one that calibrates.
    bool isCatheter() const { return m_catheterWidth > 0 && pixels() == m_catheterWidth; }

    /// Where lengths are to be known by geometry.
    void setPlane(const MeasurePlane& plane) { m_plane = plane; }

    /// That of the catheter, else that of the geometry in the plane that is chosen, as C-arm and table stood in the picture.
    PixelCalibration calibration() const;

    /// Points and catheter belong to this projection, and to where the table stood in their picture, as `table` tells from when it can have
    /// been taken to its arrival: in another they would lie, and are cleared. Sideways the table moves the points away only: the catheter
    /// goes once the patient came nearer to the source, or farther from it. Any picture, also an older one than before, or the same once
    /// more when the table was reported since.
    void follow(const XrayFrame& frame, const TableRest& table = {});

private:
    void moveTable(const TableWay& table, const XrayGeometry& geometry);

    MeasureMode m_mode = MeasureMode::Off;
    std::vector<QPointF> m_points;
    std::optional<XrayFrame> m_frame; ///< without its pixels
    double m_catheterWidth = 0;       ///< pixels; 0: none was measured
    int m_french = 0;
    std::optional<TableWay> m_table;         ///< where the points were set; without any, of the picture; nothing before a report
    std::optional<TableWay> m_catheterTable; ///< where the catheter was measured
    MeasurePlane m_plane;
    std::optional<double> m_tableHeight; ///< mm, in the picture; nothing: unknown
};

} // namespace console
