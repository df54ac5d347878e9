// From session events to models.
#include "link/session_intake.hpp"

#include "link/library_words.hpp"
#include "link/translate.hpp"
#include "model/report_title.hpp"

#include <QDateTime>

#include <algorithm>

namespace console {

using Kind = liena::SessionEvent::Kind;

namespace {

/// On the wall's clock as it goes now: Unix time, milliseconds.
qint64 wallMsOf(Instant at)
{
    const auto ago = std::chrono::duration_cast<std::chrono::milliseconds>(std::chrono::steady_clock::now() - at);
    return QDateTime::currentMSecsSinceEpoch() - ago.count();
}

} // namespace

SessionIntake::SessionIntake(ConsoleModels& models, QObject* parent) : QObject(parent), m_models(models) {}

void SessionIntake::log(LogKind kind, const QString& line) { m_models.log.append(kind, line, QDateTime::currentMSecsSinceEpoch()); }

QString SessionIntake::peerName(const liena::SessionEvent& event) const
{
    return event.peer.isBroadcast() ? tr("an unknown device") : m_models.sessions.titleOf(event.peer.value());
}

/// One loss is often more than one incident, and each has lines of its own.
QString SessionIntake::ofIncident(const QString& line, const liena::Incident& incident) const
{
    return tr("%1 \u2013 %2: %3").arg(m_models.sessions.titleOf(incident.a.value()), m_models.sessions.titleOf(incident.b.value()), line);
}

QString SessionIntake::failureText(const liena::SessionEvent& event) const
{
    auto reason = words(event.reason);
    if (!event.detail.empty())
        reason = reason.isEmpty() ? text(event.detail) : tr("%1 (%2)").arg(reason, text(event.detail));
    return reason;
}

void SessionIntake::take(const liena::SessionEvent& event)
{
    const auto peer = event.peer.value();
    switch (event.kind) {
    case Kind::StateChanged:
        log(LogKind::Link, tr("%1: %2").arg(peerName(event), word(linkState(event.to))));
        m_models.sessions.setLinkState(peer, linkState(event.to), event.at);
        takeChange(event);
        break;
    case Kind::Opened:
    case Kind::ReOpened:
        m_models.sessions.noteOpened(peer, event.duration);
        log(LogKind::Link, tr("%1: opened in %2 ms").arg(peerName(event)).arg(milliseconds(event.duration), 0, 'f', 0));
        break;
    case Kind::OpenFailed:
        m_models.sessions.noteOpenFailed(peer, failureText(event),
                                         event.reason == liena::RejectReason::TopologyMismatch ||
                                             event.reason == liena::RejectReason::MessageSetChanged);
        if (const auto* link = m_models.sessions.linkTo(peer); link != nullptr && link->incident != 0)
            m_models.incidents.setReopenFailure(link->incident, failureText(event));
        log(LogKind::Trouble, tr("%1: not opened: %2").arg(peerName(event), failureText(event)));
        break;
    case Kind::Lost:
    case Kind::Diagnosed:
        takeLoss(event);
        break;
    case Kind::IncidentRaised:
    case Kind::CauseReported:
    case Kind::IncidentEnded:
    case Kind::HoldReported:
    case Kind::StandByBegan:
    case Kind::StandByEnded:
        takeIncident(event);
        break;
    default:
        takeRemark(event);
        break;
    }
}

/// An interruption has its sheet before it is known whether it heals: that takes as long as the topology's `reconnect`.
void SessionIntake::takeChange(const liena::SessionEvent& event)
{
    using State = liena::SessionState;
    const auto peer = event.peer.value();
    auto& incidents = m_models.incidents;
    const auto* self = m_models.sessions.self();
    if (event.to == State::Reconnecting && self != nullptr) {
        IncidentRecord interruption;
        interruption.a = std::min(self->id, peer);
        interruption.b = std::max(self->id, peer);
        interruption.peer = peer;
        interruption.since = event.at;
        interruption.sinceWallMs = wallMsOf(event.at);
        incidents.interrupt(std::move(interruption), event.at);
    } else if (event.to == State::Open || event.to == State::Suspect) {
        incidents.heal(peer, event.at);
    } else if (event.to == State::Closing || event.to == State::Closed) {
        incidents.forgetInterruption(peer);
    }
}

void SessionIntake::takeLoss(const liena::SessionEvent& event)
{
    const auto diagnosis = linkDiagnosis(event.diagnosis);
    if (event.kind == Kind::Lost) {
        m_localSince[event.incident.id] = event.diagnosis.since;
        auto lost = record(event.incident, event.at);
        lost.diagnosis = diagnosis;
        m_models.incidents.raise(lost, event.at);
        m_models.sessions.setLinkIncident(event.incident.a.value(), event.incident.b.value(), event.incident.id);
        log(LogKind::Trouble, tr("%1: lost, %2").arg(peerName(event), word(diagnosis.cause)));
        return;
    }
    m_models.incidents.setDiagnosis(event.incident.id, diagnosis);
    log(LogKind::Link, tr("%1: checked: %2").arg(peerName(event), words(event.diagnosis.probe)));
}

void SessionIntake::takeIncident(const liena::SessionEvent& event)
{
    const auto& incident = event.incident;
    switch (event.kind) {
    case Kind::IncidentRaised:
        m_models.incidents.raise(record(incident, event.at), event.at);
        m_models.sessions.setLinkIncident(incident.a.value(), incident.b.value(), incident.id);
        break;
    case Kind::CauseReported:
        m_models.incidents.raise(record(incident, event.at), event.at);
        log(LogKind::Link, ofIncident(tr("%1 saw: %2")
                                          .arg(m_models.sessions.titleOf(event.peer.value()),
                                               word(lossKind(event.peer == incident.a ? incident.causeOfA : incident.causeOfB))),
                                      incident));
        break;
    case Kind::IncidentEnded:
        m_models.incidents.end(incident.id);
        m_models.sessions.setLinkIncident(incident.a.value(), incident.b.value(), 0);
        m_localSince.erase(incident.id);
        log(LogKind::Link, ofIncident(event.dismissed ? tr("incident given up: %1").arg(tr(text(event.detail).toUtf8().constData()))
                                                      : tr("incident ended"),
                                      incident));
        break;
    case Kind::HoldReported:
        m_models.incidents.setHolds(incident.id, holdLines(incident));
        log(LogKind::Link, ofIncident((event.hold.holding ? tr("%1 confirms that it holds") : tr("%1 no longer holds"))
                                          .arg(m_models.sessions.titleOf(event.hold.device.value())),
                                      incident));
        break;
    case Kind::StandByBegan:
        m_models.sessions.setStandBy(true);
        log(LogKind::Trouble, tr("the system stands by"));
        break;
    default:
        m_models.sessions.setStandBy(false);
        log(LogKind::Link, tr("stand-by ended; motion needs a new ARM"));
        break;
    }
}

void SessionIntake::takeRemark(const liena::SessionEvent& event)
{
    const auto message = text(event.message);
    switch (event.kind) {
    case Kind::Closed:
        log(LogKind::Link, tr("%1: closed in order. %2").arg(peerName(event), failureText(event)).trimmed());
        break;
    case Kind::Interrupted:
        log(LogKind::Trouble,
            tr("%1: interrupted for %2 ms; motion needs a new ARM").arg(peerName(event)).arg(milliseconds(event.duration), 0, 'f', 0));
        Q_EMIT interrupted(event.peer.value(), milliseconds(event.duration));
        break;
    case Kind::DeadlineMissed:
        // Pictures end with the pedal.
        if (message != QLatin1String("XrayFrame") || picturesDue(m_models.xray, m_models.sessions.state(event.peer.value())) > 0)
            log(LogKind::Trouble, tr("%1: %2 is overdue").arg(peerName(event), reportTitle(message)));
        Q_EMIT deadlineMissed(event.peer.value(), message);
        break;
    case Kind::MessagesDropped:
        log(LogKind::Trouble,
            tr("%1: %2 message(s) %3 dropped: %4").arg(peerName(event)).arg(event.count).arg(message, text(event.detail)));
        break;
    case Kind::SendFailed:
        log(LogKind::Trouble, tr("%1: %2 was not sent: %3").arg(peerName(event), message, text(event.detail)));
        break;
    case Kind::IdentityRefused:
        log(LogKind::Trouble, tr("a connection of %1 was not let in: %2").arg(peerName(event), text(event.detail)));
        break;
    case Kind::LocalStall:
        log(LogKind::Trouble, tr("this console stood still for %1 ms").arg(milliseconds(event.duration), 0, 'f', 0));
        Q_EMIT stalled(milliseconds(event.duration));
        break;
    case Kind::AuditLost:
        log(LogKind::Trouble, tr("no audit file is written, so no new session opens: %1").arg(text(event.detail)));
        Q_EMIT auditLost(text(event.detail));
        break;
    case Kind::AuditRestored:
        log(LogKind::Link, tr("the audit file is written again"));
        Q_EMIT auditRestored();
        break;
    default:
        break;
    }
}

IncidentRecord SessionIntake::record(const liena::Incident& incident, Instant at) const
{
    IncidentRecord value;
    value.id = incident.id;
    value.a = incident.a.value();
    value.b = incident.b.value();
    const auto* self = m_models.sessions.self();
    if (self != nullptr && self->id == value.a)
        value.peer = value.b;
    else if (self != nullptr && self->id == value.b)
        value.peer = value.a;
    value.cause = lossKind(incident.cause);
    value.causeOfA = lossKind(incident.causeOfA);
    value.causeOfB = lossKind(incident.causeOfB);
    value.since = at;
    value.sinceWallMs = wallMsOf(at);
    value.holds = holdLines(incident);
    return value;
}

std::vector<HoldLine> SessionIntake::holdLines(const liena::Incident& incident) const
{
    std::vector<HoldLine> lines;
    for (const auto& hold : incident.holds) {
        HoldLine line;
        line.device = hold.device.value();
        line.title = m_models.sessions.titleOf(line.device);
        line.holding = hold.holding;
        if (hold.holding)
            timeHold(line, incident, hold);
        lines.push_back(std::move(line));
    }
    return lines;
}

/// Only where the device's clock was compared with ours, and the loss was seen here.
void SessionIntake::timeHold(HoldLine& line, const liena::Incident& incident, const liena::HoldReport& hold) const
{
    const auto since = m_localSince.find(incident.id);
    const auto clock = m_clocks.find(hold.device.value());
    if (since == m_localSince.end() || clock == m_clocks.end())
        return;
    const auto confirmed = Duration(static_cast<Duration::rep>(hold.confirmed.ns)) - clock->second.offset;
    const auto after = confirmed - Duration(static_cast<Duration::rep>(since->second.ns));
    line.already = after < -clock->second.uncertainty;
    if (!line.already)
        line.afterMs = std::max(0.0, milliseconds(after));
}

void SessionIntake::takeFigures(const std::vector<liena::LinkStatus>& links, Instant now)
{
    const auto between = m_figuresAt == Instant{} ? Duration::zero() : Duration(now - m_figuresAt);
    for (const auto& status : links) {
        const auto peer = status.peer.value();
        const auto before = m_figuresBefore.find(peer);
        if (before != m_figuresBefore.end())
            tellOtherWay(before->second, status);
        m_models.sessions.setLinkFigures(peer, linkFigures(status, before == m_figuresBefore.end() ? nullptr : &before->second, between),
                                         now);
        if (status.clockOffset)
            m_clocks[peer] = {*status.clockOffset, status.clockUncertainty};
        m_figuresBefore[peer] = status;
    }
    m_figuresAt = now;
}

/// A host with several addresses may be reached another way after an interruption: never in silence.
void SessionIntake::tellOtherWay(const liena::LinkStatus& before, const liena::LinkStatus& now)
{
    if (before.remoteAddress.empty() || (before.remoteAddress == now.remoteAddress && before.localAddress == now.localAddress))
        return;
    const auto way = [](const liena::LinkStatus& link) { return tr("%1 to %2").arg(text(link.localAddress), text(link.remoteAddress)); };
    log(LogKind::Trouble,
        tr("%1: another way now, from %2; before from %3").arg(m_models.sessions.titleOf(now.peer.value()), way(now), way(before)));
}

} // namespace console
