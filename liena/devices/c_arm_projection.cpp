// How the C-arm projects the patient onto the detector: implementation.
#include "c_arm_projection.hpp"

#include <algorithm>

namespace liena::devices {

CArmProjection::CArmProjection(const CArmGeometry& geometry, Vector isocentre, int size)
    : m_distance(geometry.sourceDetectorDistance), m_spacing(geometry.fieldOfView / size), m_size(size)
{
    const double primary = radians(geometry.primaryAngle);
    const double secondary = radians(geometry.secondaryAngle);
    m_towards = {-std::sin(primary) * std::cos(secondary), -std::cos(primary) * std::cos(secondary), std::sin(secondary)};
    const Vector right{-std::cos(primary), std::sin(primary), 0};
    const Vector up{std::sin(primary) * std::sin(secondary), std::cos(primary) * std::sin(secondary), std::cos(secondary)};
    // The table carries the patient; seen from the patient the C-arm moves the other way.
    const Vector centre = isocentre - Vector{geometry.table[0], -geometry.table[2], geometry.table[1]};
    m_source = centre - m_towards * geometry.sourceObjectDistance;
    m_columnStep = right * m_spacing;
    m_rowStep = up * -m_spacing;
    const double middle = (size - 1) / 2.0;
    m_corner = m_source + m_towards * m_distance - m_columnStep * middle - m_rowStep * middle;
}

CArmProjection::Spot CArmProjection::project(Vector point) const
{
    const Vector ray = point - m_source;
    const double depth = std::max(1.0, dot(ray, m_towards));
    const Vector hit = m_source + ray * (m_distance / depth) - m_corner;
    const double area = m_spacing * m_spacing;
    return {dot(hit, m_columnStep) / area, dot(hit, m_rowStep) / area, m_distance / depth / m_spacing};
}

} // namespace liena::devices
