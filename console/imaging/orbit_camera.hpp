// The scene's point of view: a camera on a sphere round the focus, with the head always up.
#pragma once

#include <QPointF>
#include <QSizeF>
#include <QVector3D>

#include <optional>
#include <vector>

namespace console {

/// Angles in degrees, distance in mm, in the scene's frame. Azimuth 0 looks from the front to the back of the patient; positive goes round
/// to the patient's left; positive elevation goes up.
class OrbitCamera {
public:
    static constexpr double viewAngle = 30;

    void rotate(double azimuthStep, double elevationStep);

    /// Above 1: closer.
    void zoom(double factor);

    /// As far away as a ball of this radius, mm, needs to be seen whole.
    void fit(double radius);

    /// Steps back until all of these, given relative to the focus, are seen in a picture of this size with some margin.
    void keepInSight(const std::vector<QVector3D>& fromFocus, QSizeF size);

    double azimuth() const { return m_azimuth; }
    double elevation() const { return m_elevation; }
    double distance() const { return m_distance; }

    /// From the focus to the camera.
    QVector3D offset() const;
    QVector3D right() const;
    QVector3D up() const;

    /// Where a point, given relative to the focus, appears in a picture of this size; nothing when it is behind the camera.
    std::optional<QPointF> project(const QVector3D& fromFocus, QSizeF size) const;

    /// What a picture shows from its lower to its upper edge, mm, at the depth of a point that is given relative to the focus.
    double heightAt(const QVector3D& fromFocus) const;

    bool operator==(const OrbitCamera&) const = default;

private:
    double depthOf(const QVector3D& fromFocus) const;

    double m_azimuth = -35;
    double m_elevation = 12;
    double m_distance = 900;
};

} // namespace console
