// What must never be possible where this console is not the only one: that it takes another one's robot for its own, or that its emergency
// stop is lost, beside another one's or by the name that tells whose it is.
#include "never_possible_stage.hpp"
#include "widgets/theme.hpp"

#include <QApplication>
#include <QDeadlineTimer>

using namespace console;
using console::test::logTells;
using console::test::Theatre;
using liena::Message;
using Stage = console::test::NeverStage;

namespace {

constexpr int patience = Theatre::patience;
constexpr std::uint32_t anotherConsole = 0x40018209;
constexpr std::uint64_t anotherStop = 77;

bool stopIsUnheard(const Theatre& theatre)
{
    const auto& alarms = theatre.models().alarms.alarms();
    return std::any_of(alarms.begin(), alarms.end(),
                       [](const Alarm& alarm) { return alarm.condition == AlarmCondition::StopUnheard && alarm.present; });
}

/// ARM is held until the console leaves ARMING, whichever way.
void tryToArm(Stage& stage)
{
    if (!stage.theatre.makeReady())
        return;
    stage.theatre.hold(Qt::Key_R);
    (void)QTest::qWaitFor([&] { return stage.phase() != PermitPhase::Ready && stage.phase() != PermitPhase::Arming; }, patience);
    stage.theatre.release(Qt::Key_R);
}

} // namespace

class NeverSharedTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void initTestCase() { theme::apply(*qobject_cast<QApplication*>(QCoreApplication::instance())); }

    /// Both asked for the same permit at the same moment, and the robot took the other one.
    void aRobotThatAnotherConsoleHasArmedIsNotArmedHere()
    {
        Stage stage;
        QVERIFY(stage.open());
        stage.robot.alterStatus([](Message& status) {
            if (status.get<std::uint32_t>("owner") != 0)
                status.set("owner", anotherConsole);
        });
        bool armed = false;
        const auto watch = QObject::connect(
            &stage.theatre.models().permit, &PermitModel::phaseChanged, &stage.theatre.window(),
            [&armed](PermitPhase, PermitPhase to) { armed = armed || to == PermitPhase::Armed || to == PermitPhase::Engaged; });
        const auto isSaid = [&] { return logTells(stage.theatre, QStringLiteral("ARMING -> STANDBY: Another console has the robot")); };
        const QDeadlineTimer deadline(3 * patience);
        while (!isSaid() && !armed && !deadline.hasExpired())
            tryToArm(stage);
        QVERIFY2(isSaid() && !armed, qPrintable(stage.theatre.story()));
        QVERIFY(stage.robot.armRequests() > 0);
        QVERIFY2(stage.nothingComesBack(), qPrintable(stage.theatre.story()));
        QVERIFY(!armed);
        QObject::disconnect(watch);
        stage.theatre.releaseAll();
    }

    /// The other one may be reset by who made it: then this press has to count.
    void aStopThatIsPressedWhileAnotherOneIsInForceReachesTheRobot()
    {
        Stage stage;
        QVERIFY(stage.open());
        stage.robot.alterStatus(
            [](Message& status) { status.set("emergency_stop_token", anotherStop).set("state", std::string_view("EmergencyStop")); });
        const auto& theatre = stage.theatre;
        QTRY_VERIFY2_WITH_TIMEOUT(theatre.robotStatus().emergencyStopToken == anotherStop, qPrintable(theatre.story()), patience);
        QTest::keyClick(&stage.theatre.window(), Qt::Key_Escape);
        QTRY_VERIFY2_WITH_TIMEOUT(stage.robot.stops().size() > 2, qPrintable(theatre.story()), patience); // and again, as it is not named
        const auto token = stage.robot.stops().front();
        QVERIFY(token != anotherStop);
        QTRY_VERIFY2_WITH_TIMEOUT(stopIsUnheard(theatre), qPrintable(theatre.story()), patience);

        stage.robot.alterStatus({});
        QTRY_VERIFY2_WITH_TIMEOUT(theatre.robotStatus().emergencyStopToken == token, qPrintable(theatre.story()), patience);
        QVERIFY(!theatre.models().instrument.stopUnheard());
        QTRY_VERIFY2_WITH_TIMEOUT(!stopIsUnheard(theatre), qPrintable(theatre.story()), patience);

        // The next press is another one: a reset of this one may be on its way.
        QTest::keyClick(&stage.theatre.window(), Qt::Key_Escape);
        QTRY_VERIFY2_WITH_TIMEOUT(stage.robot.stops().back() != token, qPrintable(theatre.story()), patience);
        QTRY_VERIFY2_WITH_TIMEOUT(!theatre.models().instrument.stopUnheard(), qPrintable(theatre.story()), patience);
    }

    /// 66 bytes of UTF-8, of which the message holds 64: that is within a character.
    void aStopOfAConsoleWithALongNameReachesTheRobot()
    {
        auto wishes = console::test::puppetWishes();
        wishes.title.clear();
        for (int i = 0; i < 22; ++i)
            wishes.title += "舱";
        Stage stage(wishes);
        QVERIFY(stage.open());
        QTest::keyClick(&stage.theatre.window(), Qt::Key_Escape);
        QTRY_VERIFY2_WITH_TIMEOUT(!stage.robot.stops().empty(), qPrintable(stage.theatre.story()), patience);
        QTRY_VERIFY2_WITH_TIMEOUT(!stage.theatre.models().instrument.stopUnheard(), qPrintable(stage.theatre.story()), patience);
    }
};

QTEST_MAIN(NeverSharedTest)
#include "never_shared_test.moc"
