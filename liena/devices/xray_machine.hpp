// The X-ray system's state machine: when the beam may be on, where the C-arm stands, and what dose was given.
#pragma once

#include "drive_gate.hpp"

#include "liena/device_id.hpp"

#include <array>
#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <string_view>

namespace liena::devices {

/// The numbers are those of `AcquisitionMode` in the X-ray system's message set.
enum class AcquisitionMode : std::uint8_t { Stop = 0, Fluoroscopy = 1, Acquisition = 2, Spin = 3 };

struct AcquisitionRequest {
    DeviceId origin;
    AcquisitionMode mode = AcquisitionMode::Stop;
    double pulseRate = 15; ///< /s
    bool pedal = false;
    std::uint32_t press = 0; ///< a repeat has the same number
};

struct CArmGeometry {
    double primaryAngle = 0;   ///< deg, LAO positive
    double secondaryAngle = 0; ///< deg, CRA positive
    double sourceDetectorDistance = 1100;
    double sourceObjectDistance = 750;
    std::array<double, 3> table{}; ///< mm: lateral, longitudinal, height
    double fieldOfView = 300;      ///< mm at the detector

    friend bool operator==(const CArmGeometry&, const CArmGeometry&) = default;
};

struct TubeSettings {
    double voltage = 0;    ///< kV
    double current = 0;    ///< mA
    double pulseWidth = 0; ///< ms
};

struct Dose {
    double fluoroscopyTime = 0; ///< s
    double airKerma = 0;        ///< mGy at the reference point
    double airKermaRate = 0;    ///< mGy/min now
    double areaProduct = 0;     ///< Gy·cm²
};

/// The beam is on only while one cockpit's pedal is down, said again every 200 ms, in an open session.
///
///              pedal heard up in this session, then down under another press, nobody else's pedal
///   Off ────────────────────────────────────────────────────────────────► On ◄─┐ pedal down, same press: lease renewed
///    ▲                                                                    │ └──┘
///    └────────────────────────────────────────────────────────────────────┘
///      pedal up, mode stop, 250 ms of silence, session lost, stand-by, stop, stall
///
/// However the beam ended, its press is spent: only a new press turns it on again, also in stand-by. A press that was refused while another
/// cockpit's pedal was down begins when that pedal is released; whatever else ends the beam spends every press seen so far. A pedal that
/// was down before the session began, or while it was interrupted, turns nothing on: it has to be heard up first, which holds for a system
/// and for a cockpit that were started anew, too. After a stand-by, a stop or a stall each pedal has to be heard up again, and not before
/// `lateUps` are over: until then the up may belong to a press that began before. A spin moves the C-arm: in stand-by its press is refused,
/// and spent. Pure: time comes from the caller.
class XrayMachine {
public:
    static constexpr std::chrono::milliseconds lease{200};
    static constexpr std::chrono::milliseconds margin{50};

    /// A cockpit says the up of a press when the foot is down already, the last time up to 100 ms after it, and that may come late.
    static constexpr std::chrono::milliseconds lateUps{250};

    /// False: refused; reason() says why.
    bool command(const AcquisitionRequest& request, SteadyTime now);

    /// Where the C-arm goes; refused from others than cockpits, in stand-by, and while the beam of another cockpit is on.
    bool moveTo(DeviceId origin, const CArmGeometry& target);

    /// The session of a device left Open, or was interrupted.
    void sessionLost(DeviceId peer);

    void setStandBy(bool standsBy, SteadyTime now);

    /// Ends the beam, the C-arm's way and every press that began before `now`.
    void interrupt(std::string_view reason, SteadyTime now);

    /// Ends a lease that is over and moves the C-arm.
    void tick(SteadyTime now);

    /// One pulse was emitted.
    void pulsed();

    bool beamOn() const { return m_owner.has_value(); }
    bool holds() const { return !m_owner && m_geometry == m_target; } ///< nothing radiates or moves
    AcquisitionMode mode() const { return m_mode; }
    double askedPulseRate() const { return m_pulseRate; }
    double pulseRate() const { return m_pulseRate / m_divisor; } ///< as they are emitted
    std::uint32_t acquisition() const { return m_acquisition; }  ///< counts the runs
    const CArmGeometry& geometry() const { return m_geometry; }
    TubeSettings tube() const;
    const Dose& dose() const { return m_dose; }
    std::string_view reason() const { return m_reason; }

    /// A source with a rate of its own, a recorded run, fixes it; 0 frees it again.
    void fixPulseRate(double rate) { m_fixedRate = rate; }

    /// One pulse of so many that were asked for is emitted: a picture that nobody will see gives no dose.
    void thinPulses(unsigned divisor) { m_divisor = divisor; }

private:
    bool refuse(std::string_view reason);
    void note(DeviceId origin, std::uint32_t press);
    void beamOff(std::string_view reason);
    void end(std::string_view reason); ///< other than by a release: spends refused presses as well
    void startRun(const AcquisitionRequest& request);
    void moveGantry(double seconds);
    double kermaPerPulse() const;

    std::optional<DeviceId> m_owner;             ///< of the pressed pedal
    std::map<DeviceId, std::uint32_t> m_presses; ///< the newest of each cockpit whose up counted: spent unless it is the owner's
    std::map<DeviceId, std::uint32_t> m_refused; ///< the newest of each cockpit that may yet begin
    SteadyTime m_upsCountFrom;                   ///< later than the last stand-by, stop or stall
    SteadyTime m_leaseEnd;
    std::optional<SteadyTime> m_lastTick;
    AcquisitionMode m_mode = AcquisitionMode::Stop;
    double m_pulseRate = 15;
    double m_fixedRate = 0;
    unsigned m_divisor = 1;
    std::uint32_t m_acquisition = 0;
    CArmGeometry m_geometry;
    CArmGeometry m_target;
    std::optional<DeviceId> m_gantryOwner; ///< while the C-arm moves
    double m_spinDirection = 1;
    bool m_standBy = false;
    Dose m_dose;
    std::string_view m_reason;
};

} // namespace liena::devices
