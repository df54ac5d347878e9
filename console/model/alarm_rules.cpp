// The alarm conditions, each by its rule.
#include "model/alarm_rules.hpp"

#include "model/report_title.hpp"

#include <QCoreApplication>

#include <algorithm>
#include <cmath>

namespace console {

namespace {

struct Text {
    Q_DECLARE_TR_FUNCTIONS(console::AlarmRules)
};

using Priority = AlarmPriority;

class Rules {
public:
    explicit Rules(const AlarmReadings& readings) : m_readings(readings) {}

    std::vector<AlarmReport> all()
    {
        for (const auto& link : m_readings.links)
            addLink(link);
        for (const auto& pair : m_readings.pairs)
            addPair(pair);
        addHold();
        addPicture();
        addForce();
        addDrives();
        addLimits();
        addInstruments();
        addPainting();
        addConsole();
        return std::move(m_reports);
    }

private:
    void add(AlarmCondition condition, Priority priority, bool latching, const QString& text, const QString& remedy, quint32 subject = 0,
             int step = 0)
    {
        m_reports.push_back({condition, subject, priority, latching, text, remedy, step, 0});
    }

    /// Of the last one.
    void addCauses(quint64 causes) { m_reports.back().causes = causes; }

    void addLink(const AlarmLinkReading& link);
    void addLoss(const AlarmLinkReading& link);
    void addPair(const AlarmPairReading& pair);
    void addHold();
    void addPicture();
    void addForce();
    void addDrives();
    void addLimits();
    void addRoundTrip(const AlarmLinkReading& link);
    void addUnsteady(const AlarmLinkReading& link);
    void addInstruments();
    void addKerma(double milligrays);
    void addFluoroscopy(double seconds);
    void addPainting();
    void addConsole();

    Priority whenArmed(Priority armed, Priority otherwise) const { return m_readings.armed ? armed : otherwise; }

