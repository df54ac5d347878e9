// Closed, StandBy and the dialogues that lead out of them: what each input does, one row per cell.
#pragma once

#include <string_view>
#include <utility>
#include <vector>

namespace liena::test {

/// `input  state after it  actions in order`; a change of state is no action of its own. The robot, which has the lower id, is asked.
// clang-format off
inline const std::vector<std::pair<std::string_view, std::string_view>> dialogueCells{
    {"Closed", R"(
OpenRequested              Opening       Connect
ReopenRequested            Closed
CloseRequested             Closed
OutgoingUp                 Closed
OutgoingFailed             Closed
OutgoingLost               Closed
IncomingUp                 Closed
IncomingLost               Closed
HandshakeHeard             Opening       Adopt Connect
HandshakeHeard-diagnosis   Reopening     Adopt Connect
CommitHeard                Closed
CommitHeard-diagnosis      Closed
SetHeard                   Closed
LifeHeard                  Closed
ViolationFound             Closed
Stalled                    Closed
IncidentHeld-this-session  StandBy
IncidentHeld-an-older      StandBy
IncidentGone               Closed
Tick-nothing-due           Closed
Tick-after-4s              Closed
Attach                     Closed
Handshake                  Closed
HandshakeCommit            Closed
MessageSetRequest          Closed
MessageSet                 Closed
ChannelOpened              Closed
Rejected                   Closed
Heartbeat                  Closed
Disengagement              Closed
DisengagementCommit        Closed
ChannelClosed              Closed
DiagnosisHandshake         Closed
DiagnosisHandshakeCommit   Closed
ChannelReOpened            Closed
StandBy                    Closed
StandByReport              Closed
IncidentDismissed          Closed
LinkReport                 Closed
Abandon                    Closed
MeasureRequest             Closed
MeasureAnswer              Closed
Probe                      Closed
ProbeEcho                  Closed
)"},
    {"Opening-initiator", R"(
OpenRequested              Opening
ReopenRequested            Opening
CloseRequested             Closed        Rejected CloseLanes Failed:ShuttingDown
OutgoingUp                 Opening
OutgoingFailed             Opening
OutgoingLost               Opening
IncomingUp                 Opening
IncomingLost               Opening
HandshakeHeard             Opening       Ignore
HandshakeHeard-diagnosis   Opening       Ignore
CommitHeard                Open          ChannelOpened Opened Heartbeat
CommitHeard-diagnosis      Closed        Rejected CloseLanes Failed:ProtocolViolation
SetHeard                   Closed        Rejected CloseLanes Failed:ProtocolViolation
LifeHeard                  Opening
ViolationFound             Closed        Rejected CloseLanes Failed:ProtocolViolation
Stalled                    Opening
IncidentHeld-this-session  StandBy       Rejected CloseLanes Failed:StandBy
IncidentHeld-an-older      StandBy       Rejected CloseLanes Failed:StandBy
IncidentGone               Opening
Tick-nothing-due           Opening
Tick-after-4s              Closed        Heartbeat Rejected CloseLanes Failed:Timeout
Attach                     Closed        Rejected CloseLanes Failed:ProtocolViolation
Handshake                  Closed        Rejected CloseLanes Failed:ProtocolViolation
HandshakeCommit            Closed        Rejected CloseLanes Failed:ProtocolViolation
MessageSetRequest          Closed        Rejected CloseLanes Failed:ProtocolViolation
MessageSet                 Closed        Rejected CloseLanes Failed:ProtocolViolation
ChannelOpened              Closed        Rejected CloseLanes Failed:ProtocolViolation
Rejected                   Closed        CloseLanes Failed:Busy
Heartbeat                  Opening
Disengagement              Closed        Rejected CloseLanes Failed:ProtocolViolation
DisengagementCommit        Closed        Rejected CloseLanes Failed:ProtocolViolation
ChannelClosed              Closed        Rejected CloseLanes Failed:ProtocolViolation
DiagnosisHandshake         Closed        Rejected CloseLanes Failed:ProtocolViolation
DiagnosisHandshakeCommit   Closed        Rejected CloseLanes Failed:ProtocolViolation
ChannelReOpened            Closed        Rejected CloseLanes Failed:ProtocolViolation
StandBy                    Closed        Rejected CloseLanes Failed:ProtocolViolation
StandByReport              Closed        Rejected CloseLanes Failed:ProtocolViolation
IncidentDismissed          Closed        Rejected CloseLanes Failed:ProtocolViolation
LinkReport                 Closed        Rejected CloseLanes Failed:ProtocolViolation
Abandon                    Closed        Rejected CloseLanes Failed:ProtocolViolation
MeasureRequest             Closed        Rejected CloseLanes Failed:ProtocolViolation
MeasureAnswer              Closed        Rejected CloseLanes Failed:ProtocolViolation
Probe                      Closed        Rejected CloseLanes Failed:ProtocolViolation
ProbeEcho                  Closed        Rejected CloseLanes Failed:ProtocolViolation
)"},
    {"Opening-responder", R"(
OpenRequested              Opening
ReopenRequested            Opening
CloseRequested             Closed        Rejected CloseLanes Failed:ShuttingDown
OutgoingUp                 Opening
OutgoingFailed             Opening
OutgoingLost               Opening
IncomingUp                 Opening
IncomingLost               Opening
HandshakeHeard             Opening       CloseLanes Adopt Connect
HandshakeHeard-diagnosis   Reopening     CloseLanes Adopt Connect
CommitHeard                Closed        Rejected CloseLanes Failed:ProtocolViolation
CommitHeard-diagnosis      Closed        Rejected CloseLanes Failed:ProtocolViolation
SetHeard                   Closed        Rejected CloseLanes Failed:ProtocolViolation
LifeHeard                  Opening
ViolationFound             Closed        Rejected CloseLanes Failed:ProtocolViolation
Stalled                    Opening
IncidentHeld-this-session  StandBy       Rejected CloseLanes Failed:StandBy
IncidentHeld-an-older      StandBy       Rejected CloseLanes Failed:StandBy
IncidentGone               Opening
Tick-nothing-due           Opening
Tick-after-4s              Closed        Heartbeat Rejected CloseLanes Failed:Timeout
Attach                     Closed        Rejected CloseLanes Failed:ProtocolViolation
Handshake                  Closed        Rejected CloseLanes Failed:ProtocolViolation
HandshakeCommit            Closed        Rejected CloseLanes Failed:ProtocolViolation
MessageSetRequest          Opening       OwnSet
MessageSet                 Closed        Rejected CloseLanes Failed:ProtocolViolation
ChannelOpened              Open          Opened Heartbeat
Rejected                   Closed        CloseLanes Failed:Busy
Heartbeat                  Opening
Disengagement              Closed        Rejected CloseLanes Failed:ProtocolViolation
DisengagementCommit        Closed        Rejected CloseLanes Failed:ProtocolViolation
ChannelClosed              Closed        Rejected CloseLanes Failed:ProtocolViolation
DiagnosisHandshake         Closed        Rejected CloseLanes Failed:ProtocolViolation
DiagnosisHandshakeCommit   Closed        Rejected CloseLanes Failed:ProtocolViolation
ChannelReOpened            Closed        Rejected CloseLanes Failed:ProtocolViolation
StandBy                    Closed        Rejected CloseLanes Failed:ProtocolViolation
StandByReport              Closed        Rejected CloseLanes Failed:ProtocolViolation
IncidentDismissed          Closed        Rejected CloseLanes Failed:ProtocolViolation
LinkReport                 Closed        Rejected CloseLanes Failed:ProtocolViolation
Abandon                    Closed        Rejected CloseLanes Failed:ProtocolViolation
MeasureRequest             Closed        Rejected CloseLanes Failed:ProtocolViolation
MeasureAnswer              Closed        Rejected CloseLanes Failed:ProtocolViolation
Probe                      Closed        Rejected CloseLanes Failed:ProtocolViolation
ProbeEcho                  Closed        Rejected CloseLanes Failed:ProtocolViolation
)"},
    {"StandBy", R"(
OpenRequested              StandBy
ReopenRequested            Reopening     Connect
CloseRequested             StandBy
OutgoingUp                 StandBy
OutgoingFailed             StandBy
OutgoingLost               StandBy
IncomingUp                 StandBy
IncomingLost               StandBy
HandshakeHeard             StandBy       Refuse:StandBy
HandshakeHeard-diagnosis   Reopening     Adopt Connect
CommitHeard                StandBy
CommitHeard-diagnosis      StandBy
SetHeard                   StandBy
LifeHeard                  StandBy
ViolationFound             StandBy
Stalled                    StandBy
IncidentHeld-this-session  StandBy
IncidentHeld-an-older      StandBy
IncidentGone               Closed
Tick-nothing-due           StandBy
Tick-after-4s              StandBy
Attach                     StandBy
Handshake                  StandBy
HandshakeCommit            StandBy
MessageSetRequest          StandBy
MessageSet                 StandBy
ChannelOpened              StandBy
Rejected                   StandBy
Heartbeat                  StandBy
Disengagement              StandBy
DisengagementCommit        StandBy
ChannelClosed              StandBy
DiagnosisHandshake         StandBy
DiagnosisHandshakeCommit   StandBy
ChannelReOpened            StandBy
StandBy                    StandBy
StandByReport              StandBy
IncidentDismissed          StandBy
LinkReport                 StandBy
Abandon                    StandBy
MeasureRequest             StandBy
MeasureAnswer              StandBy
Probe                      StandBy
ProbeEcho                  StandBy
)"},
    {"Reopening-initiator", R"(
OpenRequested              Reopening
ReopenRequested            Reopening
CloseRequested             StandBy       Rejected CloseLanes Failed:ShuttingDown
OutgoingUp                 Reopening
OutgoingFailed             Reopening
OutgoingLost               Reopening
IncomingUp                 Reopening
IncomingLost               Reopening
HandshakeHeard             Reopening     Ignore
HandshakeHeard-diagnosis   Reopening     Ignore
CommitHeard                StandBy       Rejected CloseLanes Failed:ProtocolViolation
CommitHeard-diagnosis      Open          ChannelReOpened ReOpened Heartbeat
SetHeard                   StandBy       Rejected CloseLanes Failed:ProtocolViolation
LifeHeard                  Reopening
ViolationFound             StandBy       Rejected CloseLanes Failed:ProtocolViolation
Stalled                    Reopening
IncidentHeld-this-session  StandBy       Rejected CloseLanes Failed:StandBy
IncidentHeld-an-older      Reopening
IncidentGone               Reopening
Tick-nothing-due           Reopening
Tick-after-4s              StandBy       Heartbeat Rejected CloseLanes Failed:Timeout
Attach                     StandBy       Rejected CloseLanes Failed:ProtocolViolation
Handshake                  StandBy       Rejected CloseLanes Failed:ProtocolViolation
HandshakeCommit            StandBy       Rejected CloseLanes Failed:ProtocolViolation
MessageSetRequest          StandBy       Rejected CloseLanes Failed:ProtocolViolation
MessageSet                 StandBy       Rejected CloseLanes Failed:ProtocolViolation
ChannelOpened              StandBy       Rejected CloseLanes Failed:ProtocolViolation
Rejected                   StandBy       CloseLanes Failed:Busy
Heartbeat                  Reopening
Disengagement              StandBy       Rejected CloseLanes Failed:ProtocolViolation
DisengagementCommit        StandBy       Rejected CloseLanes Failed:ProtocolViolation
ChannelClosed              StandBy       Rejected CloseLanes Failed:ProtocolViolation
DiagnosisHandshake         StandBy       Rejected CloseLanes Failed:ProtocolViolation
DiagnosisHandshakeCommit   StandBy       Rejected CloseLanes Failed:ProtocolViolation
ChannelReOpened            StandBy       Rejected CloseLanes Failed:ProtocolViolation
StandBy                    StandBy       Rejected CloseLanes Failed:ProtocolViolation
StandByReport              StandBy       Rejected CloseLanes Failed:ProtocolViolation
IncidentDismissed          StandBy       Rejected CloseLanes Failed:ProtocolViolation
LinkReport                 StandBy       Rejected CloseLanes Failed:ProtocolViolation
Abandon                    StandBy       Rejected CloseLanes Failed:ProtocolViolation
MeasureRequest             StandBy       Rejected CloseLanes Failed:ProtocolViolation
MeasureAnswer              StandBy       Rejected CloseLanes Failed:ProtocolViolation
Probe                      StandBy       Rejected CloseLanes Failed:ProtocolViolation
ProbeEcho                  StandBy       Rejected CloseLanes Failed:ProtocolViolation
)"},
    {"Reopening-responder", R"(
OpenRequested              Reopening
ReopenRequested            Reopening
CloseRequested             StandBy       Rejected CloseLanes Failed:ShuttingDown
OutgoingUp                 Reopening
OutgoingFailed             Reopening
OutgoingLost               Reopening
IncomingUp                 Reopening
IncomingLost               Reopening
HandshakeHeard             Reopening     Refuse:StandBy
HandshakeHeard-diagnosis   Reopening     CloseLanes Adopt Connect
CommitHeard                StandBy       Rejected CloseLanes Failed:ProtocolViolation
CommitHeard-diagnosis      StandBy       Rejected CloseLanes Failed:ProtocolViolation
SetHeard                   StandBy       Rejected CloseLanes Failed:ProtocolViolation
LifeHeard                  Reopening
ViolationFound             StandBy       Rejected CloseLanes Failed:ProtocolViolation
Stalled                    Reopening
IncidentHeld-this-session  StandBy       Rejected CloseLanes Failed:StandBy
IncidentHeld-an-older      Reopening
IncidentGone               Reopening
Tick-nothing-due           Reopening
Tick-after-4s              StandBy       Heartbeat Rejected CloseLanes Failed:Timeout
Attach                     StandBy       Rejected CloseLanes Failed:ProtocolViolation
Handshake                  StandBy       Rejected CloseLanes Failed:ProtocolViolation
HandshakeCommit            StandBy       Rejected CloseLanes Failed:ProtocolViolation
MessageSetRequest          Reopening     OwnSet
MessageSet                 StandBy       Rejected CloseLanes Failed:ProtocolViolation
ChannelOpened              StandBy       Rejected CloseLanes Failed:ProtocolViolation
Rejected                   StandBy       CloseLanes Failed:Busy
Heartbeat                  Reopening
Disengagement              StandBy       Rejected CloseLanes Failed:ProtocolViolation
DisengagementCommit        StandBy       Rejected CloseLanes Failed:ProtocolViolation
ChannelClosed              StandBy       Rejected CloseLanes Failed:ProtocolViolation
DiagnosisHandshake         StandBy       Rejected CloseLanes Failed:ProtocolViolation
DiagnosisHandshakeCommit   StandBy       Rejected CloseLanes Failed:ProtocolViolation
ChannelReOpened            Open          ReOpened Heartbeat
StandBy                    StandBy       Rejected CloseLanes Failed:ProtocolViolation
StandByReport              StandBy       Rejected CloseLanes Failed:ProtocolViolation
IncidentDismissed          StandBy       Rejected CloseLanes Failed:ProtocolViolation
LinkReport                 StandBy       Rejected CloseLanes Failed:ProtocolViolation
Abandon                    StandBy       Rejected CloseLanes Failed:ProtocolViolation
MeasureRequest             StandBy       Rejected CloseLanes Failed:ProtocolViolation
MeasureAnswer              StandBy       Rejected CloseLanes Failed:ProtocolViolation
Probe                      StandBy       Rejected CloseLanes Failed:ProtocolViolation
ProbeEcho                  StandBy       Rejected CloseLanes Failed:ProtocolViolation
)"},
};
// clang-format on

} // namespace liena::test
