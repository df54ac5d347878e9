// The pedal's command, repeated.
#include "link/pedal_streamer.hpp"

namespace console {

void PedalStreamer::run()
{
    const auto order = m_gate.compose(m_snapshot.read(), std::chrono::steady_clock::now());
    // Why it was refused, the session's state says; without a repeat the beam ends.
    if (order && !send(*order))
        m_gate.refused();
}

bool PedalStreamer::send(const PedalOrder& order)
{
    auto command = m_system.command(m_xray, "AcquisitionCommand");
    if (!command)
        return false;
    auto message = std::move(command).value();
    message.set("mode", std::string_view(order.pedal ? "fluoroscopy" : "stop"))
        .set("pulse_rate", order.pulseRate)
        .set("pedal", order.pedal)
        .set("press", order.press);
    return m_system.send(m_xray, std::move(message)).has_value();
}

} // namespace console
