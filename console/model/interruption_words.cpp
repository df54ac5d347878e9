// The account of an interruption in words: numbers where they are known, "unknown" and why where they are not.
#include "model/interruption.hpp"

#include "model/number_text.hpp"

#include <QCoreApplication>
#include <QDateTime>

#include <algorithm>
#include <cmath>

namespace console {

namespace {

struct Text {
    Q_DECLARE_TR_FUNCTIONS(console::Interruption)
};

QString span(Duration duration)
{
    constexpr double minute = 60;
    const double all = seconds(duration);
    if (all < minute)
        return Text::tr("%1 s").arg(numberText(all, 1));
    const auto whole = static_cast<qint64>(all);
    return Text::tr("%1 min %2 s").arg(whole / 60).arg(whole % 60);
}

/// Why a comparison cannot be made; empty when it can.
QString missing(bool before, bool now, const QString& what)
{
    if (before && now)
        return {};
    if (!before && !now)
        return Text::tr("unknown: %1 neither before the loss nor now").arg(what);
    return before ? Text::tr("unknown: %1 now").arg(what) : Text::tr("unknown: %1 before the loss").arg(what);
}

class Account {
public:
    explicit Account(const InterruptionAccount& account) : m_account(account), m_before(account.before()), m_now(account.present()) {}

    std::vector<AccountLine> all() const { return {lost(), tip(), force(), contrast(), xrayTime(), pictures(), stand(), patientSide()}; }

private:
    AccountLine lost() const
    {
        return {Text::tr("Lost"), m_account.lost().isEmpty() ? Text::tr("unknown which link") : m_account.lost().join(Text::tr(", ")),
                m_account.lost().isEmpty()};
    }

    AccountLine tip() const
    {
        const auto name = Text::tr("Tip");
        if (const auto why = missing(m_before.tip.has_value(), m_now.tip.has_value(), Text::tr("no valid tracker position"));
            !why.isEmpty())
            return {name, why, true};
        const auto& from = m_before.tip->position;
        const auto& to = m_now.tip->position;
        const double way = std::hypot(to[0] - from[0], to[1] - from[1], to[2] - from[2]);
        const double error = std::hypot(m_before.tip->error, m_now.tip->error);
        return {name, Text::tr("moved %1\u00A0mm (tracker \u00B1%2\u00A0mm)").arg(numberText(way, 1), numberText(error, 1)), way > error};
    }

    AccountLine force() const
    {
        const auto name = Text::tr("Force");
        if (const auto why = noRobot(); !why.isEmpty())
            return {name, why, true};
        constexpr int decimals = 2;
        const double from = asShown(m_before.robot->guidewireForce, decimals);
        const double to = asShown(m_now.robot->guidewireForce, decimals);
        constexpr double shown = 0.005;      // N
        constexpr double noticeable = 0.045; // 0.05, and what a difference of doubles lacks of it
        if (std::abs(to - from) < shown)
            return {name, Text::tr("%1\u00A0N, as before").arg(numberText(to, decimals)), false};
        return {name,
                Text::tr("%1\u00A0N before, %2\u00A0N now (%3%4\u00A0N)")
                    .arg(numberText(from, decimals), numberText(to, decimals), to < from ? QStringLiteral("\u2212") : QStringLiteral("+"),
                         numberText(std::abs(to - from), decimals)),
                std::abs(to - from) >= noticeable};
    }

    AccountLine contrast() const
    {
        const auto name = Text::tr("Contrast");
        if (const auto why = noRobot(); !why.isEmpty())
            return {name, why, true};
        const double from = m_before.robot->contrastRemaining;
        const double to = m_now.robot->contrastRemaining;
        constexpr double least = 0.05; // mL, of what is shown
        if (to > from + least)
            return {name,
                    Text::tr("unknown: %1\u00A0mL before, %2\u00A0mL now; filled up or started anew")
                        .arg(numberText(from, 1), numberText(to, 1)),
                    true};
        return {name, Text::tr("%1\u00A0mL used, %2\u00A0mL left").arg(numberText(std::max(0.0, from - to), 1), numberText(to, 1)),
                from - to >= least};
    }

    AccountLine xrayTime() const
    {
        const auto name = Text::tr("X-ray time");
        if (const auto why = noXray(); !why.isEmpty())
            return {name, why, true};
        const double time = m_now.xray->fluoroscopyTime - m_before.xray->fluoroscopyTime;
        constexpr double least = 0.05; // s, of what is shown
        return {name, Text::tr("%1 s of beam").arg(numberText(std::max(0.0, time), 1)), time >= least};
    }

    AccountLine pictures() const
    {
        const auto name = Text::tr("Pictures");
        if (const auto why = noXray(); !why.isEmpty())
            return {name, why, true};
        const auto taken = m_now.xray->framesAcquired - m_before.xray->framesAcquired;
        const auto came = m_now.picturesReceived - std::min(m_before.picturesReceived, m_now.picturesReceived);
        const auto lost = taken - std::min(came, taken);
        if (taken == 0)
            return {name, Text::tr("none was taken meanwhile"), false};
        if (lost == 0)
            return {name, Text::tr("%1 taken, all came").arg(taken), false};
        return {name, Text::tr("%1 taken, %2 of them did not come here").arg(taken).arg(lost), true};
    }

