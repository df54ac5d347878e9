// The alarm conditions, each by its rule.
#include "model/alarm_rules.hpp"

#include <QCoreApplication>

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
        addHold();
        addPicture();
        addForce();
        addDrives();
        addLimits();
        return std::move(m_reports);
    }

private:
    void add(AlarmCondition condition, Priority priority, bool latching, const QString& text, const QString& remedy, quint32 subject = 0)
    {
        m_reports.push_back({condition, subject, priority, latching, text, remedy});
    }

    void addLink(const AlarmLinkReading& link);
    void addHold();
    void addPicture();
    void addForce();
    void addDrives();
    void addLimits();

    Priority whenArmed(Priority armed, Priority otherwise) const { return m_readings.armed ? armed : otherwise; }

    const AlarmReadings& m_readings;
    std::vector<AlarmReport> m_reports;
};

void Rules::addLink(const AlarmLinkReading& link)
{
    if (link.state == LinkState::StandBy)
        add(AlarmCondition::LinkLost, whenArmed(Priority::High, Priority::Medium), true,
            Text::tr("%1: link lost, stand-by").arg(link.title), Text::tr("Read the prompt, then re-open the channel."), link.peer);
    if (!link.deadlineMissed.isEmpty() && carriesMessages(link.state))
        add(AlarmCondition::DeadlineMissed, whenArmed(Priority::Medium, Priority::Low), false,
            Text::tr("%1: %2 is overdue").arg(link.title, link.deadlineMissed),
            Text::tr("Look at that device; what is shown of it is old."), link.peer);
    if (link.suspectsInMinute >= 3)
        add(AlarmCondition::LinkUnsteady, Priority::Low, false,
            Text::tr("%1: link unsteady, %2 times in a minute").arg(link.title).arg(link.suspectsInMinute),
            Text::tr("Check the line before you arm."), link.peer);
    if (link.clockUncertain)
        add(AlarmCondition::ClockUncertain, whenArmed(Priority::Medium, Priority::Low), false,
            Text::tr("%1: clock uncertain, ages unknown").arg(link.title),
            Text::tr("Wait; arming is refused until the clocks are compared."), link.peer);
}

void Rules::addHold()
{
    if (m_readings.awaitingHold && *m_readings.awaitingHold > holdConfirmationLimit)
        add(AlarmCondition::HoldNotConfirmed, whenArmed(Priority::High, Priority::Medium), true, Text::tr("Robot's hold NOT CONFIRMED"),
            Text::tr("Ask the patient side now whether the robot stands still."));
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
    if (condition != PictureCondition::Frozen && condition != PictureCondition::Unknown)
        return;
    const auto text = condition == PictureCondition::Frozen
                          ? Text::tr("Picture FROZEN, older than %1 ms").arg(milliseconds(m_readings.pictureLimit), 0, 'f', 0)
                          : Text::tr("Picture's age is unknown");
    add(AlarmCondition::PictureStale, m_readings.engaged ? Priority::High : Priority::Low, false, text,
        Text::tr("Let go of the dead-man; motion is inhibited."));
}

void Rules::addForce()
{
    if (!m_readings.robotFresh)
        return;
    const double force = std::abs(m_readings.force);
    const auto text = Text::tr("Guidewire force %1 N").arg(m_readings.force, 0, 'f', 2);
    if (force >= m_readings.limits.forceStop || m_readings.faultCode == 1)
        add(AlarmCondition::ForceStop, whenArmed(Priority::High, Priority::Medium), true, Text::tr("FORCE STOP: %1").arg(text),
            Text::tr("Do not push on; look at the picture and retract a little."));
    else if (force >= m_readings.limits.forceWarn && m_readings.armed)
        add(AlarmCondition::ForceWarn, Priority::Medium, false, text, Text::tr("Advance no further; look at the tip."));
}

void Rules::addDrives()
{
    const bool fault = m_readings.faultCode == 2 || m_readings.faultCode == 3;
    const bool unhealthy = m_readings.drivesKnown && !m_readings.drivesHealthy && m_readings.armed;
    if (m_readings.robotFresh && (fault || unhealthy))
        add(AlarmCondition::DriveFault, whenArmed(Priority::High, Priority::Medium), true,
            fault ? Text::tr("Robot: %1").arg(faultText(m_readings.faultCode)) : Text::tr("Robot: drives are not healthy"),
            Text::tr("Do not arm; have the drives looked at."));
}

void Rules::addLimits()
{
    if (!m_readings.robotFresh || !m_readings.armed)
        return;
    if ((m_readings.limitSwitches & hardLimits) != 0)
        add(AlarmCondition::HardLimit, Priority::Medium, false, Text::tr("Hard limit reached"), Text::tr("Move the other way."));
    else if ((m_readings.limitSwitches & softLimits) != 0)
        add(AlarmCondition::SoftLimit, Priority::Low, false, Text::tr("Soft limit reached"), Text::tr("Move the other way."));
}

} // namespace

std::vector<AlarmReport> presentAlarms(const AlarmReadings& readings) { return Rules(readings).all(); }

} // namespace console
