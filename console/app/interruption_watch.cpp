// From incidents and stand-by to the account.
#include "app/interruption_watch.hpp"

#include "model/present_readings.hpp"

#include <QDateTime>

#include <algorithm>
#include <utility>

namespace console {

InterruptionWatch::InterruptionWatch(ConsoleModels& models, std::function<quint64()> picturesReceived, QObject* parent)
    : QObject(parent), m_models(models), m_picturesReceived(std::move(picturesReceived))
{
    connect(&models.incidents, &IncidentModel::incidentRaised, this, &InterruptionWatch::begin);
    connect(&models.incidents, &IncidentModel::incidentEnded, this, &InterruptionWatch::look);
    connect(&models.sessions, &SessionModel::standByChanged, this, &InterruptionWatch::look);
    connect(&models.sessions, &SessionModel::linkStateChanged, this, [this](quint32 peer, LinkState, LinkState to) {
        if (to == LinkState::Reconnecting)
            beginShort(peer);
        else if (carriesMessages(to))
            m_interrupted.remove(peer);
        look();
    });
    connect(&models.xray, &XraySystemState::statusChanged, this, [this] { m_picturesAtReport = m_picturesReceived(); });
}

/// From the last moment at which the link was heard, where this console knows it.
void InterruptionWatch::begin(quint64 incident)
{
    const auto* record = m_models.incidents.incident(incident);
    if (record == nullptr || m_interrupted.remove(record->peer))
        return; // it was told of when it began
    const auto silence = record->diagnosis ? record->diagnosis->silence : Duration::zero();
    const auto& sessions = m_models.sessions;
    const auto what = record->peer != 0 ? tr("%1 link").arg(sessions.titleOf(record->peer))
                                        : tr("link %1 \u2013 %2").arg(sessions.titleOf(record->a), sessions.titleOf(record->b));
    const auto known = std::chrono::steady_clock::now() - record->since + silence;
    m_models.interruption.begin(what, record->since - silence,
                                QDateTime::currentMSecsSinceEpoch() - std::chrono::duration_cast<std::chrono::milliseconds>(known).count());
}

/// It may heal by itself, and is told of all the same.
void InterruptionWatch::beginShort(quint32 peer)
{
    const auto now = std::chrono::steady_clock::now();
    const auto* link = m_models.sessions.linkTo(peer);
    const auto heard = link != nullptr && link->figures.lastHeard ? std::min(*link->figures.lastHeard, now) : now;
    const auto silence = std::chrono::duration_cast<std::chrono::milliseconds>(now - heard).count();
    m_interrupted.insert(peer);
    m_models.interruption.begin(tr("%1 link").arg(m_models.sessions.titleOf(peer)), heard, QDateTime::currentMSecsSinceEpoch() - silence);
}

bool InterruptionWatch::standsBy() const { return m_models.sessions.inStandBy() || !m_models.incidents.empty(); }

bool InterruptionWatch::isDown() const
{
    const auto& links = m_models.sessions.links();
    return standsBy() || std::any_of(links.begin(), links.end(), [](const LinkNode& link) {
               return link.own &&
                      (link.state == LinkState::Reconnecting || link.state == LinkState::StandBy || link.state == LinkState::Reopening);
           });
}

void InterruptionWatch::beginNameless(Instant now)
{
    if (m_models.interruption.stage() != InterruptionAccount::Stage::Running)
        m_models.interruption.begin({}, now, QDateTime::currentMSecsSinceEpoch());
}

/// A link that is given up at once stands by before its incident is told, which knows what was lost and since when: it is not counted here.
void InterruptionWatch::look()
{
    const auto now = std::chrono::steady_clock::now();
    if (standsBy())
        beginNameless(now);
    else if (!isDown())
        m_models.interruption.end(now);
}

void InterruptionWatch::update(Instant now)
{
    if (isDown())
        beginNameless(now); // whatever was not told of
    m_models.interruption.note(systemSnapshot(m_models, m_picturesAtReport, now));
}

void InterruptionWatch::acknowledge(const QString& who, Instant now)
{
    QString text = accountHeadline(m_models.interruption);
    for (const auto& line : accountLines(m_models.interruption))
        text += QStringLiteral(". %1: %2").arg(line.name, line.text);
    if (m_models.interruption.acknowledge(now))
        m_models.log.append(LogKind::Operator,
                            tr("account of the interruption read by %1: %2").arg(who.isEmpty() ? tr("the operator") : who, text),
                            QDateTime::currentMSecsSinceEpoch());
}

} // namespace console
