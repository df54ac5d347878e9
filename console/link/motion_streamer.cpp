// Motion commands, five hundred a second while armed.
#include "link/motion_streamer.hpp"

namespace console {

void MotionStreamer::run()
{
    const auto order = m_gate.compose(m_snapshot.read(), std::chrono::steady_clock::now());
    const auto blocked = m_gate.blockedPermit();
    m_blocked.store(blocked ? quint64{1} << 32 | *blocked : 0, std::memory_order_relaxed);
    if (!order)
        return;
    if (!m_blank) {
        auto blank = m_system.command(m_robot, "MotionCommand");
        if (!blank) {
            m_refused.fetch_add(1, std::memory_order_relaxed);
            return;
        }
        m_blank.emplace(std::move(blank).value());
    }
    auto message = *m_blank;
    message.set("permit", order->permit)
        .set("sequence", order->sequence)
        .set("engaged", order->engaged)
        .set("guidewire_velocity", order->motion.guidewireVelocity)
        .set("guidewire_rotation", order->motion.guidewireRotation)
        .set("catheter_velocity", order->motion.catheterVelocity)
        .set("catheter_rotation", order->motion.catheterRotation);
    const bool accepted = m_system.send(m_robot, std::move(message)).has_value();
    (accepted ? m_sent : m_refused).fetch_add(1, std::memory_order_relaxed);
}

} // namespace console