    const AlarmReadings& m_readings;
    std::vector<AlarmReport> m_reports;
};

void Rules::addLink(const AlarmLinkReading& link)
{
    addLoss(link);
    if (link.systemDiffers)
        add(AlarmCondition::SystemDiffers, Priority::Medium, true,
            Text::tr("%1: its topology or message sets are others than ours").arg(link.title),
            Text::tr("Give both sides the same files; do not arm."), link.peer);
    addRoundTrip(link);
    if (!link.deadlineMissed.isEmpty() && carriesMessages(link.state))
        add(AlarmCondition::DeadlineMissed, whenArmed(Priority::Medium, Priority::Low), false,
            Text::tr("%1: %2 overdue").arg(link.title, reportTitle(link.deadlineMissed)),
            Text::tr("Look at that device; what is shown of it is old."), link.peer);
    addUnsteady(link);
    if (link.packetsLost)
        add(AlarmCondition::PacketsLost, Priority::Low, false, Text::tr("%1: one of two ways is lost, no UDP packets pass").arg(link.title),
            Text::tr("The session goes on by TCP, where a lost segment delays commands; have the network looked at."), link.peer);
    if (link.clockUncertain)
        add(AlarmCondition::ClockUncertain, whenArmed(Priority::Medium, Priority::Low), false,
            Text::tr("%1: clock uncertain, ages unknown").arg(link.title),
            Text::tr("Wait; arming is refused until the clocks are compared."), link.peer);
}

/// What is armed does not wait for the decision that a link will not heal: its motion has ended already. A link is lost until it is open
/// again, not until somebody tries. One that is closed in order is no incident, and a surprise to whose hand is on the dead-man all the
/// same.
void Rules::addLoss(const AlarmLinkReading& link)
{
    const auto condition = link.images ? AlarmCondition::ImageLost : AlarmCondition::LinkLost;
    if (link.state == LinkState::StandBy || link.state == LinkState::Reopening)
        add(condition, whenArmed(Priority::High, Priority::Medium), true,
            link.images ? Text::tr("%1: picture link lost, stand-by").arg(link.title) : Text::tr("%1: link lost, stand-by").arg(link.title),
            Text::tr("Read the prompt, then re-open the channel."), link.peer);
    else if (link.state == LinkState::Reconnecting && m_readings.armed)
        add(condition, Priority::High, true,
            link.images ? Text::tr("%1: picture link interrupted").arg(link.title) : Text::tr("%1: link interrupted").arg(link.title),
            Text::tr("Let go of the dead-man; motion has ended and needs a new ARM."), link.peer);
    else if (link.closedWhileArmed && m_readings.armed)
        add(condition, Priority::High, true,
            link.images ? Text::tr("%1: picture link closed while armed").arg(link.title)
                        : Text::tr("%1: link closed while armed").arg(link.title),
            Text::tr("Ask the patient side why; open it again before you arm."), link.peer);
}

/// The whole system stands by for it, and motion has ended.
void Rules::addPair(const AlarmPairReading& pair)
{
    add(AlarmCondition::LinkLost, whenArmed(Priority::High, Priority::Medium), true,
        Text::tr("Link between %1 and %2 lost, stand-by").arg(pair.titleOfA, pair.titleOfB),
        Text::tr("Read the prompt, then have the channel re-opened at one of the two."), pair.a);
    m_reports.back().other = pair.b;
}

/// The limits and not the figures, which change all the time: those are on the link's card.
void Rules::addUnsteady(const AlarmLinkReading& link)
{
    QStringList what;
    quint64 causes = 0;
    const auto addCause = [&](bool present, quint64 bit, const QString& text) {
        if (!present)
            return;
        what << text;
        causes |= bit;
    };
    addCause(link.suspectsInMinute >= 3, 1, Text::tr("%1 times in a minute").arg(link.suspectsInMinute));
    addCause(link.jittery, 2, Text::tr("jitter above %1 ms").arg(m_readings.line.jitterMs, 0, 'f', 0));
    addCause(link.lossy, 4, Text::tr("more than %1 % lost").arg(m_readings.line.lossPercent, 0, 'f', 0));
    if (what.isEmpty())
        return;
    add(AlarmCondition::LinkUnsteady, Priority::Low, false, Text::tr("%1: link unsteady, %2").arg(link.title, what.join(Text::tr(", "))),
        Text::tr("Check the line before you arm."), link.peer);
    addCauses(causes);
}

void Rules::addRoundTrip(const AlarmLinkReading& link)
{
    if (!link.commandRoundTrip || !carriesMessages(link.state))
        return;
    const auto text =
        Text::tr("%1: commands take %2 ms there and back").arg(link.title).arg(milliseconds(*link.commandRoundTrip), 0, 'f', 0);
    if (*link.commandRoundTrip > m_readings.pictureLimit)
        add(AlarmCondition::CommandRoundTrip, whenArmed(Priority::Medium, Priority::Low), false, text,
            Text::tr("Move slowly and wait for the picture, or stop; have the line looked at."), link.peer);
    else if (*link.commandRoundTrip > roundTripCaution && m_readings.armed)
        add(AlarmCondition::CommandRoundTrip, Priority::Low, false, text, Text::tr("Move slowly and wait for the picture."), link.peer);
}

void Rules::addHold()
{
    if (m_readings.awaitingHold && *m_readings.awaitingHold > holdConfirmationLimit)
        add(AlarmCondition::HoldNotConfirmed, whenArmed(Priority::High, Priority::Medium), true, Text::tr("Robot's hold NOT CONFIRMED"),
            Text::tr("Ask the patient side now whether the robot stands still."));
    if (m_readings.stopUnheard && *m_readings.stopUnheard > holdConfirmationLimit)
        add(AlarmCondition::StopUnheard, Priority::High, true, Text::tr("EMERGENCY STOP NOT HEARD by the robot"),
            Text::tr("Use the stop at the patient side now. This console goes on asking."));
    if (m_readings.emergencyStop)
        add(AlarmCondition::EmergencyStop, whenArmed(Priority::High, Priority::Medium), true, Text::tr("EMERGENCY STOP is in force"),
            Text::tr("Settle why it was pressed before it is reset."));
}

void Rules::addPicture()
{
    const auto condition = m_readings.picture.condition;
    const bool comes = condition != PictureCondition::None && condition != PictureCondition::Held;
    if (comes && m_readings.picture.reduction.losesInformation())
        add(AlarmCondition::PictureReduced, Priority::Low, false, Text::tr("Picture %1").arg(line(m_readings.picture.reduction)),
            Text::tr("Have the line to the X-ray system looked at; mind fine wires."));
    if (comes && m_readings.armed && m_readings.pictureSlow)
        add(AlarmCondition::PictureSlow, Priority::Low, false,
            Text::tr("Picture slow, fewer than %1 a second").arg(m_readings.picture.expectedPerSecond, 0, 'f', 0),
            Text::tr("Move slowly; have the line to the X-ray system looked at."));
    const auto priority = m_readings.engaged ? Priority::High : Priority::Low;
    // There is dose for nothing then, also where the last picture of a run before stands there, frozen.
    if (m_readings.picture.overdue && !m_readings.picture.refusal.isEmpty())
        return add(AlarmCondition::PictureStale, priority, false, Text::tr("Pictures are refused: %1").arg(m_readings.picture.refusal),
                   Text::tr("Let go of the pedal; have the X-ray system and this console looked at."));
    if (m_readings.picture.overdue)
        return add(AlarmCondition::PictureStale, priority, false, Text::tr("No picture is shown"),
                   Text::tr("Let go of the pedal and press it again; then have the X-ray system and the line to it looked at."));
    if (condition != PictureCondition::Frozen && condition != PictureCondition::Unknown) {
        if (m_readings.pictureTooOld && m_readings.armed)
            add(AlarmCondition::PictureStale, priority, false,
                Text::tr("Picture was older than %1 ms for a moment").arg(milliseconds(m_readings.pictureLimit), 0, 'f', 0),
                Text::tr("Let go of the dead-man; motion has ended and needs a new ARM."));
        return;
    }
    const auto letGo = Text::tr("Let go of the dead-man; motion is inhibited.");
    if (condition == PictureCondition::Frozen)
        return add(AlarmCondition::PictureStale, priority, false,
                   Text::tr("Picture FROZEN, older than %1 ms").arg(milliseconds(m_readings.pictureLimit), 0, 'f', 0), letGo);
    const bool comparing = m_readings.picture.unknownFor && *m_readings.picture.unknownFor < clockComparison;
    if (m_readings.armed || !comparing)
        add(AlarmCondition::PictureStale, priority, false, Text::tr("Picture's age is unknown"),
            m_readings.armed ? letGo : Text::tr("Wait; arming is refused until the clocks are compared."));
}

void Rules::addForce()
{
    if (!m_readings.robotFresh)
        return;
    const double force = std::abs(m_readings.force);
    const auto text = Text::tr("Guidewire force %1 N").arg(m_readings.force, 0, 'f', 2);
    if (force >= m_readings.limits.forceStop || m_readings.faultCode == forceStopped)
        add(AlarmCondition::ForceStop, whenArmed(Priority::High, Priority::Medium), true, Text::tr("FORCE STOP: %1").arg(text),
            Text::tr("Do not push on; look at the picture and retract a little."));
    else if (force >= m_readings.limits.forceWarn && m_readings.armed)
        add(AlarmCondition::ForceWarn, Priority::Medium, false, text, Text::tr("Advance no further; look at the tip."));
}

void Rules::addDrives()
{
    const quint16 code = m_readings.faultCode;
    const bool fault = code != noFault && code != forceStopped && code != commandsLost;
    const bool unhealthy = m_readings.drivesKnown && !m_readings.drivesHealthy;
    const auto remedy = Text::tr("Do not arm; have the drives looked at.");
    if (m_readings.armFault)
        add(AlarmCondition::DriveFault, whenArmed(Priority::High, Priority::Medium), true, Text::tr("Robotic arm: fault"), remedy,
            m_readings.arm);
    if (!m_readings.robotFresh || (!fault && !unhealthy && !m_readings.driveOff))
        return;
    add(AlarmCondition::DriveFault, whenArmed(Priority::High, Priority::Medium), true,
        fault                 ? Text::tr("Robot: %1").arg(faultText(code))
        : m_readings.driveOff ? Text::tr("Robot: a drive is off")
                              : Text::tr("Robot: drives are not healthy"),
        remedy);
    addCauses(fault ? quint64{1} << std::min<quint16>(code, 63) : 1);
}

void Rules::addLimits()
{
    if (!m_readings.robotFresh || !m_readings.armed)
        return;
    const auto addLimit = [this](AlarmCondition condition, Priority priority, unsigned switches, const QString& text) {
        add(condition, priority, false, text, Text::tr("Move the other way."));
        addCauses(switches);
    };
    if (const unsigned hard = m_readings.limitSwitches & hardLimits; hard != 0)
        addLimit(AlarmCondition::HardLimit, Priority::Medium, hard, Text::tr("Hard limit reached"));
    else if (const unsigned soft = m_readings.limitSwitches & softLimits; soft != 0)
        addLimit(AlarmCondition::SoftLimit, Priority::Low, soft, Text::tr("Soft limit reached"));
}

void Rules::addInstruments()
{
    if (m_readings.trackerOverdue)
        add(AlarmCondition::TrackerStale, whenArmed(Priority::Medium, Priority::Low), false, Text::tr("Tracker: no valid tip position"),
            Text::tr("Go by the picture alone; what is shown of the tip is old."));
    if (m_readings.armed && !m_readings.roadmapRemoved.isEmpty())
        add(AlarmCondition::RoadmapRemoved, Priority::Low, false, Text::tr("Roadmap removed: %1").arg(m_readings.roadmapRemoved),
            Text::tr("Go by the live picture; make a new roadmap with contrast."));
    if (m_readings.robotFresh && m_readings.contrastRanDry)
        add(AlarmCondition::ContrastEmpty, whenArmed(Priority::Medium, Priority::Low), true, Text::tr("Contrast EMPTY during an injection"),
            Text::tr("Have the patient side refill the injector and look for air."));
    else if (m_readings.robotFresh && m_readings.contrastLeft < plannedInjection)
        add(AlarmCondition::ContrastLow, Priority::Low, false,
            Text::tr("Contrast %1 mL, below one injection").arg(m_readings.contrastLeft, 0, 'f', 1),
            Text::tr("Have the patient side refill the injector."));
    if (m_readings.airKerma && *m_readings.airKerma >= kermaFirst)
        addKerma(*m_readings.airKerma);
    if (m_readings.fluoroscopyTime && *m_readings.fluoroscopyTime >= fluoroscopySignal)
        addFluoroscopy(*m_readings.fluoroscopyTime);
}

void Rules::addKerma(double milligrays)
{
    constexpr double largest = 1e6; // of what can be shown; a device may send anything
    const int grays = static_cast<int>(std::min(milligrays, largest) / 1000);
    add(AlarmCondition::AirKerma, milligrays >= kermaUrgent ? Priority::Medium : Priority::Low, true,
        Text::tr("Air kerma has reached %1 Gy").arg(grays), Text::tr("Weigh the dose against what is still to do."), 0, grays);
}

void Rules::addFluoroscopy(double seconds)
{
    constexpr double longest = 1e6; // of what can be shown; a device may send anything
    const int signal = static_cast<int>(std::min(seconds, longest) / fluoroscopySignal);
    add(AlarmCondition::FluoroscopyTime, Priority::Low, true,
        Text::tr("Fluoroscopy has reached %1 min").arg(signal * static_cast<int>(fluoroscopySignal) / 60),
        Text::tr("Weigh the dose against what is still to do."), 0, signal);
}

void Rules::addPainting()
{
    if (!m_readings.painting)
        return;
    const double enough = m_readings.painting->alarmed ? paintedPartAgain : paintedPart;
    if (m_readings.painting->paintedPerSecond >= enough * m_readings.painting->deliveredPerSecond)
        return;
    add(AlarmCondition::PaintingBehind, whenArmed(Priority::Medium, Priority::Low), false,
        Text::tr("Console paints %1 of %2 pictures a second")
            .arg(m_readings.painting->paintedPerSecond, 0, 'f', 0)
            .arg(m_readings.painting->deliveredPerSecond, 0, 'f', 0),
        Text::tr("Close other programs on this computer; mind fast motion."));
}

void Rules::addConsole()
{
    if (!m_readings.recorderTroubles.isEmpty()) {
        add(AlarmCondition::RecorderStopped, Priority::Low, true,
            Text::tr("Recording: %1").arg(m_readings.recorderTroubles.join(Text::tr("; "))),
            Text::tr("Make room on the disk, or have the computer looked at."));
        addCauses(m_readings.recorderCauses);
    }
    if (!m_readings.soundTrouble.isEmpty())
        add(AlarmCondition::SoundFailed, whenArmed(Priority::Medium, Priority::Low), false,
            Text::tr("No alarm sound: %1").arg(m_readings.soundTrouble), Text::tr("Keep this band in view; connect a loudspeaker."));
    if (!m_readings.watchdogTrouble.isEmpty())
        add(AlarmCondition::WatchdogGone, whenArmed(Priority::Medium, Priority::Low), false,
            Text::tr("No alarm if this program hangs: %1").arg(m_readings.watchdogTrouble),
            Text::tr("Watch the liveness mark; start the console anew before the next procedure."));
}

} // namespace

std::vector<AlarmReport> presentAlarms(const AlarmReadings& readings) { return Rules(readings).all(); }

} // namespace console
