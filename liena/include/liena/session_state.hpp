// The words of a session's life, as they stand on the wire (protocol sections 7 and 8).
#pragma once

#include <cstdint>
#include <string_view>

namespace liena {

enum class SessionState : std::uint8_t {
    Closed = 0,
    Opening = 1,
    Open = 2,
    Suspect = 3,      ///< silence: shown, not acted on
    Reconnecting = 4, ///< no control message is sent or delivered
    StandBy = 5,      ///< lost; only a person's re-open leads out
    Reopening = 6,
    Closing = 7,
};

/// Why an opening, or a session, was refused.
enum class RejectReason : std::uint8_t {
    None = 0,
    UnknownPeer = 1,
    NoLink = 2,
    TopologyMismatch = 3,
    ProtocolVersion = 4,
    MessageSetInvalid = 5,
    StandBy = 6,
    Busy = 7,
    ProtocolViolation = 8,
    Timeout = 9,
    ShuttingDown = 10,
    AlreadyOpen = 11,
    MessageSetChanged = 12,
    NotAdmitted = 13, ///< the device begins no session now; the detail says why
};

/// Why a session was lost.
enum class LossCause : std::uint8_t {
    None = 0,
    HeartbeatLost = 1,
    ConnectionLost = 2,
    PeerRestarted = 3,
    ProtocolViolation = 4,
    LocalStall = 5,
};

/// What a probe found between this device and a peer.
enum class ProbeResult : std::uint8_t {
    NotProbed,
    InterfaceDown,     ///< this computer has no network on that way
    NoRoute,           ///< the network is up and knows no way there
    HostUnreachable,   ///< the way is known and the computer does not answer
    ConnectionRefused, ///< the computer answers, its program does not listen
    TlsFailure,        ///< the program answers and an identity was refused
    PeerSilent,        ///< the program accepts connections and says nothing
    Reachable,         ///< connection and identity are as they should be
};

std::string_view toString(SessionState state);
std::string_view toString(RejectReason reason);
std::string_view toString(LossCause cause);
std::string_view toString(ProbeResult result);

/// A sentence for a person: what it means and what to try.
std::string_view explain(RejectReason reason);
std::string_view explain(LossCause cause);
std::string_view explain(ProbeResult result);

/// The session is open in the sense of an application: its messages may flow.
constexpr bool carriesMessages(SessionState state) { return state == SessionState::Open || state == SessionState::Suspect; }

/// The token of the lost session; never 0.
using IncidentId = std::uint64_t;

} // namespace liena
