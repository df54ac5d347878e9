// A session that stands, and its closing: what each input does, one row per cell.
#pragma once

#include <string_view>
#include <utility>
#include <vector>

namespace liena::test {

/// `input  state after it  actions in order`; a change of state is no action of its own. The robot, which has the lower id, is asked.
// clang-format off
inline const std::vector<std::pair<std::string_view, std::string_view>> sessionCells{
    {"Open", R"(
OpenRequested              Open
ReopenRequested            Open
CloseRequested             Closing       DiscardControl Disengagement
OutgoingUp                 Open
OutgoingFailed             Open
OutgoingLost               Reconnecting  DiscardControl Connect
IncomingUp                 Open
IncomingLost               Reconnecting  DiscardControl Heartbeat
HandshakeHeard             Open
HandshakeHeard-diagnosis   Reopening     DiscardAll CloseLanes Lost:PeerRestarted Adopt Connect
CommitHeard                StandBy       Rejected DiscardAll CloseLanes Lost:ProtocolViolation
CommitHeard-diagnosis      StandBy       Rejected DiscardAll CloseLanes Lost:ProtocolViolation
SetHeard                   StandBy       Rejected DiscardAll CloseLanes Lost:ProtocolViolation
LifeHeard                  Open
ViolationFound             StandBy       Rejected DiscardAll CloseLanes Lost:ProtocolViolation
Stalled                    Reconnecting  DiscardAll Heartbeat
IncidentHeld-this-session  StandBy       DiscardAll CloseLanes Lost:ConnectionLost
IncidentHeld-an-older      Open
IncidentGone               Open
Tick-nothing-due           Open
Tick-after-4s              Reconnecting  Heartbeat DiscardControl Heartbeat Connect
Attach                     StandBy       Rejected DiscardAll CloseLanes Lost:ProtocolViolation
Handshake                  StandBy       Rejected DiscardAll CloseLanes Lost:ProtocolViolation
HandshakeCommit            StandBy       Rejected DiscardAll CloseLanes Lost:ProtocolViolation
MessageSetRequest          StandBy       Rejected DiscardAll CloseLanes Lost:ProtocolViolation
MessageSet                 StandBy       Rejected DiscardAll CloseLanes Lost:ProtocolViolation
ChannelOpened              StandBy       Rejected DiscardAll CloseLanes Lost:ProtocolViolation
Rejected                   StandBy       DiscardAll CloseLanes Lost:ProtocolViolation
Heartbeat                  Open
Disengagement              Closing       DiscardControl DisengagementCommit(last)
DisengagementCommit        StandBy       Rejected DiscardAll CloseLanes Lost:ProtocolViolation
ChannelClosed              StandBy       Rejected DiscardAll CloseLanes Lost:ProtocolViolation
DiagnosisHandshake         StandBy       Rejected DiscardAll CloseLanes Lost:ProtocolViolation
DiagnosisHandshakeCommit   StandBy       Rejected DiscardAll CloseLanes Lost:ProtocolViolation
ChannelReOpened            StandBy       Rejected DiscardAll CloseLanes Lost:ProtocolViolation
StandBy                    Open
StandByReport              Open
IncidentDismissed          Open
LinkReport                 Open
Abandon                    Open
MeasureRequest             Open
MeasureAnswer              Open
Probe                      Open
ProbeEcho                  Open
)"},
    {"Suspect", R"(
OpenRequested              Suspect
ReopenRequested            Suspect
CloseRequested             Closing       DiscardControl Disengagement
OutgoingUp                 Suspect
OutgoingFailed             Suspect
OutgoingLost               Reconnecting  DiscardControl Connect
IncomingUp                 Suspect
IncomingLost               Reconnecting  DiscardControl Heartbeat
HandshakeHeard             Suspect
HandshakeHeard-diagnosis   Reopening     DiscardAll CloseLanes Lost:PeerRestarted Adopt Connect
CommitHeard                StandBy       Rejected DiscardAll CloseLanes Lost:ProtocolViolation
CommitHeard-diagnosis      StandBy       Rejected DiscardAll CloseLanes Lost:ProtocolViolation
SetHeard                   StandBy       Rejected DiscardAll CloseLanes Lost:ProtocolViolation
LifeHeard                  Open
ViolationFound             StandBy       Rejected DiscardAll CloseLanes Lost:ProtocolViolation
Stalled                    Reconnecting  DiscardAll Heartbeat
IncidentHeld-this-session  StandBy       DiscardAll CloseLanes Lost:ConnectionLost
IncidentHeld-an-older      Suspect
IncidentGone               Suspect
Tick-nothing-due           Suspect
Tick-after-4s              Reconnecting  Heartbeat DiscardControl Heartbeat Connect
Attach                     StandBy       Rejected DiscardAll CloseLanes Lost:ProtocolViolation
Handshake                  StandBy       Rejected DiscardAll CloseLanes Lost:ProtocolViolation
HandshakeCommit            StandBy       Rejected DiscardAll CloseLanes Lost:ProtocolViolation
MessageSetRequest          StandBy       Rejected DiscardAll CloseLanes Lost:ProtocolViolation
MessageSet                 StandBy       Rejected DiscardAll CloseLanes Lost:ProtocolViolation
ChannelOpened              StandBy       Rejected DiscardAll CloseLanes Lost:ProtocolViolation
Rejected                   StandBy       DiscardAll CloseLanes Lost:ProtocolViolation
Heartbeat                  Suspect
Disengagement              Closing       DiscardControl DisengagementCommit(last)
DisengagementCommit        StandBy       Rejected DiscardAll CloseLanes Lost:ProtocolViolation
ChannelClosed              StandBy       Rejected DiscardAll CloseLanes Lost:ProtocolViolation
DiagnosisHandshake         StandBy       Rejected DiscardAll CloseLanes Lost:ProtocolViolation
DiagnosisHandshakeCommit   StandBy       Rejected DiscardAll CloseLanes Lost:ProtocolViolation
ChannelReOpened            StandBy       Rejected DiscardAll CloseLanes Lost:ProtocolViolation
StandBy                    Suspect
StandByReport              Suspect
IncidentDismissed          Suspect
LinkReport                 Suspect
Abandon                    Suspect
MeasureRequest             Suspect
MeasureAnswer              Suspect
Probe                      Suspect
ProbeEcho                  Suspect
)"},
    {"Reconnecting", R"(
OpenRequested              Reconnecting
ReopenRequested            Reconnecting
CloseRequested             Closing       DiscardControl Disengagement
OutgoingUp                 Reconnecting  Heartbeat
OutgoingFailed             Reconnecting
OutgoingLost               Reconnecting
IncomingUp                 Reconnecting
IncomingLost               Reconnecting
HandshakeHeard             StandBy       DiscardAll CloseLanes Lost:PeerRestarted Refuse:StandBy
HandshakeHeard-diagnosis   Reopening     DiscardAll CloseLanes Lost:PeerRestarted Adopt Connect
CommitHeard                StandBy       Rejected DiscardAll CloseLanes Lost:ProtocolViolation
CommitHeard-diagnosis      StandBy       Rejected DiscardAll CloseLanes Lost:ProtocolViolation
SetHeard                   StandBy       Rejected DiscardAll CloseLanes Lost:ProtocolViolation
LifeHeard                  Reconnecting
ViolationFound             StandBy       Rejected DiscardAll CloseLanes Lost:ProtocolViolation
Stalled                    Reconnecting  DiscardAll
IncidentHeld-this-session  StandBy       DiscardAll CloseLanes Lost:ConnectionLost
IncidentHeld-an-older      Reconnecting
IncidentGone               Reconnecting
Tick-nothing-due           Reconnecting
Tick-after-4s              StandBy       Heartbeat DiscardAll CloseLanes Lost:HeartbeatLost
Attach                     StandBy       Rejected DiscardAll CloseLanes Lost:ProtocolViolation
Handshake                  StandBy       Rejected DiscardAll CloseLanes Lost:ProtocolViolation
HandshakeCommit            StandBy       Rejected DiscardAll CloseLanes Lost:ProtocolViolation
MessageSetRequest          StandBy       Rejected DiscardAll CloseLanes Lost:ProtocolViolation
MessageSet                 StandBy       Rejected DiscardAll CloseLanes Lost:ProtocolViolation
ChannelOpened              StandBy       Rejected DiscardAll CloseLanes Lost:ProtocolViolation
Rejected                   StandBy       DiscardAll CloseLanes Lost:ProtocolViolation
Heartbeat                  Open          Interrupted Heartbeat
Disengagement              Closing       DiscardControl DisengagementCommit(last)
DisengagementCommit        StandBy       Rejected DiscardAll CloseLanes Lost:ProtocolViolation
ChannelClosed              StandBy       Rejected DiscardAll CloseLanes Lost:ProtocolViolation
DiagnosisHandshake         StandBy       Rejected DiscardAll CloseLanes Lost:ProtocolViolation
DiagnosisHandshakeCommit   StandBy       Rejected DiscardAll CloseLanes Lost:ProtocolViolation
ChannelReOpened            StandBy       Rejected DiscardAll CloseLanes Lost:ProtocolViolation
StandBy                    Reconnecting
StandByReport              Reconnecting
IncidentDismissed          Reconnecting
LinkReport                 Reconnecting
Abandon                    Reconnecting
MeasureRequest             Reconnecting
MeasureAnswer              Reconnecting
Probe                      Reconnecting
ProbeEcho                  Reconnecting
)"},
    {"Closing-initiator", R"(
OpenRequested              Closing
ReopenRequested            Closing
CloseRequested             Closing
OutgoingUp                 Closing
OutgoingFailed             Closing
OutgoingLost               Closed        CloseLanes Closed
IncomingUp                 Closing
IncomingLost               Closed        CloseLanes Closed
HandshakeHeard             Closing       Refuse:Busy
HandshakeHeard-diagnosis   Closing       Refuse:Busy
CommitHeard                Closed        Rejected CloseLanes Closed
CommitHeard-diagnosis      Closed        Rejected CloseLanes Closed
SetHeard                   Closed        Rejected CloseLanes Closed
LifeHeard                  Closing
ViolationFound             Closed        Rejected CloseLanes Closed
Stalled                    Closing
IncidentHeld-this-session  Closing
IncidentHeld-an-older      Closing
IncidentGone               Closing
Tick-nothing-due           Closing
Tick-after-4s              Closed        Heartbeat CloseLanes Closed
Attach                     Closed        Rejected CloseLanes Closed
Handshake                  Closed        Rejected CloseLanes Closed
HandshakeCommit            Closed        Rejected CloseLanes Closed
MessageSetRequest          Closed        Rejected CloseLanes Closed
MessageSet                 Closed        Rejected CloseLanes Closed
ChannelOpened              Closed        Rejected CloseLanes Closed
Rejected                   Closed        CloseLanes Closed
Heartbeat                  Closing
Disengagement              Closing       DisengagementCommit(last)
DisengagementCommit        Closed        ChannelClosed CloseLanes Closed
ChannelClosed              Closed        CloseLanes Closed
DiagnosisHandshake         Closed        Rejected CloseLanes Closed
DiagnosisHandshakeCommit   Closed        Rejected CloseLanes Closed
ChannelReOpened            Closed        Rejected CloseLanes Closed
StandBy                    Closing
StandByReport              Closing
IncidentDismissed          Closing
LinkReport                 Closing
Abandon                    Closing
MeasureRequest             Closing
MeasureAnswer              Closing
Probe                      Closing
ProbeEcho                  Closing
)"},
    {"Closing-responder", R"(
OpenRequested              Closing
ReopenRequested            Closing
CloseRequested             Closing
OutgoingUp                 Closing
OutgoingFailed             Closing
OutgoingLost               Closed        CloseLanes ClosedByPeer
IncomingUp                 Closing
IncomingLost               Closed        CloseLanes ClosedByPeer
HandshakeHeard             Closing       Refuse:Busy
HandshakeHeard-diagnosis   Closing       Refuse:Busy
CommitHeard                Closed        Rejected CloseLanes ClosedByPeer
CommitHeard-diagnosis      Closed        Rejected CloseLanes ClosedByPeer
SetHeard                   Closed        Rejected CloseLanes ClosedByPeer
LifeHeard                  Closing
ViolationFound             Closed        Rejected CloseLanes ClosedByPeer
Stalled                    Closing
IncidentHeld-this-session  Closing
IncidentHeld-an-older      Closing
IncidentGone               Closing
Tick-nothing-due           Closing
Tick-after-4s              Closed        Heartbeat CloseLanes ClosedByPeer
Attach                     Closed        Rejected CloseLanes ClosedByPeer
Handshake                  Closed        Rejected CloseLanes ClosedByPeer
HandshakeCommit            Closed        Rejected CloseLanes ClosedByPeer
MessageSetRequest          Closed        Rejected CloseLanes ClosedByPeer
MessageSet                 Closed        Rejected CloseLanes ClosedByPeer
ChannelOpened              Closed        Rejected CloseLanes ClosedByPeer
Rejected                   Closed        CloseLanes ClosedByPeer
Heartbeat                  Closing
Disengagement              Closing       DisengagementCommit(last)
DisengagementCommit        Closing
ChannelClosed              Closed        CloseLanes ClosedByPeer
DiagnosisHandshake         Closed        Rejected CloseLanes ClosedByPeer
DiagnosisHandshakeCommit   Closed        Rejected CloseLanes ClosedByPeer
ChannelReOpened            Closed        Rejected CloseLanes ClosedByPeer
StandBy                    Closing
StandByReport              Closing
IncidentDismissed          Closing
LinkReport                 Closing
Abandon                    Closing
MeasureRequest             Closing
MeasureAnswer              Closing
Probe                      Closing
ProbeEcho                  Closing
)"},
};
// clang-format on

} // namespace liena::test
