// A loss that stands between the system and motion, and what is known about it.
#pragma once

#include "model/instant.hpp"
#include "model/link_state.hpp"

#include <QString>

#include <cstdint>
#include <optional>
#include <vector>

namespace console {

enum class LossKind : std::uint8_t { None, HeartbeatLost, ConnectionLost, PeerRestarted, ProtocolViolation, LocalStall };

enum class ProbeFinding : std::uint8_t {
    NotProbed,
    InterfaceDown,
    NoRoute,
    HostUnreachable,
    ConnectionRefused,
    TlsFailure,
    PeerSilent,
    Reachable,
};

/// How far a loss of one link has come.
enum class LossStage : std::uint8_t {
    Lost,        ///< it will not heal by itself: an incident is held, and the system stands by
    Interrupted, ///< it may heal by itself, until the topology's `reconnect` is over
    Healed,      ///< it was interrupted, and is open again
};

/// What was heard, counted and found by a probe.
struct LinkDiagnosis {
    LossKind cause = LossKind::None;
    ProbeFinding probe = ProbeFinding::NotProbed;
    QString probeDetail;
    Duration silence{};             ///< between the last datagram heard and the decision
    quint64 heartbeatsExpected = 0; ///< in the second before the loss began
    quint64 heartbeatsReceived = 0;
    std::optional<Duration> lastRoundTrip;
    bool toPeerConnected = false;            ///< our connection to the peer stood at the decision
    bool fromPeerConnected = false;          ///< the peer's connection to us stood at the decision
    LinkState peerState = LinkState::Closed; ///< as the peer last said it
    QString detail;
};

/// One line of the roll-call: has this device said that it holds?
struct HoldLine {
    quint32 device = 0;
    QString title;
    bool holding = false;
    std::optional<double> afterMs; ///< from the loss to this device's confirmation; only where both clocks are comparable
    bool already = false;          ///< it held before the loss was noticed here, as far as the clocks can tell: then there is no such time
};

struct IncidentRecord {
    quint64 id = 0;
    LossStage stage = LossStage::Lost;
    quint32 a = 0;
    quint32 b = 0;
    quint32 peer = 0;                ///< the other end when this console is one of the pair, else 0
    LossKind cause = LossKind::None; ///< as the end saw it that first said so
    LossKind causeOfA = LossKind::None;
    LossKind causeOfB = LossKind::None;
    Instant since;               ///< when this console learnt of it; of one that it saw as an interruption first, when that began
    Instant healed;              ///< when it was open again, of one that healed
    qint64 sinceWallMs = 0;      ///< the same, on this console's clock: Unix time, milliseconds
    std::vector<HoldLine> holds; ///< every device of the system, in the topology's order
    std::optional<LinkDiagnosis> diagnosis;
    bool probing = false;
    QString reopenFailure; ///< why the last re-opening failed and what to do next; empty when none failed
    int reopenTries = 0;
    int flaps = 1;       ///< losses of this pair in the last two minutes, this one included
    bool folded = false; ///< folded to a chip; an incident never vanishes before it ends
};

} // namespace console
