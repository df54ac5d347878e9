// The X-ray system as it last reported itself: beam, dose, geometry.
#pragma once

#include "model/aged.hpp"
#include "model/link_state.hpp"

#include <QObject>
#include <QString>

#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>

namespace console {

enum class AcquisitionMode : std::uint8_t { Stop, Fluoroscopy, Acquisition, Spin };

/// stop, fluoroscopy, acquisition, spin.
QString word(AcquisitionMode mode);

struct XrayGeometry {
    double primaryAngle = 0;           ///< deg, LAO positive
    double secondaryAngle = 0;         ///< deg, CRA positive
    double sourceDetectorDistance = 0; ///< mm; 0 = unknown
    double sourceObjectDistance = 0;   ///< mm; 0 = unknown

    /// mm: lateral to the patient's right, longitudinal to the head, height up. Counted from where the table brings the origin of the
    /// patient's frame into the isocentre; how far its top is below the isocentre then, no message says.
    std::array<double, 3> table{};
};

/// What a C-arm at rest may tremble in the angles and distances that it reports, and a picture does not show.
struct ProjectionTolerance {
    double angle = 0.5;  ///< deg
    double distance = 2; ///< mm, of SID and SOD
};

/// Whether two pictures were taken from one side.
inline bool sameProjection(const XrayGeometry& a, const XrayGeometry& b, const ProjectionTolerance& tolerance = {})
{
    const auto near = [](double one, double other, double most) { return std::abs(one - other) <= most; };
    return near(a.primaryAngle, b.primaryAngle, tolerance.angle) && near(a.secondaryAngle, b.secondaryAngle, tolerance.angle) &&
           near(a.sourceDetectorDistance, b.sourceDetectorDistance, tolerance.distance) &&
           near(a.sourceObjectDistance, b.sourceObjectDistance, tolerance.distance);
}

struct AcquisitionStatus {
    AcquisitionMode mode = AcquisitionMode::Stop;
    bool beamOn = false;
    double tubeVoltage = 0;     ///< kV
    double tubeCurrent = 0;     ///< mA
    double pulseWidth = 0;      ///< ms
    double pulseRate = 0;       ///< per second
    double fluoroscopyTime = 0; ///< s
    double airKerma = 0;        ///< mGy
    double airKermaRate = 0;    ///< mGy/min
    double doseAreaProduct = 0; ///< Gy·cm²
    XrayGeometry geometry;
    quint64 framesAcquired = 0;
    quint64 framesSent = 0;
    quint64 framesWithheld = 0;
};

/// GUI thread only. A repeat of what the X-ray system says; that system stays the primary source.
class XraySystemState : public QObject {
    Q_OBJECT
public:
    static constexpr std::chrono::milliseconds statusLimit{500};

    explicit XraySystemState(QObject* parent = nullptr);

    const Aged<AcquisitionStatus>& status() const { return m_status; }
    bool fresh(Instant now) const { return m_status.freshness(now, statusLimit) == Freshness::Fresh; }

    /// Of the last report; ask fresh() before calling it the present.
    bool beamOn() const { return m_status.known() && m_status.value.beamOn; }

    /// The pedal of this console.
    bool pedalDown() const { return m_pedal; }
    double requestedRate() const { return m_requestedRate; } ///< pulses per second

    void receive(const AcquisitionStatus& status, Instant at);
    void setPedal(bool down);
    void setRequestedRate(double pulsesPerSecond);

Q_SIGNALS:
    void statusChanged();
    void beamChanged(bool on);
    void pedalChanged(bool down);

private:
    Aged<AcquisitionStatus> m_status;
    bool m_pedal = false;
    double m_requestedRate = 15;
};

/// How many pictures should come each second; 0: none. They are due while the pedal is down here, and while the beam is on for all that is
/// known: what was reported as on is so until it is reported as off, or its link is closed in order. No report that is late ends a run.
double picturesDue(const XraySystemState& xray, LinkState link);

} // namespace console
