// A link between the cockpit and the robot that is lost and re-opened again and again: the events as the library tells them.
#pragma once

#include "invented_cockpit.hpp"
#include "link/session_intake.hpp"

namespace console::test {

class FlappingLink {
public:
    explicit FlappingLink(SessionIntake& intake, quint32 peer = robotId) : m_intake(intake), m_peer(peer) {}

    void lose(Instant at)
    {
        interrupt(at);
        decide(at);
    }

    /// It may heal by itself.
    void interrupt(Instant at) { enter(liena::SessionState::Reconnecting, at); }
    void heal(Instant at) { enter(liena::SessionState::Open, at); }
    void close(Instant at) { enter(liena::SessionState::Closed, at); }

    void decide(Instant at)
    {
        m_incident.id = (quint64(m_peer) << 32U) + ++m_number;
        m_incident.a = liena::DeviceId(std::min(m_peer, cockpitId));
        m_incident.b = liena::DeviceId(std::max(m_peer, cockpitId));
        m_incident.cause = liena::LossCause::HeartbeatLost;
        enter(liena::SessionState::StandBy, at);
        auto lost = event(Kind::Lost, at);
        lost.diagnosis.cause = liena::LossCause::HeartbeatLost;
        lost.diagnosis.silence = std::chrono::milliseconds(110);
        m_intake.take(lost);
        m_intake.take(event(Kind::IncidentRaised, at));
        m_intake.take(event(Kind::StandByBegan, at));
    }

    void reopen(Instant at)
    {
        enter(liena::SessionState::Reopening, at);
        enter(liena::SessionState::Open, at);
        m_intake.take(event(Kind::ReOpened, at));
        m_intake.take(event(Kind::IncidentEnded, at));
        m_intake.take(event(Kind::StandByEnded, at));
    }

private:
    using Kind = liena::SessionEvent::Kind;

    liena::SessionEvent event(Kind kind, Instant at) const
    {
        liena::SessionEvent e;
        e.kind = kind;
        e.peer = liena::DeviceId(m_peer);
        e.at = at;
        e.incident = m_incident;
        return e;
    }

    void enter(liena::SessionState to, Instant at)
    {
        auto e = event(Kind::StateChanged, at);
        e.from = m_state;
        e.to = m_state = to;
        m_intake.take(e);
    }

    SessionIntake& m_intake;
    quint32 m_peer;
    liena::Incident m_incident;
    liena::IncidentId m_number = 0;
    liena::SessionState m_state = liena::SessionState::Open;
};

} // namespace console::test
