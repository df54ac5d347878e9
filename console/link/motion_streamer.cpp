// Motion commands, five hundred a second while armed.
#include "link/motion_streamer.hpp"

#include <utility>

namespace console {

void MotionStreamer::run()
{
    const auto order = m_gate.compose(m_snapshot.read(), std::chrono::steady_clock::now());
    const auto blocked = m_gate.blockedPermit();
    m_blocked.store(blocked ? blockedBit | (blocked->byPicture ? pictureBit : 0) | blocked->permit : 0, std::memory_order_relaxed);
    if (!order)
        return;
    const bool accepted = bind() && send(*order);
    (accepted ? m_sent : m_refused).fetch_add(1, std::memory_order_relaxed);
}

/// To the set that the robot has now: it may be learnt, and learnt anew, with each opening. Why it does not fit, SystemLink says.
bool MotionStreamer::bind()
{
    auto set = m_system.messageSet(m_robot);
    if (m_binding && m_binding->messageSet() == set)
        return true;
    m_binding.reset();
    if (auto bound = MotionBinding::to(std::move(set), "MotionCommand"))
        m_binding.emplace(std::move(bound).value());
    return m_binding.has_value();
}

/// A value that the robot's set does not allow is refused by the send, with the whole message.
bool MotionStreamer::send(const MotionOrder& order)
{
    liena::Message message(m_binding->messageSet(), m_binding->definition());
    m_binding->write(motionFields(order), message);
    return m_system.send(m_robot, std::move(message)).has_value();
}

} // namespace console
