// One cause, two priorities: while the robot is armed and while nothing is, as the console itself tells them apart; in one console, which
// is armed in between.
#include "alarm_stage.hpp"
#include "hostile_stage.hpp"
#include "shown_alarms.hpp"
#include "widgets/theme.hpp"

#include <QApplication>
#include <QTest>

#include <algorithm>
#include <utility>

using namespace console;
using console::test::isPresent;
using console::test::present;
using console::test::puppetWishes;
using console::test::Theatre;
using liena::Message;
using liena::test::PuppetXray;
using namespace std::chrono_literals;
using C = AlarmCondition;

namespace {

constexpr int patience = Theatre::patience;

Theatre::Wishes wishesWithSecondXray()
{
    auto wishes = puppetWishes();
    wishes.secondXray = true;
    return wishes;
}

/// With a robot that can be armed, and with a second X-ray system over a line as the test makes it.
struct Stage : console::test::AlarmStage {
    Stage() : AlarmStage(wishesWithSecondXray()) {}

    liena::test::ScriptedPeer second{secondRole()};

    liena::test::PeerRole secondRole()
    {
        auto played = liena::test::roleOf(theatre.files, "xray", "cockpit");
        const auto identity = theatre.files.identityOf("xray-2");
        played.id = theatre.files.idOf("xray-2").value();
        played.port = theatre.files.portOf("xray-2");
        played.face = {.certificate = identity.certificate, .key = identity.key, .authority = identity.authority, .between = {}};
        played.heartbeat = 20ms;
        return played;
    }

    bool opens()
    {
        second.open();
        const auto compared = [this] {
            const auto* link = theatre.models().sessions.linkTo(theatre.files.idOf("xray-2").value());
            return link != nullptr && link->figures.clockOffset.has_value();
        };
        return theatre.openAll() && QTest::qWaitFor(compared, patience);
    }

    bool tells(C condition, AlarmPriority priority) const
    {
        return QTest::qWaitFor([&] { return isPresent(theatre, condition, priority); }, patience);
    }

    bool ends(C condition) const
    {
        return QTest::qWaitFor([&] { return present(theatre, condition) == nullptr; }, patience);
    }
};

} // namespace

class AlarmPrioritiesTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void initTestCase()
    {
        theme::apply(*qobject_cast<QApplication*>(QCoreApplication::instance()));
        m_stage = std::make_unique<Stage>();
        QVERIFY2(m_stage->opens(), qPrintable(m_stage->theatre.story()));
    }

    void cleanupTestCase() { m_stage.reset(); }

    /// 16: first not armed, and more urgent as soon as it is. Whatever link it is of, ages are unknown.
    void anUncertainClockIsMoreUrgentWhileArmed()
    {
        Stage& stage = *m_stage;
        QVERIFY2(stage.theatre.makeReady(), qPrintable(stage.theatre.story()));
        QVERIFY(present(stage.theatre, C::ClockUncertain) == nullptr);
        stage.second.habits.delay = 500ms; // this profile: clocks to within 200 ms
        QVERIFY2(stage.tells(C::ClockUncertain, AlarmPriority::Low), qPrintable(stage.theatre.story()));
        QVERIFY2(stage.theatre.arm(), qPrintable(stage.theatre.story()));
        QVERIFY2(stage.tells(C::ClockUncertain, AlarmPriority::Medium), qPrintable(stage.theatre.story()));
        stage.second.habits.delay = 0ms;
        QVERIFY2(stage.ends(C::ClockUncertain), qPrintable(stage.theatre.story()));
    }

    /// 12: the picture tells it at any time; an alarm is it as soon as instruments may move without it.
    void aRemovedRoadmapIsAnAlarmOnlyWhileArmed()
    {
        Stage& stage = *m_stage;
        QVERIFY2(stage.theatre.makeReady(), qPrintable(stage.theatre.story()));
        QVERIFY2(stage.makeRoadmap(), qPrintable(stage.theatre.story()));
        stage.xray.alterStatus([](Message& m) { m.set("table_position", std::vector<double>{0, 5, 0}); });
        const auto& roadmap = stage.theatre.models().roadmap;
        QTRY_VERIFY2_WITH_TIMEOUT(roadmap.isWanted() && !roadmap.isValid(), qPrintable(stage.theatre.story()), patience);
        const auto removed = stage.robot.turns();
        QTRY_VERIFY_WITH_TIMEOUT(stage.robot.turns() > removed + 50, patience); // alarms are looked for several times between
        QVERIFY(stage.theatre.phase() < PermitPhase::Armed);
        QVERIFY2(present(stage.theatre, C::RoadmapRemoved) == nullptr, qPrintable(stage.theatre.story()));
        QVERIFY2(stage.theatre.arm(), qPrintable(stage.theatre.story()));
        QVERIFY2(stage.tells(C::RoadmapRemoved, AlarmPriority::Low), qPrintable(stage.theatre.story()));
        stage.endRoadmap();
        QVERIFY2(stage.ends(C::RoadmapRemoved), qPrintable(stage.theatre.story()));
    }

    /// 3, 5, 6, 11, 13, 15: after an armed time, whose hold is over.
    void whatHappensWhileNothingIsArmedIsLessUrgent()
    {
        Stage& stage = *m_stage;
        QVERIFY2(stage.theatre.makeReady(), qPrintable(stage.theatre.story()));
        stage.robot.alterStatus([](Message& m) {
            m.set("guidewire_force", 2.3).set("limit_switches", 10U).set("contrast_remaining", 3.0);
            m.set("fault_code", 2).set("state", std::string_view("Fault"));
        });
        stage.robot.alterTip([](Message& m) { m.set("valid", false); });
        stage.xray.show(PuppetXray::Pictures::None);
        const std::pair<C, AlarmPriority> all[] = {{C::ForceStop, AlarmPriority::Medium},
                                                   {C::DriveFault, AlarmPriority::Medium},
                                                   {C::TrackerStale, AlarmPriority::Low},
                                                   {C::ContrastLow, AlarmPriority::Low},
                                                   {C::PictureStale, AlarmPriority::Low}};
        for (const auto& [condition, priority] : all)
            QVERIFY2(stage.tells(condition, priority), qPrintable(stage.theatre.story()));
        // They came with the same reports, and are none now.
        for (const auto condition : {C::SoftLimit, C::HardLimit, C::ForceWarn})
            QVERIFY2(present(stage.theatre, condition) == nullptr, qPrintable(stage.theatre.story()));
        stage.robot.alterStatus({});
        stage.robot.alterTip({});
        stage.xray.show(PuppetXray::Pictures::Good);
        for (const auto& [condition, priority] : all)
            QVERIFY2(stage.ends(condition), qPrintable(stage.theatre.story()));
    }

    /// 6, 7 and a report that is overdue.
    void whatAnotherDeviceOrPersonDoesMeanwhileIsLessUrgent()
    {
        Stage& stage = *m_stage;
        QVERIFY(stage.theatre.phase() < PermitPhase::Armed);
        stage.arm.setFault(true);
        stage.robot.alterStatus([](Message& m) { m.set("emergency_stop_token", 77U).set("state", std::string_view("EmergencyStop")); });
        QVERIFY2(stage.tells(C::DriveFault, AlarmPriority::Medium), qPrintable(stage.theatre.story()));
        QVERIFY2(stage.tells(C::EmergencyStop, AlarmPriority::Medium), qPrintable(stage.theatre.story()));
        stage.arm.setFault(false);
        stage.robot.alterStatus({});
        stage.robot.setSilent(true);
        const auto robotOverdue = [&stage, robotId = stage.theatre.files.idOf("robot").value()] {
            const auto& alarms = stage.theatre.models().alarms.alarms();
            return std::ranges::any_of(alarms, [robotId](const Alarm& one) {
                return one.condition == C::DeadlineMissed && one.subject == robotId && one.present && one.priority == AlarmPriority::Low;
            });
        };
        QTRY_VERIFY2_WITH_TIMEOUT(robotOverdue(), qPrintable(stage.theatre.story()), patience);
        stage.robot.setSilent(false);
    }

    /// 2: another device is lost, and the robot, which lives, does not say that it holds.
    void aHoldThatNobodyConfirmsAfterALossIsMediumWhileNothingIsArmed()
    {
        Stage& stage = *m_stage;
        QVERIFY(stage.theatre.phase() < PermitPhase::Armed);
        stage.robot.alterStatus([](Message& m) { m.set("hold_confirmed", false); });
        stage.xray.standStill(4000ms); // it is lost after 800 ms, and not waited for after two seconds more
        QTRY_VERIFY2_WITH_TIMEOUT(stage.theatre.phase() == PermitPhase::Incident, qPrintable(stage.theatre.story()), patience);
        QVERIFY2(stage.tells(C::HoldNotConfirmed, AlarmPriority::Medium), qPrintable(stage.theatre.story()));
        QVERIFY2(stage.tells(C::ImageLost, AlarmPriority::Medium), qPrintable(stage.theatre.story()));
        QCOMPARE(stage.theatre.link("robot"), LinkState::Open);
        stage.robot.alterStatus({});
        QVERIFY2(stage.ends(C::HoldNotConfirmed), qPrintable(stage.theatre.story()));
    }

private:
    std::unique_ptr<Stage> m_stage;
};

QTEST_MAIN(AlarmPrioritiesTest)
#include "alarm_priorities_test.moc"
