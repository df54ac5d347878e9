// What the diagnosis prompt says to whoever has to find the cause: its details, and all of it as a text for a file.
#include "model/incident_model.hpp"
#include "model/session_model.hpp"

#include <QCoreApplication>
#include <QDateTime>

namespace console {

namespace {

struct Text {
    Q_DECLARE_TR_FUNCTIONS(console::Prompt)
};

constexpr qsizetype shownDigits = 12; ///< of the topology's hash

QString endOfPair(const DeviceNode& device)
{
    const auto line = Text::tr("%1: device %2 at %3").arg(device.title, device.idText(), device.address);
    return device.site.isEmpty() ? line : Text::tr("%1 (%2)").arg(line, device.site);
}

QString holdWords(const HoldLine& line)
{
    if (!line.holding)
        return Text::tr("NOT CONFIRMED");
    if (line.afterMs)
        return Text::tr("holds, %1 ms after the loss").arg(*line.afterMs, 0, 'f', 0);
    return line.already ? Text::tr("holds, already before the loss was noticed") : Text::tr("holds");
}

} // namespace

QStringList promptDetails(const IncidentRecord& incident, const SessionModel& sessions)
{
    QStringList lines;
    lines << Text::tr("Began %1, incident %2")
                 .arg(QDateTime::fromMSecsSinceEpoch(incident.sinceWallMs).toUTC().toString(Qt::ISODateWithMs))
                 .arg(incident.id, 16, 16, QLatin1Char('0'));
    for (const quint32 end : {incident.a, incident.b})
        if (const auto* device = sessions.device(end))
            lines << endOfPair(*device);
    if (incident.peer != 0 && incident.diagnosis)
        lines << Text::tr("%1 said last: %2").arg(sessions.titleOf(incident.peer), word(incident.diagnosis->peerState));
    lines << Text::tr("Topology %1, hash %2").arg(sessions.topologyName(), sessions.topologyHash().left(shownDigits));
    return lines;
}

QString promptReport(const PromptContent& content)
{
    QStringList lines{content.headline, content.since, content.flaps, content.directions, content.patient, content.call};
    for (const auto& hold : content.rollCall)
        lines << Text::tr("%1: %2").arg(hold.title, holdWords(hold));
    lines << content.picture << content.tip << content.evidence << content.likelyCause << content.tryFirst << content.lastTry
          << content.details;
    lines.removeAll(QString());
    return lines.join(QLatin1Char('\n')) + QLatin1Char('\n');
}

} // namespace console
