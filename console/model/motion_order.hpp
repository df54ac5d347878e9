// What may leave for the robot at one moment: the last check between the surgeon's screen and the wire.
#pragma once

#include "model/hand_state.hpp"
#include "model/instant.hpp"
#include "model/motion_permit.hpp"

#include <chrono>
#include <optional>

namespace console {

/// What the GUI thread last knew; handed whole to the network thread.
struct MotionSnapshot {
    MotionStream stream = MotionStream::None;
    quint32 permit = 0;
    quint32 engagement = 0;
    Instant engagedSince;
    HandMotion motion;
    Instant guiTick;                     ///< when the GUI thread wrote this
    std::optional<Instant> shownCapture; ///< when the newest painted picture was taken, at the earliest
    Duration pictureLimit{};
};

struct MotionOrder {
    quint32 permit = 0;
    quint32 sequence = 0;
    bool engaged = false;
    HandMotion motion;
};

/// What the last check before the wire refuses motion under from now on.
struct BlockedPermit {
    quint32 permit = 0;
    bool byPicture = false; ///< which was too old; else the screen stood still

    bool operator==(const BlockedPermit&) const = default;
};

/// Network thread only. Motion needs a GUI that ran within 100 ms and a picture younger than its limit, whatever the permit says: a screen
/// that hangs must not move instruments. A permit that failed this once is never used for motion again.
class MotionGate {
public:
    static constexpr std::chrono::milliseconds guiLimit{100};

    /// The order to send now, or nothing.
    std::optional<MotionOrder> compose(const MotionSnapshot& snapshot, Instant now);

    /// Motion is refused under this permit from now on: the screen stood still, or its picture was too old.
    std::optional<BlockedPermit> blockedPermit() const
    {
        return m_blocked ? std::optional(BlockedPermit{m_permit, m_blockedByPicture}) : std::nullopt;
    }

private:
    quint32 m_permit = 0;
    quint32 m_sequence = 0;
    bool m_blocked = false;
    bool m_blockedByPicture = false;
    bool m_any = false;
};

} // namespace console
