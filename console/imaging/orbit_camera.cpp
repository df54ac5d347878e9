// The scene's point of view: a camera on a sphere round the focus, with the head always up.
#include "imaging/orbit_camera.hpp"

#include <QtMath>

#include <algorithm>
#include <cmath>

namespace console {

namespace {

constexpr double steepest = 89;
constexpr double closest = 60;
constexpr double farthest = 5000;
constexpr double seenShare = 0.94; // of the picture's half, beyond which there is margin

QVector3D outward(double azimuth, double elevation)
{
    const double a = qDegreesToRadians(azimuth);
    const double e = qDegreesToRadians(elevation);
    return {static_cast<float>(std::sin(a) * std::cos(e)), static_cast<float>(-std::cos(a) * std::cos(e)), static_cast<float>(std::sin(e))};
}

} // namespace

void OrbitCamera::rotate(double azimuthStep, double elevationStep)
{
    m_azimuth = std::remainder(m_azimuth + azimuthStep, 360.0);
    m_elevation = std::clamp(m_elevation + elevationStep, -steepest, steepest);
}

void OrbitCamera::zoom(double factor)
{
    if (std::isfinite(factor) && factor > 0)
        m_distance = std::clamp(m_distance / factor, closest, farthest);
}

void OrbitCamera::fit(double radius)
{
    if (std::isfinite(radius) && radius > 0)
        m_distance = std::clamp(1.05 * radius / std::sin(qDegreesToRadians(viewAngle / 2)), closest, farthest);
}

void OrbitCamera::keepInSight(const std::vector<QVector3D>& fromFocus, QSizeF size)
{
    if (size.isEmpty())
        return;
    const double half = seenShare * std::tan(qDegreesToRadians(viewAngle / 2)); // of the picture's height, at a depth of 1
    for (const QVector3D& point : fromFocus) {
        const double beside = std::abs(QVector3D::dotProduct(point, right())) * size.height() / size.width();
        const double above = std::abs(QVector3D::dotProduct(point, up()));
        const double towards = QVector3D::dotProduct(point, outward(m_azimuth, m_elevation));
        m_distance = std::clamp(std::max(m_distance, towards + std::max(beside, above) / half), closest, farthest);
    }
}

QVector3D OrbitCamera::offset() const { return outward(m_azimuth, m_elevation) * static_cast<float>(m_distance); }

QVector3D OrbitCamera::right() const
{
    const double a = qDegreesToRadians(m_azimuth);
    return {static_cast<float>(std::cos(a)), static_cast<float>(std::sin(a)), 0};
}

QVector3D OrbitCamera::up() const { return QVector3D::crossProduct(outward(m_azimuth, m_elevation), right()); }

double OrbitCamera::depthOf(const QVector3D& fromFocus) const
{
    return m_distance - QVector3D::dotProduct(fromFocus, outward(m_azimuth, m_elevation));
}

double OrbitCamera::heightAt(const QVector3D& fromFocus) const
{
    return 2 * std::tan(qDegreesToRadians(viewAngle / 2)) * std::max(depthOf(fromFocus), 0.0);
}

std::optional<QPointF> OrbitCamera::project(const QVector3D& fromFocus, QSizeF size) const
{
    const double depth = depthOf(fromFocus);
    if (depth <= 1)
        return std::nullopt;
    const double pixelsPerUnit = size.height() / heightAt(fromFocus);
    return QPointF(size.width() / 2 + QVector3D::dotProduct(fromFocus, right()) * pixelsPerUnit,
                   size.height() / 2 - QVector3D::dotProduct(fromFocus, up()) * pixelsPerUnit);
}

} // namespace console
