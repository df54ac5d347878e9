// How the C-arm projects the patient onto the detector.
#pragma once

#include "geometry.hpp"
#include "xray_machine.hpp"

namespace liena::devices {

/// Angles 0/0: the detector is in front of the patient, the picture shows the patient from the front, the head up, the patient's left at
/// the right. LAO turns the detector to the patient's left, CRA towards the head. All points are in the patient's frame.
class CArmProjection {
public:
    /// A square detector of `size` × `size` pixels; `isocentre` is what the table's zero position brings into the C-arm's centre.
    CArmProjection(const CArmGeometry& geometry, Vector isocentre, int size);

    struct Spot {
        double column = 0; ///< pixel centres are whole numbers
        double row = 0;
        double magnification = 1; ///< pixels per mm at the point's depth
    };

    Spot project(Vector point) const;

    Vector source() const { return m_source; }
    Vector detectorCorner() const { return m_corner; } ///< centre of the top left pixel
    Vector columnStep() const { return m_columnStep; } ///< to the next pixel
    Vector rowStep() const { return m_rowStep; }
    double pixelSpacing() const { return m_spacing; } ///< mm
    int size() const { return m_size; }

private:
    Vector m_source;
    Vector m_towards; ///< unit, from the source to the detector
    Vector m_corner;
    Vector m_columnStep;
    Vector m_rowStep;
    double m_distance; ///< source to detector
    double m_spacing;
    int m_size;
};

} // namespace liena::devices
