// The guards of motion, checked and put into words.
#include "model/permit_guards.hpp"

#include "model/number_text.hpp"

#include <QCoreApplication>

#include <cmath>

namespace console {

namespace {

struct Text {
    Q_DECLARE_TR_FUNCTIONS(console::Guards)
};

GuardLine line(Guard guard, bool met, const QString& holds, const QString& missing) { return {guard, met, met ? holds : missing}; }

GuardLine identityLine(const GuardReadings& r)
{
    return line(Guard::IdentityEqual, r.identityEqual && !r.commandsDiffer, Text::tr("Same system on both sides"),
                r.commandsDiffer ? Text::tr("Robot's commands differ (F4)") : Text::tr("System not confirmed"));
}

GuardLine sessionLine(const GuardReadings& r)
{
    return line(Guard::SessionOpen, r.robotLink == LinkState::Open, Text::tr("Robot link is open"),
                Text::tr("Robot link is %1").arg(word(r.robotLink)));
}

GuardLine heartbeatLine(const GuardReadings& r, const GuardLimits& limits)
{
    return line(Guard::HeartbeatsOnTime, r.heartbeatsOnTime >= limits.heartbeatsOnTime, Text::tr("Heartbeats on time"),
                Text::tr("%1 of %2 heartbeats on time").arg(r.heartbeatsOnTime).arg(limits.heartbeatsOnTime));
}

GuardLine clockLine(const GuardReadings& r)
{
    const auto missing = r.clockUncertainty ? Text::tr("Clock uncertain by ±%1 ms").arg(numberText(milliseconds(*r.clockUncertainty), 1))
                                            : Text::tr("Clocks not yet compared");
    return line(Guard::ClockKnown, r.clockUncertainty && *r.clockUncertainty <= clockUncertaintyLimit(r.pictureLimit),
                Text::tr("Clocks compared"), missing);
}

QString pictureMissing(const GuardReadings& r, const GuardLimits& limits)
{
    const auto& picture = r.picture;
    if (picture.condition != PictureCondition::Live)
        return Text::tr("Picture: %1").arg(word(picture.condition));
    if (!picture.mayGuide)
        return Text::tr("Picture is a recording");
    if (!picture.age)
        return Text::tr("Picture's age is unknown");
    if (const auto oldest = *picture.age + picture.uncertainty; oldest > r.pictureLimit)
        return Text::tr("Picture may be %1 ms old, at most %2 ms")
            .arg(numberText(milliseconds(oldest), 0), numberText(milliseconds(r.pictureLimit), 0));
    if (!picture.atRate)
        return Text::tr("Picture slow: %1 of %2 a second")
            .arg(numberText(picture.shownPerSecond, 0), numberText(picture.expectedPerSecond, 0));
    return Text::tr("Picture live for %1 of %2 s").arg(numberText(seconds(picture.liveFor), 1), numberText(seconds(limits.pictureRun), 1));
}

bool pictureTrusted(const GuardReadings& r)
{
    return r.picture.condition == PictureCondition::Live && r.picture.mayGuide && r.picture.age &&
           *r.picture.age + r.picture.uncertainty <= r.pictureLimit;
}

GuardLine pictureLine(const GuardReadings& r, const GuardLimits& limits)
{
    return line(Guard::PictureLive, pictureTrusted(r) && r.picture.liveFor >= limits.pictureRun, Text::tr("Picture is live"),
                pictureMissing(r, limits));
}

/// A robot that stands still, has a permit to give and could be armed says so by its state Ready.
GuardLine holdLine(const GuardReadings& r)
{
    const bool newPermit = r.robotPermit != r.spentPermit;
    auto missing = Text::tr("Robot reports %1").arg(word(r.robotState));
    if (!r.robotFresh)
        missing = Text::tr("Robot's hold is not known");
    else if (r.anotherHasRobot)
        missing = Text::tr("Another console has the robot: %1").arg(word(r.robotState));
    else if (r.robotState == RobotState::Ready && !r.robotHoldConfirmed)
        missing = Text::tr("Robot has not confirmed its hold");
    else if (r.robotState == RobotState::Ready && !newPermit)
        missing = Text::tr("Robot has not issued a new permit");
    return line(Guard::RobotHolds, r.robotFresh && r.robotState == RobotState::Ready && r.robotHoldConfirmed && newPermit,
                Text::tr("Robot holds and is ready"), missing);
}

/// The arm carries the robot: where one is in session, its fault bars motion as one of the robot's drives does.
bool drivesHealthy(const GuardReadings& r) { return r.drivesHealthy && !r.armFault; }

GuardLine drivesLine(const GuardReadings& r)
{
    return line(Guard::DrivesHealthy, drivesHealthy(r), Text::tr("Drives are healthy"),
                r.armFault ? Text::tr("Robotic arm: fault") : Text::tr("Drives faulty or unknown"));
}

/// Where it is not measured the scene shows none while the robot can move, and fluoroscopy alone is steered by.
GuardLine tipLine(const GuardReadings& r)
{
    return line(Guard::TipTrackedOrOff, r.tipTracked || !r.tipShown,
                r.tipTracked ? Text::tr("Tip is tracked") : Text::tr("Tip not tracked, not shown"),
                Text::tr("Tip is shown where it was last"));
}

GuardLine forceLine(const GuardReadings& r)
{
    const bool nearZero = std::abs(r.force) <= r.limits.forceNearZero;
    return line(Guard::ForceNearZero, r.robotFresh && (nearZero || r.forceAccepted),
                nearZero ? Text::tr("Force near zero") : Text::tr("Force %1 N, accepted").arg(numberText(r.force, 2)),
                r.robotFresh ? Text::tr("Force %1 N").arg(numberText(r.force, 2)) : Text::tr("Force is not known"));
}

/// The robot refuses what is older than its message set says, and a command is as old as the way there and back.
bool carried(const GuardReadings& r) { return r.usualRoundTrip && r.carried && *r.usualRoundTrip <= *r.carried; }

/// `most` in `bound`, where the set carries more than that.
QString roundTripMissing(const GuardReadings& r, Duration most, const QString& bound)
{
    if (!r.roundTrip || !r.usualRoundTrip)
        return Text::tr("Round trip not yet measured");
    if (!r.carried)
        return Text::tr("It is not known how late the robot takes commands");
    if (!carried(r))
        return Text::tr("Commands take %1 ms there and back, the robot takes them up to %2 ms")
            .arg(numberText(milliseconds(*r.usualRoundTrip), 0), numberText(milliseconds(*r.carried), 0));
    return Text::tr("Commands take %1 ms there and back, %2")
        .arg(numberText(milliseconds(*r.roundTrip), 0), bound.arg(numberText(milliseconds(most), 0)));
}

GuardLine roundTripLine(const GuardReadings& r)
{
    return line(Guard::CommandsQuick, r.roundTrip && *r.roundTrip <= r.pictureLimit && carried(r), Text::tr("Commands are quick"),
                roundTripMissing(r, r.pictureLimit, Text::tr("at most %1 ms to arm")));
}

/// A hand whose keys travel through a remote desktop is none: what repeats, delays or drops them is not known here.
GuardLine handLine(const GuardReadings& r)
{
    auto missing = r.handMissing.isEmpty() ? Text::tr("No hand control answers") : r.handMissing;
    if (!r.remoteInput.isEmpty())
        missing = Text::tr("Remote input: %1").arg(r.remoteInput);
    return line(Guard::HandAlive, r.handAlive && r.remoteInput.isEmpty(), Text::tr("Hand control is there"), missing);
}

/// A window that nobody sees may well be the active one.
bool handMayUseKeys(const GuardReadings& r) { return r.windowActive && r.unseen.isEmpty(); }

GuardLine keysLine(const GuardReadings& r)
{
    auto missing = r.screenGone ? Text::tr("A screen is gone: click into the cockpit") : Text::tr("The keyboard is elsewhere");
    if (!r.unseen.isEmpty())
        missing = r.unseen;
    return line(Guard::WindowActive, handMayUseKeys(r), Text::tr("Window has the keyboard"), missing);
}

/// Who may arm, on either side.
GuardLine clearanceLine(const GuardReadings& r)
{
    if (r.role != OperatorRole::Operator)
        return {Guard::ClearToArm, false, Text::tr("This console only observes")};
    return line(Guard::ClearToArm, r.robotFresh && r.clearance != Clearance::Awaited,
                r.clearance == Clearance::Given ? Text::tr("Patient side: clear to arm") : Text::tr("One person may arm"),
                r.robotFresh ? Text::tr("Patient side has not said \"clear\"") : Text::tr("Patient side not heard"));
}

} // namespace

GuardSet keptWhileArmed()
{
    GuardSet set;
    for (const auto guard :
         {Guard::SessionOpen, Guard::IdentityEqual, Guard::PictureLive, Guard::RobotFresh, Guard::DrivesHealthy, Guard::QueueEmpty,
          Guard::ForceNearZero, Guard::CommandsQuick, Guard::NoIncident, Guard::NoHighAlarm, Guard::HandAlive, Guard::WindowActive})
        set.set(static_cast<std::size_t>(guard));
    return set;
}

GuardChecklist checkGuards(const GuardReadings& r, const GuardLimits& limits)
{
    return {
        sessionLine(r),
        identityLine(r),
        heartbeatLine(r, limits),
        clockLine(r),
        pictureLine(r, limits),
        line(Guard::RobotFresh, r.robotFresh, Text::tr("Robot reports"), Text::tr("No recent robot report")),
        holdLine(r),
        drivesLine(r),
        line(Guard::QueueEmpty, r.queuedMessages == 0, Text::tr("Nothing waits to be sent"),
             Text::tr("%1 messages wait to be sent").arg(r.queuedMessages)),
        tipLine(r),
        forceLine(r),
        roundTripLine(r),
        clearanceLine(r),
        line(Guard::Recorded, r.recorded && r.auditKept, Text::tr("Logs are kept"),
             r.recorded ? Text::tr("Audit file is not kept") : Text::tr("Alarm log is not kept")),
        line(Guard::NoIncident, !r.incident, Text::tr("No incident"), Text::tr("An incident is not resolved")),
        line(Guard::NoHighAlarm, !r.highAlarm, Text::tr("No high alarm"), Text::tr("A high alarm is not acknowledged")),
        handLine(r),
        keysLine(r),
        line(Guard::DeadManReleased, !r.deadMan, Text::tr("Dead-man released"), Text::tr("Let go of the dead-man")),
        line(Guard::AlarmsTested, r.alarmsTested, Text::tr("Alarms were tested"), Text::tr("Alarm self-test is due (F8)")),
        line(Guard::InterruptionRead, r.interruptionRead, Text::tr("No interruption is unread"),
             r.incident ? Text::tr("The interruption is not over") : Text::tr("Read \"While you were away\"")),
    };
}

GuardSet checkKept(const GuardReadings& r, const GuardLimits& limits)
{
    GuardSet met = ~keptWhileArmed();
    const auto keep = [&met](Guard guard, bool holds) { met.set(static_cast<std::size_t>(guard), holds); };
    keep(Guard::SessionOpen, r.robotLink == LinkState::Open || (r.robotLink == LinkState::Suspect && r.inLinkState <= r.heartbeat));
    keep(Guard::IdentityEqual, r.identityEqual && !r.commandsDiffer);
    keep(Guard::PictureLive, pictureTrusted(r) && r.picture.keepsRate);
    keep(Guard::RobotFresh, r.robotFresh);
    keep(Guard::DrivesHealthy, drivesHealthy(r));
    keep(Guard::QueueEmpty, r.queuedMessages <= limits.keptQueue);
    keep(Guard::ForceNearZero, std::abs(r.force) < r.limits.forceStop);
    keep(Guard::CommandsQuick, r.roundTrip && *r.roundTrip <= roundTripHold && carried(r));
    keep(Guard::NoIncident, !r.incident);
    keep(Guard::NoHighAlarm, !r.highAlarm);
    keep(Guard::HandAlive, r.handAlive && r.remoteInput.isEmpty());
    keep(Guard::WindowActive, handMayUseKeys(r));
    return met;
}

QStringList brokenGuards(const GuardReadings& readings, const GuardLimits& limits)
{
    const auto kept = checkKept(readings, limits);
    QStringList broken;
    for (const auto& entry : checkGuards(readings, limits))
        if (!kept.test(static_cast<std::size_t>(entry.guard)))
            broken << (entry.guard == Guard::CommandsQuick
                           ? roundTripMissing(readings, roundTripHold, Text::tr("at most %1 ms while armed"))
                           : entry.text);
    return broken;
}

GuardSet metGuards(const GuardChecklist& checklist)
{
    GuardSet set;
    for (const auto& entry : checklist)
        set.set(static_cast<std::size_t>(entry.guard), entry.met);
    return set;
}

} // namespace console
