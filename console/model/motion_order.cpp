// The last check before a motion command leaves.
#include "model/motion_order.hpp"

#include "model/soft_start.hpp"

namespace console {

std::optional<MotionOrder> MotionGate::compose(const MotionSnapshot& snapshot, Instant now)
{
    if (snapshot.stream == MotionStream::None)
        return std::nullopt;
    if (!m_any || snapshot.permit != m_permit) {
        m_any = true;
        m_permit = snapshot.permit;
        m_sequence = 0;
        m_blocked = false;
        m_blockedByPicture = false;
    }
    const bool screenAlive = now - snapshot.guiTick <= guiLimit;
    const bool pictureYoung = snapshot.shownCapture && now - *snapshot.shownCapture <= snapshot.pictureLimit;
    if (!m_blocked) {
        m_blockedByPicture = screenAlive && snapshot.stream == MotionStream::Motion && !pictureYoung;
        m_blocked = m_blockedByPicture || !screenAlive;
    }

    MotionOrder order;
    order.permit = m_permit;
    order.sequence = ++m_sequence;
    order.engaged = snapshot.stream == MotionStream::Motion && !m_blocked;
    if (order.engaged)
        order.motion = scaled(snapshot.motion, softStart(now - snapshot.engagedSince));
    return order;
}

} // namespace console
