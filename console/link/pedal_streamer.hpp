// The pedal on its way out: repeated while it is down, so that a lost link or a hung screen ends the exposure for good.
#pragma once

#include "model/instant.hpp"
#include "model/latest_value.hpp"
#include "model/pedal_order.hpp"

#include <liena/distributed_system.hpp>

#include <chrono>

namespace console {

class PedalStreamer {
public:
    static constexpr std::chrono::milliseconds period{50};

    PedalStreamer(liena::DistributedSystem& system, liena::DeviceId xray) : m_system(system), m_xray(xray) {}

    /// GUI thread.
    void publish(const PedalSnapshot& snapshot) { m_snapshot.write(snapshot); }

    /// Network thread, once a period.
    void run();

private:
    bool send(const PedalOrder& order);

    liena::DistributedSystem& m_system;
    liena::DeviceId m_xray;
    LatestValue<PedalSnapshot> m_snapshot;
    PedalGate m_gate;
};

} // namespace console
