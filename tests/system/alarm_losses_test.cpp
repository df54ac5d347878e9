// Alarms of real devices: one that is killed, and a stop that somebody presses beside the robot; while it is armed, and while it is not.
#include "theatre.hpp"
#include "widgets/hold_button.hpp"
#include "widgets/theme.hpp"

#include <QApplication>
#include <QTest>

#include <algorithm>

using namespace console;
using console::test::Theatre;
using C = AlarmCondition;

namespace {

constexpr int patience = Theatre::patience;

bool isPresent(const Theatre& theatre, C condition, AlarmPriority priority)
{
    const auto& alarms = theatre.models().alarms.alarms();
    return std::any_of(alarms.begin(), alarms.end(),
                       [&](const Alarm& one) { return one.condition == condition && one.present && one.priority == priority; });
}

/// Holds the button that ends an emergency stop until the robot says that it has ended.
bool resetStop(Theatre& theatre)
{
    HoldButton* reset = nullptr;
    const auto find = [&] {
        for (auto* button : theatre.window().findChildren<HoldButton*>())
            if (button->isVisible() && button->accessibleName().startsWith(QStringLiteral("Reset")))
                reset = button;
        return reset != nullptr;
    };
    if (!QTest::qWaitFor(find, patience))
        return false;
    QTest::mousePress(reset, Qt::LeftButton);
    const bool ended = QTest::qWaitFor([&] { return theatre.robotStatus().emergencyStopToken == 0; }, patience);
    QTest::mouseRelease(reset, Qt::LeftButton);
    return ended;
}

Theatre::Wishes robotAndXray()
{
    Theatre::Wishes wishes;
    wishes.arm = false;
    return wishes;
}

} // namespace

class AlarmLossesTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void initTestCase() { theme::apply(*qobject_cast<QApplication*>(QCoreApplication::instance())); }

    /// 1, 2 and 4.
    void aDeviceThatDiesIsAnAlarm_data()
    {
        QTest::addColumn<QString>("device");
        QTest::addColumn<bool>("armed");
        for (const char* device : {"robot", "xray"}) {
            QTest::addRow("%s, armed", device) << QString::fromLatin1(device) << true;
            QTest::addRow("%s, not armed", device) << QString::fromLatin1(device) << false;
        }
    }

    void aDeviceThatDiesIsAnAlarm()
    {
        QFETCH(QString, device);
        QFETCH(bool, armed);
        Theatre theatre(robotAndXray());
        QVERIFY(theatre.openAll());
        const bool robot = device == QStringLiteral("robot");
        const auto priority = armed ? AlarmPriority::High : AlarmPriority::Medium;
        const auto condition = robot ? C::LinkLost : C::ImageLost;
        if (armed) {
            QVERIFY2(theatre.armAndMove(), qPrintable(theatre.story()));
            theatre.release(Qt::Key_Up);
            theatre.release(Qt::Key_D); // and the pedal stays down
            QCOMPARE(theatre.phase(), PermitPhase::Armed);
        } else {
            QVERIFY2(theatre.makeReady(), qPrintable(theatre.story()));
        }
        (robot ? theatre.robot : theatre.xray)->kill();
        QTRY_VERIFY2_WITH_TIMEOUT(isPresent(theatre, condition, priority), qPrintable(theatre.story()), patience);
        QVERIFY(!isPresent(theatre, robot ? C::ImageLost : C::LinkLost, priority));
        if (robot)
            QTRY_VERIFY2_WITH_TIMEOUT(isPresent(theatre, C::HoldNotConfirmed, priority), qPrintable(theatre.story()), patience);
        QTRY_VERIFY2_WITH_TIMEOUT(theatre.link(device.toStdString()) == LinkState::StandBy, qPrintable(theatre.story()), patience);
        QVERIFY2(isPresent(theatre, condition, priority), qPrintable(theatre.story())); // also when it is known that it will not heal
    }

    /// 7.
    void aStopBesideTheRobotIsAnAlarm_data()
    {
        QTest::addColumn<bool>("armed");
        QTest::newRow("armed") << true;
        QTest::newRow("not armed") << false;
    }

    void aStopBesideTheRobotIsAnAlarm()
    {
        QFETCH(bool, armed);
        Theatre theatre(robotAndXray());
        QVERIFY(theatre.openAll());
        if (armed)
            QVERIFY2(theatre.armAndMove(), qPrintable(theatre.story()));
        else
            QVERIFY2(theatre.makeReady(), qPrintable(theatre.story()));
        theatre.robot->say(QStringLiteral("stop the wire is caught"));
        const auto priority = armed ? AlarmPriority::High : AlarmPriority::Medium;
        QTRY_VERIFY2_WITH_TIMEOUT(isPresent(theatre, C::EmergencyStop, priority), qPrintable(theatre.story()), patience);
        QVERIFY(theatre.phase() != PermitPhase::Engaged && theatre.phase() != PermitPhase::Armed);
        QTRY_VERIFY2_WITH_TIMEOUT(theatre.robotStatus().holdConfirmed, qPrintable(theatre.story()), patience);
        const auto applied = theatre.robotStatus().appliedCommands;
        const auto reports = theatre.models().instrument.statusCount();
        theatre.hold(Qt::Key_D);
        theatre.hold(Qt::Key_Up);
        QTRY_VERIFY_WITH_TIMEOUT(theatre.models().instrument.statusCount() > reports + 50, patience);
        QCOMPARE(theatre.robotStatus().appliedCommands, applied);
        QVERIFY(isPresent(theatre, C::EmergencyStop, priority));
        theatre.releaseAll();
        QVERIFY2(resetStop(theatre), qPrintable(theatre.story()));
        QTRY_VERIFY2_WITH_TIMEOUT(!isPresent(theatre, C::EmergencyStop, priority), qPrintable(theatre.story()), patience);
    }
};

QTEST_MAIN(AlarmLossesTest)
#include "alarm_losses_test.moc"
