// The motion commands on their way out: composed on the network thread, so that a stutter of the screen does not stutter the robot.
#pragma once

#include "link/motion_command.hpp"
#include "model/latest_value.hpp"
#include "model/motion_order.hpp"

#include <liena/distributed_system.hpp>

#include <atomic>
#include <chrono>
#include <optional>

namespace console {

class MotionStreamer {
public:
    static constexpr std::chrono::milliseconds period{2};

    MotionStreamer(liena::DistributedSystem& system, liena::DeviceId robot) : m_system(system), m_robot(robot) {}

    /// GUI thread.
    void publish(const MotionSnapshot& snapshot) { m_snapshot.write(snapshot); }

    /// Network thread, once a period.
    void run();

    // Any thread.
    quint64 sent() const { return m_sent.load(std::memory_order_relaxed); }
    quint64 refused() const { return m_refused.load(std::memory_order_relaxed); }
    /// See MotionGate::blockedPermit().
    std::optional<BlockedPermit> blockedPermit() const
    {
        const quint64 blocked = m_blocked.load(std::memory_order_relaxed);
        return blocked != 0 ? std::optional(BlockedPermit{static_cast<quint32>(blocked), (blocked & pictureBit) != 0}) : std::nullopt;
    }

private:
    static constexpr quint64 blockedBit = quint64{1} << 32;
    static constexpr quint64 pictureBit = quint64{1} << 33;

    bool bind();
    bool send(const MotionOrder& order);

    liena::DistributedSystem& m_system;
    liena::DeviceId m_robot;
    LatestValue<MotionSnapshot> m_snapshot;
    MotionGate m_gate;
    std::optional<MotionBinding> m_binding; ///< network thread; nothing while the robot's set is unknown, or does not fit
    std::atomic<quint64> m_sent{0};
    std::atomic<quint64> m_refused{0};
    std::atomic<quint64> m_blocked{0}; ///< the permit, and the bits above it; 0: none
};

} // namespace console
