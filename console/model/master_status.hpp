// Which master is in the surgeon's hand, whether it can be relied on, and which others are there.
#pragma once

#include "model/instant.hpp"

#include <QString>

#include <cstdint>

namespace console {

enum class PermitPhase : std::uint8_t;

enum class MasterKind : std::uint8_t { Keyboard, SpaceMouse, GamePad, HapticSimulated, Recorded };

/// Keyboard, 3-D mouse, game pad, simulated haptic master, recording.
QString word(MasterKind kind);

/// Whether a master can be relied on to say when the hand lets go. Only one that is Alive moves anything.
enum class MasterLife : std::uint8_t {
    Gone,       ///< not connected
    Silent,     ///< connected, but not heard in time
    Unheard,    ///< something else has the keyboard: then no hand counts
    Unreleased, ///< not yet seen let go and at rest since it came
    Alive,
};

/// gone, silent, not heard, let go first, alive.
QString word(MasterLife life);

/// Another master can be taken: not while a permit is asked for or given.
bool masterMayChange(PermitPhase phase);

struct MasterStatus {
    MasterKind kind = MasterKind::Keyboard;
    QString name; ///< `Keyboard`, `Game pad X-Box 360`
    MasterLife life = MasterLife::Gone;
    Instant since; ///< when that life began
    bool inUse = false;
    QString note; ///< what else a person should know of it; may be empty

    bool operator==(const MasterStatus&) const = default;
};

} // namespace console