    /// What the remembered picture and the tip's place in it no longer fit when it has moved.
    AccountLine stand() const
    {
        const auto name = Text::tr("C-arm and table");
        if (const auto why = missing(m_before.xray.has_value(), m_now.xray.has_value(), Text::tr("no report of the X-ray system"));
            !why.isEmpty())
            return {name, why, true};
        const auto& from = m_before.xray->geometry;
        const auto& to = m_now.xray->geometry;
        QStringList deeds;
        addTurn(deeds, Text::tr("LAO/RAO"), from.primaryAngle, to.primaryAngle);
        addTurn(deeds, Text::tr("CRA/CAU"), from.secondaryAngle, to.secondaryAngle);
        addDistance(deeds, Text::tr("detector"), from.sourceDetectorDistance, to.sourceDetectorDistance);
        addDistance(deeds, Text::tr("isocentre"), from.sourceObjectDistance, to.sourceObjectDistance);
        const double way = std::hypot(to.table[0] - from.table[0], to.table[1] - from.table[1], to.table[2] - from.table[2]);
        if (way >= leastWay)
            deeds << Text::tr("table moved %1\u00A0mm").arg(numberText(way, 1));
        if (deeds.isEmpty())
            return {name, Text::tr("where they were"), false};
        return {name, deeds.join(Text::tr("; ")), true};
    }

    AccountLine patientSide() const
    {
        const auto name = Text::tr("Patient side");
        if (const auto why = noRobot(); !why.isEmpty())
            return {name, why, true};
        QStringList deeds;
        addRobot(deeds);
        addDrives(deeds);
        if (deeds.isEmpty())
            return {name, Text::tr("nothing that the robot's reports tell of"), false};
        return {name, deeds.join(Text::tr("; ")), true};
    }

    QString noRobot() const { return missing(m_before.robot.has_value(), m_now.robot.has_value(), Text::tr("no report of the robot")); }

    /// A system that was started anew counts from nothing: what it did before is not in its books.
    QString noXray() const
    {
        auto why = missing(m_before.xray.has_value(), m_now.xray.has_value(), Text::tr("no report of the X-ray system"));
        if (why.isEmpty() &&
            (m_now.xray->framesAcquired < m_before.xray->framesAcquired || m_now.xray->fluoroscopyTime < m_before.xray->fluoroscopyTime))
            why = Text::tr("unknown: the X-ray system counts anew");
        return why;
    }

    void addRobot(QStringList& deeds) const
    {
        const auto& from = *m_before.robot;
        const auto& to = *m_now.robot;
        if (from.state != to.state)
            deeds << Text::tr("robot: %1 before, %2 now").arg(word(from.state), word(to.state));
        if (to.emergencyStopToken != 0 && to.emergencyStopToken != from.emergencyStopToken)
            deeds << Text::tr("emergency stop pressed, in force");
        else if (from.emergencyStopToken != 0 && to.emergencyStopToken == 0)
            deeds << Text::tr("emergency stop ended");
        if (to.faultCode != 0 && to.faultCode != from.faultCode)
            deeds << Text::tr("fault: %1").arg(faultText(to.faultCode));
        addAxis(deeds, Text::tr("guidewire"), from.guidewirePosition, to.guidewirePosition);
        addAxis(deeds, Text::tr("catheter"), from.catheterPosition, to.catheterPosition);
        addGripper(deeds, Text::tr("guidewire gripper"), from.guidewireGripperClosed, to.guidewireGripperClosed);
        addGripper(deeds, Text::tr("catheter gripper"), from.catheterGripperClosed, to.catheterGripperClosed);
    }

    /// As it reads: a robot that was started anew may count from another place.
    static void addAxis(QStringList& deeds, const QString& axis, double from, double to)
    {
        if (std::abs(to - from) >= leastWay)
            deeds << Text::tr("%1 at %2\u00A0mm before, %3\u00A0mm now").arg(axis, numberText(from, 1), numberText(to, 1));
    }

    /// From the source; 0 is one that is not known.
    static void addDistance(QStringList& deeds, const QString& what, double from, double to)
    {
        if ((from == 0) != (to == 0))
            deeds << (from == 0 ? Text::tr("%1: distance unknown before") : Text::tr("%1: distance unknown now")).arg(what);
        else
            addAxis(deeds, what, from, to);
    }

    static void addTurn(QStringList& deeds, const QString& axis, double from, double to)
    {
        if (std::abs(std::remainder(to - from, 360)) >= leastWay)
            deeds << Text::tr("%1 at %2\u00B0 before, %3\u00B0 now").arg(axis, numberText(from, 1), numberText(to, 1));
    }

    static void addGripper(QStringList& deeds, const QString& gripper, bool before, bool now)
    {
        if (before != now)
            deeds << (now ? Text::tr("%1 closed") : Text::tr("%1 opened")).arg(gripper);
    }

    void addDrives(QStringList& deeds) const
    {
        if (!m_before.drives || !m_now.drives) {
            deeds << Text::tr("drives: unknown");
            return;
        }
        const auto count = [](const DriveStatus& drives) { return std::count(drives.enabled.begin(), drives.enabled.end(), true); };
        const auto from = count(*m_before.drives);
        const auto to = count(*m_now.drives);
        if (m_before.drives->enabled != m_now.drives->enabled)
            deeds << Text::tr("drives enabled: %1 of %3 before, %2 now").arg(from).arg(to).arg(driveCount);
    }

    static constexpr double leastWay = 0.05; ///< mm or degrees, of what is shown

    const InterruptionAccount& m_account;
    const SystemSnapshot& m_before;
    const SystemSnapshot& m_now;
};

} // namespace

QString accountHeadline(const InterruptionAccount& account)
{
    const auto since = QDateTime::fromMSecsSinceEpoch(account.sinceWallMs()).toString(QStringLiteral("HH:mm:ss"));
    if (account.losses() <= 1)
        return Text::tr("Interrupted for %1, since %2").arg(span(account.lasted()), since);
    return Text::tr("%1 losses, interrupted for %2 in all, first at %3").arg(account.losses()).arg(span(account.lasted()), since);
}

std::vector<AccountLine> accountLines(const InterruptionAccount& account) { return Account(account).all(); }

} // namespace console
