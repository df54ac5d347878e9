// The words of the diagnosis prompt.
#include "model/incident_model.hpp"

#include "model/session_model.hpp"

#include <QCoreApplication>
#include <QDateTime>

#include <algorithm>

namespace console {

namespace {

struct Text {
    Q_DECLARE_TR_FUNCTIONS(console::Prompt)
};

QString clockTime(qint64 wallMs, bool tenths)
{
    const auto text = QDateTime::fromMSecsSinceEpoch(wallMs).toString(tenths ? QStringLiteral("HH:mm:ss.zzz") : QStringLiteral("HH:mm:ss"));
    return tenths ? text.chopped(2) : text;
}

QString runningTime(Duration duration)
{
    const auto whole = std::chrono::duration_cast<std::chrono::seconds>(duration).count();
    return QStringLiteral("%1:%2").arg(whole / 60).arg(whole % 60, 2, 10, QLatin1Char('0'));
}

QString ordinal(int count)
{
    const bool teen = count % 100 >= 11 && count % 100 <= 13;
    if (!teen && count % 10 == 1)
        return Text::tr("%1st").arg(count);
    if (!teen && count % 10 == 2)
        return Text::tr("%1nd").arg(count);
    if (!teen && count % 10 == 3)
        return Text::tr("%1rd").arg(count);
    return Text::tr("%1th").arg(count);
}

QString headline(const IncidentRecord& incident, const SessionModel& sessions)
{
    if (incident.stage == LossStage::Interrupted)
        return Text::tr("%1 link interrupted").arg(sessions.titleOf(incident.peer));
    if (incident.stage == LossStage::Healed)
        return Text::tr("%1 link was interrupted").arg(sessions.titleOf(incident.peer));
    if (incident.peer != 0)
        return Text::tr("%1 link lost").arg(sessions.titleOf(incident.peer));
    return Text::tr("Link between %1 and %2 lost").arg(sessions.titleOf(incident.a), sessions.titleOf(incident.b));
}

/// What cannot be known is said to be unknown: that a connection stands does not prove that the peer hears us.
QString directions(const IncidentRecord& incident, const SessionModel& sessions)
{
    if (incident.peer == 0)
        return Text::tr("this console is not part of that link; the devices reported it");
    const auto name = sessions.titleOf(incident.peer);
    if (incident.stage == LossStage::Healed)
        return Text::tr("to %1: open · from %1: open").arg(name);
    if (!incident.diagnosis)
        return Text::tr("to %1: unknown · from %1: unknown").arg(name);
    const auto to = incident.diagnosis->toPeerConnected ? Text::tr("unknown") : Text::tr("broken");
    const auto from = incident.diagnosis->fromPeerConnected ? Text::tr("silent") : Text::tr("broken");
    return Text::tr("to %1: %2 · from %1: %3").arg(name, to, from);
}

/// The devices of the system in the topology's order; one that said nothing has not confirmed.
std::vector<HoldLine> rollCall(const IncidentRecord& incident, const SessionModel& sessions)
{
    std::vector<HoldLine> lines;
    for (const auto& node : sessions.devices()) {
        const auto said =
            std::find_if(incident.holds.begin(), incident.holds.end(), [&node](const HoldLine& line) { return line.device == node.id; });
        HoldLine line = said == incident.holds.end() ? HoldLine{} : *said;
        line.device = node.id;
        line.title = sessions.titleOf(node.id);
        lines.push_back(std::move(line));
    }
    return lines;
}

void addPatient(PromptContent& content, const SessionModel& sessions, quint32 robot)
{
    if (robot == 0) {
        content.patient = Text::tr("No robot in this system");
        return;
    }
    const auto name = sessions.titleOf(robot);
    const auto line =
        std::find_if(content.rollCall.begin(), content.rollCall.end(), [robot](const HoldLine& hold) { return hold.device == robot; });
    content.holdConfirmed = line != content.rollCall.end() && line->holding;
    if (!content.holdConfirmed)
        content.patient = Text::tr("NOT CONFIRMED that %1 holds. Its own guard should hold it. Ask the patient side now.").arg(name);
    else if (line->afterMs)
        content.patient = Text::tr("%1 holds: CONFIRMED %2 ms after the stop").arg(name).arg(*line->afterMs, 0, 'f', 0);
    else if (line->already)
        content.patient = Text::tr("%1 holds: CONFIRMED, already before the loss was noticed").arg(name);
    else
        content.patient = Text::tr("%1 holds: CONFIRMED").arg(name);
}

QString pictureWords(const PromptSurroundings& around)
{
    const auto& taken = around.frozenSinceWallMs;
    switch (around.picture) {
    case PictureCondition::None:
        break;
    case PictureCondition::Live:
        return Text::tr("Picture: live");
    case PictureCondition::Unknown: // it moves: there is no time since when it would stand
        return Text::tr("Picture: new ones come, age unknown");
    case PictureCondition::Frozen:
        if (taken)
            return Text::tr("Picture: frozen since %1").arg(clockTime(*taken, true));
        break;
    case PictureCondition::Held:
        if (taken)
            return Text::tr("Picture: last image hold, of %1").arg(clockTime(*taken, true));
        break;
    }
    return Text::tr("Picture: none");
}

/// A recording is never said to be live.
QString recordingWords(const PromptSurroundings& around)
{
    if (around.picture != PictureCondition::Live)
        return Text::tr("%1 (a recording)").arg(pictureWords(around));
    return around.rehearsal ? Text::tr("Picture: a recording, for a rehearsal") : Text::tr("Picture: a recording, nothing to move by");
}

void addSeen(PromptContent& content, const PromptSurroundings& around)
{
    content.picture = around.pictureRecorded ? recordingWords(around) : pictureWords(around);
    if (around.tipLive)
        content.tip = Text::tr("Tip position: live");
    else
        content.tip = around.tipKnown ? Text::tr("Tip position: last known") : Text::tr("Tip position: unknown");
}

QString since(const IncidentRecord& incident, Instant now)
{
    const auto begin = clockTime(incident.sinceWallMs, false);
    if (incident.stage == LossStage::Healed)
        return Text::tr("for %1 ms, at %2").arg(milliseconds(incident.healed - incident.since), 0, 'f', 0).arg(begin);
    return Text::tr("for %1, since %2").arg(runningTime(now - incident.since), begin);
}

/// Nothing is decided yet, or no longer: there is nothing for a person to mend.
void addInterruption(PromptContent& content, const IncidentRecord& incident, const SessionModel& sessions, quint32 robot,
                     std::optional<Instant> robotHeldAt)
{
    content.decided = false;
    content.tryFirst.clear();
    content.rollCall.clear(); // nobody was asked
    content.healed = incident.stage == LossStage::Healed;
    content.call.clear();
    if (content.healed) {
        content.patient =
            incident.peer == robot ? Text::tr("Motion needs a new ARM.") : Text::tr("What motion waits for stands in the motion bar.");
        content.likelyCause = Text::tr("It healed by itself. If it comes again, run a line check.");
        return;
    }
    content.holdConfirmed = robotHeldAt && *robotHeldAt > incident.since;
    if (content.holdConfirmed)
        content.patient = Text::tr("%1 holds: CONFIRMED by its own report").arg(sessions.titleOf(robot));
    else if (robot != 0)
        content.patient = Text::tr("Not confirmed yet that %1 holds. Its own guard should stop it.").arg(sessions.titleOf(robot));
    content.likelyCause =
        Text::tr("Not known yet. LiENa connects again by itself; if it cannot, the system stands by and this prompt says more.");
}

/// Of an address `host:port`.
QString hostOf(const DeviceNode* device) { return device == nullptr ? QString() : device->address.section(QLatin1Char(':'), 0, -2); }

/// Whether the way, the place or the computer is to blame is seen by who else there is heard.
QString otherLinks(const IncidentRecord& incident, const SessionModel& sessions)
{
    const auto lostHost = incident.peer != 0 ? hostOf(sessions.device(incident.peer)) : QString();
    const auto* lost = sessions.linkTo(incident.peer);
    const auto lostInterface = lost != nullptr ? lost->figures.localAddress : QString();
    QStringList others;
    for (const auto& link : sessions.links()) {
        const auto* device = link.own && link.peer != incident.peer ? sessions.device(link.peer) : nullptr;
        if (device == nullptr)
            continue;
        const auto host = hostOf(device);
        auto place = !host.isEmpty() && host == lostHost ? Text::tr("same computer") : device->site.isEmpty() ? host : device->site;
        if (const auto& own = link.figures.localAddress; host != lostHost && !own.isEmpty() && !lostInterface.isEmpty())
            place = own == lostInterface ? Text::tr("%1, same interface").arg(place) : Text::tr("%1, by %2").arg(place, own);
        const auto state = carriesMessages(link.state) ? Text::tr("open") : Text::tr("not open");
        others << Text::tr("%1 (%2) %3").arg(sessions.titleOf(link.peer), place, state);
    }
    return others.isEmpty() ? QString() : Text::tr("Other links of this console: %1").arg(others.join(Text::tr(", ")));
}

QStringList evidence(const IncidentRecord& incident, const SessionModel& sessions)
{
    QStringList lines;
    if (incident.causeOfA != LossKind::None)
        lines << Text::tr("%1 saw: %2").arg(sessions.titleOf(incident.a), word(incident.causeOfA));
    if (incident.causeOfB != LossKind::None)
        lines << Text::tr("%1 saw: %2").arg(sessions.titleOf(incident.b), word(incident.causeOfB));
    if (const auto& found = incident.diagnosis) {
        lines
            << Text::tr("Heartbeats in the second before the loss: %1 of %2").arg(found->heartbeatsReceived).arg(found->heartbeatsExpected);
        lines << (found->lastRoundTrip ? Text::tr("Last round trip: %1 ms").arg(milliseconds(*found->lastRoundTrip), 0, 'f', 1)
                                       : Text::tr("Last round trip: unknown"));
        lines << Text::tr("Silent for %1 ms before it was given up").arg(milliseconds(found->silence), 0, 'f', 0);
        lines << Text::tr("Our connection to it %1, its connection to us %2")
                     .arg(found->toPeerConnected ? Text::tr("held") : Text::tr("broke"),
                          found->fromPeerConnected ? Text::tr("held") : Text::tr("broke"));
        if (!found->detail.isEmpty())
            lines << found->detail;
        if (!found->probeDetail.isEmpty())
            lines << Text::tr("Check: %1").arg(found->probeDetail);
    }
    if (const auto others = otherLinks(incident, sessions); !others.isEmpty())
        lines << others;
    if (incident.reopenTries > 0)
        lines << Text::tr("Re-open tried %1 times").arg(incident.reopenTries);
    return lines;
}

/// Whether other devices where `peer` stands are in session; nothing when no other stands there.
std::optional<bool> othersThereAnswer(const SessionModel& sessions, quint32 peer)
{
    const auto* node = sessions.device(peer);
    if (node == nullptr || node->site.isEmpty())
        return std::nullopt;
    std::optional<bool> answer;
    for (const auto& link : sessions.links()) {
        const auto* other = link.own && link.peer != peer ? sessions.device(link.peer) : nullptr;
        if (other != nullptr && other->site == node->site)
            answer = answer.value_or(false) || carriesMessages(link.state);
    }
    return answer;
}

/// A link that is interrupted, being re-opened or closed is not there either, though it does not stand by.
bool everyOtherCarries(const SessionModel& sessions, quint32 peer)
{
    return std::ranges::all_of(sessions.links(),
                               [peer](const LinkNode& link) { return !link.own || link.peer == peer || carriesMessages(link.state); });
}

/// Of a link between two other devices. Where this console lost one of them as well, it is not only their line.
QString causeBetweenOthers(const IncidentRecord& incident, const SessionModel& sessions)
{
    QStringList lost;
    bool allCarry = true;
    for (const quint32 end : {incident.a, incident.b}) {
        const auto* own = sessions.linkTo(end);
        if (own == nullptr)
            continue;
        allCarry = allCarry && carriesMessages(own->state);
        if (own->inIncident || own->state == LinkState::StandBy || own->state == LinkState::Reopening)
            lost << sessions.titleOf(end);
    }
    if (lost.size() == 1)
        return Text::tr("Not only between those two: this console's link to %1 is lost, too; its own prompt says more").arg(lost.front());
    if (!lost.isEmpty())
        return Text::tr("Not only between those two: this console's links to both are lost, too; their own prompts say more");
    return allCarry ? Text::tr("Between those two devices; this console's links are not concerned") : Text::tr("Between those two devices");
}

} // namespace

QString word(LossKind kind)
{
    switch (kind) {
    case LossKind::None:
        return {};
    case LossKind::HeartbeatLost:
        return Text::tr("heartbeats stopped");
    case LossKind::ConnectionLost:
        return Text::tr("the connection broke");
    case LossKind::PeerRestarted:
        return Text::tr("the device restarted");
    case LossKind::ProtocolViolation:
        return Text::tr("the device broke the protocol");
    case LossKind::LocalStall:
        return Text::tr("this console stood still");
    }
    return {};
}

PromptContent promptContent(const IncidentRecord& incident, const SessionModel& sessions, const PromptSurroundings& around, Instant now)
{
    PromptContent content;
    content.headline = headline(incident, sessions);
    content.directions = directions(incident, sessions);
    content.since = since(incident, now);
    if (incident.flaps > 1)
        content.flaps = Text::tr("%1 time in 2 min").arg(ordinal(incident.flaps));
    content.rollCall = rollCall(incident, sessions);
    addPatient(content, sessions, around.robot);
    content.call = around.patientSide.isEmpty() ? Text::tr("How to call the patient side is not set up: preferences (Ctrl+,)")
                                                : Text::tr("Call the patient side: %1").arg(around.patientSide);
    addSeen(content, around);
    content.evidence = evidence(incident, sessions);
    content.details = promptDetails(incident, sessions);
    if (incident.peer != 0) {
        const bool onlyPictures = kindOf(incident.peer) == DeviceKind::Eye && everyOtherCarries(sessions, incident.peer);
        const auto advice =
            adviceFor(incident.diagnosis.value_or(LinkDiagnosis{}), around, onlyPictures, othersThereAnswer(sessions, incident.peer));
        content.likelyCause = advice.cause;
        content.tryFirst = advice.tryFirst;
    } else {
        content.likelyCause = causeBetweenOthers(incident, sessions);
        content.tryFirst = Text::tr("Re-open it at one of them");
    }
    content.lastTry = incident.reopenFailure;
    content.folded = Text::tr("%1, %2").arg(content.headline, runningTime(now - incident.since));
    content.silence = Text::tr("Silence %1 s").arg(around.audioPause.count());
    content.canReopen = incident.peer != 0;
    content.reopening = incident.peer != 0 && sessions.state(incident.peer) == LinkState::Reopening;
    content.lostLinks = around.lostLinks;
    if (incident.stage != LossStage::Lost)
        addInterruption(content, incident, sessions, around.robot, around.robotHeldAt);
    return content;
}

} // namespace console
