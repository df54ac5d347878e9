// A master that comes and goes: a device on a cable, which must be heard in time and seen let go before it counts.
#pragma once

#include "input/master_device.hpp"
#include "input/rest_gate.hpp"

#include <chrono>

namespace console {

/// ```
///            connected            heard, window active          let go, at rest
///   Gone ────────────► Silent ◄──────────────────────► Unreleased ─────────────► Alive
///    ▲                                                    ▲  late, window lost, engaged elsewhere │
///    └──────────── disconnected (from any)                └───────────────────────────────────────┘
/// ```
class ConnectedMaster : public MasterDevice {
    Q_OBJECT
public:
    using MasterDevice::MasterDevice;

    /// Polled later than this, nobody knows whether the hand let go in between; as long as the whole console may stand still.
    static constexpr std::chrono::milliseconds lateLimit{100};

    MasterLife life(Instant now) const override;
    void poll(Instant now) final;
    MasterReading read(Instant now) override;
    void rezero(Instant now) override;
    void requireRelease() override { shut(); }

protected:
    void listeningChanged() override;

    /// Takes what came since the last time, by the functions below.
    virtual void take(Instant now) = 0;

    void setConnected(bool connected);
    bool connected() const { return m_connected; }

    /// What the buttons and axes say now.
    void tell(const HandControls& controls);

    bool counts() const { return m_gate.open(); }

private:
    void shut();
    void renew();

    RestGate m_gate;
    HandControls m_raw;
    HandControls m_counted;
    std::optional<Instant> m_polled;
    bool m_connected = false;
};

} // namespace console
