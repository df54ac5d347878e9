// One run of the console in numbers.
#include "model/measurements.hpp"

#include <QJsonArray>
#include <QJsonObject>

#include <algorithm>
#include <cmath>

namespace console {

namespace {

double perSecond(quint64 count, Duration time) { return time > Duration::zero() ? static_cast<double>(count) / seconds(time) : 0; }

QJsonValue orNull(const std::optional<double>& value) { return value ? QJsonValue(*value) : QJsonValue(); }

QJsonValue count(quint64 value) { return QJsonValue(static_cast<qint64>(value)); }

} // namespace

std::optional<double> percentile(std::vector<double> values, double part)
{
    if (values.empty())
        return std::nullopt;
    std::sort(values.begin(), values.end());
    const auto rank = static_cast<std::size_t>(std::ceil(std::clamp(part, 0.0, 1.0) * static_cast<double>(values.size())));
    return values[std::max<std::size_t>(rank, 1) - 1];
}

void Measurements::notePainted(std::optional<double> ageMs)
{
    ++framesPainted;
    if (ageMs && m_ages.size() < ageLimit)
        m_ages.push_back(*ageMs);
}

void Measurements::noteRobot(const RobotStatus& status)
{
    ++robotStatuses;
    if (!appliedAtStart)
        appliedAtStart = status.appliedCommands;
    if (!guidewireAtStart)
        guidewireAtStart = status.guidewirePosition;
    appliedAtEnd = status.appliedCommands;
    guidewireAtEnd = status.guidewirePosition;
    if (m_lastGuidewire)
        guidewireTravel += std::abs(status.guidewirePosition - *m_lastGuidewire);
    m_lastGuidewire = status.guidewirePosition;
}

double Measurements::framesPerSecond() const { return perSecond(framesPainted, measured()); }

double Measurements::statusesPerSecond() const { return perSecond(robotStatuses, measured()); }

std::vector<QString> Measurements::failures() const
{
    std::vector<QString> all;
    const auto need = [&all](bool holds, const QString& text) {
        if (!holds)
            all.push_back(text);
    };
    for (const auto& [peer, session] : sessions)
        need(session.open, QStringLiteral("the session with %1 did not open%2")
                               .arg(session.device, session.failure.isEmpty() ? QString() : QStringLiteral(": ") + session.failure));
    need(stepFailure.isEmpty(), stepFailure);
    need(!sessions.empty(), QStringLiteral("this device has no links"));
    need(framesPainted > 0, QStringLiteral("no picture was painted"));
    need(armed, QStringLiteral("the robot was not armed"));
    need(engaged, QStringLiteral("motion was not engaged"));
    need(applied() > 0, QStringLiteral("the robot applied no motion command"));
    need(guidewireTravel > 0.1, QStringLiteral("the guidewire did not move"));
    need(incidents == 0, QStringLiteral("%1 incident(s) happened").arg(incidents));
    need(holdCause.isEmpty(), QStringLiteral("motion ended before its time: %1").arg(holdCause));
    return all;
}

QJsonObject Measurements::toJson() const
{
    QJsonArray list;
    for (const auto& [peer, session] : sessions)
        list.append(QJsonObject{{QStringLiteral("device"), session.device},
                                {QStringLiteral("state"), session.state},
                                {QStringLiteral("opening_ms"), orNull(session.openingMs)},
                                {QStringLiteral("failure"), session.failure}});
    QJsonArray failed;
    for (const auto& text : failures())
        failed.append(text);
    return {
        {QStringLiteral("ok"), failed.isEmpty()},
        {QStringLiteral("failures"), failed},
        {QStringLiteral("sessions"), list},
        {QStringLiteral("measured_seconds"), seconds(measured())},
        {QStringLiteral("frames_received"), count(framesReceived)},
        {QStringLiteral("frames_painted"), count(framesPainted)},
        {QStringLiteral("frames_per_second"), framesPerSecond()},
        {QStringLiteral("picture_age_ms_p50"), orNull(pictureAge(0.50))},
        {QStringLiteral("picture_age_ms_p99"), orNull(pictureAge(0.99))},
        {QStringLiteral("robot_statuses_per_second"), statusesPerSecond()},
        {QStringLiteral("motion_commands_sent"), count(commandsSent)},
        {QStringLiteral("motion_commands_applied"), count(applied())},
        {QStringLiteral("guidewire_start_mm"), orNull(guidewireAtStart)},
        {QStringLiteral("guidewire_end_mm"), orNull(guidewireAtEnd)},
        {QStringLiteral("guidewire_travel_mm"), guidewireTravel},
        {QStringLiteral("arming_ms"), orNull(armingMs)},
        {QStringLiteral("armed"), armed},
        {QStringLiteral("engaged"), engaged},
        {QStringLiteral("hold_cause"), holdCause},
        {QStringLiteral("incidents"), count(incidents)},
        {QStringLiteral("alarms"), count(alarms)},
    };
}

} // namespace console
