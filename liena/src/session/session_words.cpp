// The words for states, reasons, causes and events, and what they mean for a person.
#include "liena/session_event.hpp"
#include "liena/session_state.hpp"

namespace liena {

std::string_view toString(SessionState state)
{
    switch (state) {
    case SessionState::Closed:
        return "closed";
    case SessionState::Opening:
        return "opening";
    case SessionState::Open:
        return "open";
    case SessionState::Suspect:
        return "suspect";
    case SessionState::Reconnecting:
        return "interrupted";
    case SessionState::StandBy:
        return "stand-by";
    case SessionState::Reopening:
        return "re-opening";
    case SessionState::Closing:
        return "closing";
    }
    return "unknown";
}

std::string_view toString(RejectReason reason)
{
    switch (reason) {
    case RejectReason::None:
        return "none";
    case RejectReason::UnknownPeer:
        return "unknown peer";
    case RejectReason::NoLink:
        return "no link";
    case RejectReason::TopologyMismatch:
        return "topology mismatch";
    case RejectReason::ProtocolVersion:
        return "protocol version";
    case RejectReason::MessageSetInvalid:
        return "message set invalid";
    case RejectReason::StandBy:
        return "stand-by";
    case RejectReason::Busy:
        return "busy";
    case RejectReason::ProtocolViolation:
        return "protocol violation";
    case RejectReason::Timeout:
        return "timeout";
    case RejectReason::ShuttingDown:
        return "shutting down";
    case RejectReason::AlreadyOpen:
        return "already open";
    case RejectReason::MessageSetChanged:
        return "message set changed";
    case RejectReason::NotAdmitted:
        return "not admitted";
    }
    return "unknown";
}

std::string_view toString(LossCause cause)
{
    switch (cause) {
    case LossCause::None:
        return "none";
    case LossCause::HeartbeatLost:
        return "heartbeat lost";
    case LossCause::ConnectionLost:
        return "connection lost";
    case LossCause::PeerRestarted:
        return "peer restarted";
    case LossCause::ProtocolViolation:
        return "protocol violation";
    case LossCause::LocalStall:
        return "local stall";
    }
    return "unknown";
}

std::string_view toString(ProbeResult result)
{
    switch (result) {
    case ProbeResult::NotProbed:
        return "not probed";
    case ProbeResult::InterfaceDown:
        return "interface down";
    case ProbeResult::NoRoute:
        return "no route";
    case ProbeResult::HostUnreachable:
        return "host unreachable";
    case ProbeResult::ConnectionRefused:
        return "connection refused";
    case ProbeResult::TlsFailure:
        return "TLS failure";
    case ProbeResult::PeerSilent:
        return "peer silent but connected";
    case ProbeResult::Reachable:
        return "reachable";
    }
    return "unknown";
}

std::string_view toString(SessionEvent::Kind kind)
{
    using Kind = SessionEvent::Kind;
    switch (kind) {
    case Kind::StateChanged:
        return "state changed";
    case Kind::Opened:
        return "opened";
    case Kind::OpenFailed:
        return "open failed";
    case Kind::Closed:
        return "closed";
    case Kind::Interrupted:
        return "interrupted";
    case Kind::Lost:
        return "lost";
    case Kind::Diagnosed:
        return "diagnosed";
    case Kind::ReOpened:
        return "re-opened";
    case Kind::IncidentRaised:
        return "incident raised";
    case Kind::IncidentEnded:
        return "incident ended";
    case Kind::CauseReported:
        return "cause reported";
    case Kind::HoldReported:
        return "hold reported";
    case Kind::StandByBegan:
        return "stand-by began";
    case Kind::StandByEnded:
        return "stand-by ended";
    case Kind::DeadlineMissed:
        return "deadline missed";
    case Kind::MessagesDropped:
        return "messages dropped";
    case Kind::SendFailed:
        return "send failed";
    case Kind::IdentityRefused:
        return "identity refused";
    case Kind::LocalStall:
        return "local stall";
    case Kind::AuditLost:
        return "audit file lost";
    case Kind::AuditRestored:
        return "audit file restored";
    }
    return "unknown";
}

std::string_view explain(RejectReason reason)
{
    switch (reason) {
    case RejectReason::None:
        return "The attempt ended without a word from the other side.";
    case RejectReason::UnknownPeer:
        return "The other device does not find this one in its topology: give both the same topology file.";
    case RejectReason::NoLink:
        return "The topology has no link between the two devices: add it and give every device the same file.";
    case RejectReason::TopologyMismatch:
        return "The two devices hold different topology files: give both the same bytes and restart them.";
    case RejectReason::ProtocolVersion:
        return "The two devices speak different versions of the protocol: update the older one.";
    case RejectReason::MessageSetInvalid:
        return "A message set does not hold what its device type needs: check the file with `liena check`.";
    case RejectReason::StandBy:
        return "The link is in stand-by: a person has to re-open it.";
    case RejectReason::Busy:
        return "An opening or closing with this device is in hand: wait a moment and try again.";
    case RejectReason::ProtocolViolation:
        return "One side broke the protocol: note the versions of both programs and report it.";
    case RejectReason::Timeout:
        return "The dialogue did not end in time: the other program is overloaded or stuck.";
    case RejectReason::ShuttingDown:
        return "The other program is stopping: start it again.";
    case RejectReason::AlreadyOpen:
        return "The device is in a session already: look for a second program with the same identity.";
    case RejectReason::MessageSetChanged:
        return "The device shows another message set than the one accepted for its type: a person has to read the changes and accept it "
               "(liena sets accept).";
    case RejectReason::NotAdmitted:
        return "One of the two devices begins no session until that is mended: see the detail, or its log.";
    }
    return "";
}

std::string_view explain(LossCause cause)
{
    switch (cause) {
    case LossCause::None:
        return "";
    case LossCause::HeartbeatLost:
        return "Nothing was heard of the peer for too long: the line, its computer or its program.";
    case LossCause::ConnectionLost:
        return "The connection broke: the peer's program ended, or something between reset it.";
    case LossCause::PeerRestarted:
        return "The peer's program was restarted and knows nothing of the session.";
    case LossCause::ProtocolViolation:
        return "One side broke the protocol and the session was ended for safety.";
    case LossCause::LocalStall:
        return "This computer did not run for too long: it is overloaded or was paused.";
    }
    return "";
}

std::string_view explain(ProbeResult result)
{
    switch (result) {
    case ProbeResult::NotProbed:
        return "No probe was made yet.";
    case ProbeResult::InterfaceDown:
        return "This computer has no network there: plug, cable and switch at this side.";
    case ProbeResult::NoRoute:
        return "The network is up and knows no way to the device: gateway and VPN.";
    case ProbeResult::HostUnreachable:
        return "The device's computer does not answer: its power and cable, or the site's line.";
    case ProbeResult::ConnectionRefused:
        return "The computer answers and its program is not running: start the program at the patient side.";
    case ProbeResult::TlsFailure:
        return "The device answered and an identity was refused: do not bypass this, call service.";
    case ProbeResult::PeerSilent:
        return "The device accepts connections and says nothing: its program hangs or is overloaded; wait 2 s, then restart it.";
    case ProbeResult::Reachable:
        return "The device answers again: the channel can be re-opened.";
    }
    return "";
}

} // namespace liena
