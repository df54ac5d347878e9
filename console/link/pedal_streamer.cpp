// The pedal's command, repeated.
#include "link/pedal_streamer.hpp"

namespace console {

void PedalStreamer::run()
{
    const auto order = m_gate.compose(m_snapshot.read(), std::chrono::steady_clock::now());
    if (!order)
        return;
    auto command = m_system.command(m_xray, "AcquisitionCommand");
    if (!command)
        return;
    auto message = std::move(command).value();
    message.set("mode", std::string_view(order->pedal ? "fluoroscopy" : "stop"))
        .set("pulse_rate", order->pulseRate)
        .set("pedal", order->pedal)
        .set("press", order->press);
    // A refusal needs no answer here: the session's state says why, and without a repeat the beam ends.
    (void)m_system.send(m_xray, std::move(message));
}

} // namespace console
