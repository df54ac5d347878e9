// The robotic arm as it last reported itself.
#pragma once

#include "model/aged.hpp"

#include <QObject>
#include <QString>

#include <array>
#include <chrono>
#include <cstdint>

namespace console {

enum class ArmPhase : std::uint8_t { Off, Hold, Moving, Fault };
QString word(ArmPhase phase);

struct ArmStatus {
    std::array<double, 6> positions{};  ///< rad, base to wrist
    std::array<double, 6> velocities{}; ///< rad/s
    std::array<double, 6> torques{};    ///< N·m
    bool brake = false;
    ArmPhase phase = ArmPhase::Off;
    bool holding = false;
    quint64 refusedCommands = 0;
};

/// GUI thread only.
class ArmState : public QObject {
    Q_OBJECT
public:
    static constexpr std::chrono::milliseconds statusLimit{200};

    explicit ArmState(QObject* parent = nullptr);

    const Aged<ArmStatus>& status() const { return m_status; }
    bool fresh(Instant now) const { return m_status.freshness(now, statusLimit) == Freshness::Fresh; }
    void receive(const ArmStatus& status, Instant at);

Q_SIGNALS:
    void statusChanged();

private:
    Aged<ArmStatus> m_status;
};

} // namespace console
