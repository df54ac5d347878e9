// Every alarm condition by its cause: the models change as the link room changes them, and the watch raises the alarm.
// What it is while instruments are armed, and after that has ended, is tried by unit.alarm_urgency.
#include "watched_cockpit.hpp"

#include <QTest>

#include <functional>

using namespace console;
using namespace console::test;
using namespace std::chrono_literals;
using C = AlarmCondition;

namespace {

struct Case {
    const char* name;
    std::function<void(Watched&)> cause;
    AlarmCondition condition;
};

void passTime(Watched& w, Duration time, int delivered, int painted)
{
    for (int tenth = 0; tenth < time / 100ms; ++tenth) {
        w.now += 100ms;
        w.delivered += quint64(delivered);
        for (int i = 0; i < painted; ++i) {
            PictureStamp stamp = *w.models().picture.newest();
            ++stamp.frame;
            stamp.painted = w.now;
            w.models().picture.notePainted(stamp);
        }
        w.look();
    }
}

void receiveKerma(Watched& w, double milligrays)
{
    auto status = w.models().xray.status().value;
    status.airKerma = milligrays;
    w.models().xray.receive(status, w.now);
}

const std::vector<Case>& linkCases()
{
    static const std::vector<Case> all{
        {"1 robot link lost", [](Watched& w) { w.models().sessions.setLinkState(robotId, LinkState::StandBy, w.now); }, C::LinkLost},
        {"3 picture frozen",
         [](Watched& w) {
             w.now += 2s;
             w.receive(w.robot());
         },
         C::PictureStale},
        {"4 picture link lost", [](Watched& w) { w.models().sessions.setLinkState(xrayId, LinkState::StandBy, w.now); }, C::ImageLost},
        {"8 round trip",
         [](Watched& w) {
             for (const auto measured : {260ms, 261ms})
                 w.figuresOf(robotId, [measured](auto& f) { f.roundTrip = measured; });
         },
         C::CommandRoundTrip},
        {"9 unsteady",
         [](Watched& w) {
             for (int i = 0; i < 3; ++i) {
                 w.models().sessions.setLinkState(robotId, LinkState::Suspect, w.now);
                 w.models().sessions.setLinkState(robotId, LinkState::Open, w.now);
             }
         },
         C::LinkUnsteady},
        {"16 clock", [](Watched& w) { w.figuresOf(robotId, [](auto& f) { f.clockUncertainty = 126ms; }); }, C::ClockUncertain},
        {"17 painting", [](Watched& w) { passTime(w, 3s, 2, 1); }, C::PaintingBehind},
        {"19 another system", [](Watched& w) { w.models().sessions.noteOpenFailed(armId, QStringLiteral("the topologies differ"), true); },
         C::SystemDiffers},
        {"overdue", [](Watched& w) { w.watch.noteDeadlineMissed(robotId, QStringLiteral("TipPose"), w.now); }, C::DeadlineMissed},
    };
    return all;
}

const std::vector<Case>& deviceCases()
{
    const auto robot = [](auto change) {
        return [change](Watched& w) {
            auto status = w.robot();
            change(status);
            w.receive(status);
        };
    };
    static const std::vector<Case> all{
        {"5 force", robot([](auto& s) { s.guidewireForce = 2.1; }), C::ForceStop},
        {"6 drive", robot([](auto& s) { s.faultCode = 2; }), C::DriveFault},
        {"6 a fault that has no name here", robot([](auto& s) { s.faultCode = 300; }), C::DriveFault},
        {"6 a drive too warm",
         [](Watched& w) {
             auto drives = w.models().instrument.drives().value;
             drives.temperature[1] = 81;
             w.models().instrument.receiveDrives(drives, w.now);
         },
         C::DriveFault},
        {"6 the arm",
         [](Watched& w) {
             ArmStatus arm;
             arm.phase = ArmPhase::Fault;
             w.models().arm.receive(arm, w.now);
         },
         C::DriveFault},
        {"emergency stop unheard",
         [](Watched& w) {
             w.models().instrument.noteStopAsked(5, w.now);
             w.now += 201ms;
         },
         C::StopUnheard},
        {"emergency stop unheard, another one is in force",
         [robot](Watched& w) {
             w.models().instrument.noteStopAsked(5, w.now);
             w.now += 201ms;
             robot([](auto& s) { s.emergencyStopToken = 4; })(w);
         },
         C::StopUnheard},
        {"emergency stop unheard, an old one was reported long ago",
         [robot](Watched& w) {
             robot([](auto& s) { s.emergencyStopToken = 4; })(w);
             w.now += 1s;
             w.models().instrument.noteStopAsked(5, w.now);
             w.now += 201ms;
         },
         C::StopUnheard},
        {"7 emergency stop", robot([](auto& s) { s.emergencyStopToken = 4; }), C::EmergencyStop},
        {"11 tracker invalid",
         [](Watched& w) {
             TipPose blind;
             w.models().instrument.receiveTip(blind, w.now);
         },
         C::TrackerStale},
        {"13 contrast low", robot([](auto& s) { s.contrastRemaining = 4.5; }), C::ContrastLow},
        {"13 contrast empty",
         [robot](Watched& w) {
             w.models().instrument.receiveInjection({9, 2, InjectionProgress::Running, {}}, w.now);
             robot([](auto& s) { s.contrastRemaining = 0; })(w);
         },
         C::ContrastEmpty},
        {"fluoroscopy time",
         [](Watched& w) {
             auto status = w.models().xray.status().value;
             status.fluoroscopyTime = 301;
             w.models().xray.receive(status, w.now);
         },
         C::FluoroscopyTime},
        {"14 air kerma", [](Watched& w) { receiveKerma(w, 3100); }, C::AirKerma},
        {"18 alarm log", [](Watched& w) { w.models().recorder.logTrouble = QStringLiteral("disk full"); }, C::RecorderStopped},
        {"18 audit", [](Watched& w) { w.models().recorder.auditTrouble = QStringLiteral("disk full"); }, C::RecorderStopped},
        {"20 sound", [](Watched& w) { w.watch.setSoundTrouble(QStringLiteral("no output")); }, C::SoundFailed},
        {"watchdog", [](Watched& w) { w.watch.setWatchdogTrouble(QStringLiteral("ended")); }, C::WatchdogGone},
    };
    return all;
}

std::vector<Case> cases()
{
    auto all = linkCases();
    all.insert(all.end(), deviceCases().begin(), deviceCases().end());
    return all;
}

} // namespace

class TestAlarmWatch : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void aCalmCockpitHasNoAlarm()
    {
        Watched w;
        QVERIFY2(w.models().alarms.alarms().empty(),
                 qPrintable(w.models().alarms.alarms().empty() ? QString() : w.models().alarms.highest()->text));
        passTime(w, 3s, 2, 2);
        QVERIFY(!w.priorityOf(C::PaintingBehind));
    }

    /// The library tells a gap once; the alarm is about what has not come yet.
    void aReportThatIsMissingIsAnAlarmUntilItComes()
    {
        Watched w;
        const auto sixSeconds = [&w] { // in which the robot goes on reporting
            for (int i = 0; i < 60; ++i) {
                w.now += 100ms;
                w.receive(w.robot());
                w.look();
            }
        };
        w.watch.noteDeadlineMissed(xrayId, QStringLiteral("AcquisitionStatus"), w.now);
        sixSeconds();
        QVERIFY(w.priorityOf(C::DeadlineMissed).has_value());
        w.watch.noteDeadlineMissed(robotId, QStringLiteral("RobotStatus"), w.now);
        sixSeconds();
        QVERIFY(w.priorityOf(C::DeadlineMissed).has_value()); // that of the X-ray system
        w.now += 100ms;
        w.models().xray.receive(w.models().xray.status().value, w.now);
        QVERIFY(w.ends(C::DeadlineMissed));
    }

    void aConsoleAtTheLimitOfItsSpeedDoesNotFlicker()
    {
        Watched w;
        passTime(w, 3s, 20, 17);
        QVERIFY(!w.priorityOf(C::PaintingBehind));
        passTime(w, 3s, 20, 15);
        QVERIFY(w.priorityOf(C::PaintingBehind).has_value());
        const auto raised = w.models().alarms.raisedInAll();
        passTime(w, 3s, 20, 17);
        QVERIFY(w.priorityOf(C::PaintingBehind).has_value());
        QCOMPARE(w.models().alarms.raisedInAll(), raised);
        passTime(w, 5s, 20, 19); // two of them until enough were painted, two more until it has ended
        QVERIFY(!w.priorityOf(C::PaintingBehind));
    }

    void fewerPicturesThanExpectedAreTold()
    {
        Watched w;
        w.cockpit.arm();
        const auto play = [&w](int perSecond, Duration time) {
            const auto period = Duration(1s) / perSecond;
            for (Duration passed{}; passed < time; passed += period) {
                w.now += period;
                PictureStamp stamp = *w.models().picture.newest();
                ++stamp.frame;
                stamp.painted = w.now;
                stamp.captured = w.now - 80ms;
                w.models().picture.notePainted(stamp);
                w.look();
            }
        };
        play(15, 3s);
        QVERIFY(!w.priorityOf(C::PictureSlow));
        play(12, 2s); // for a moment it is none
        QVERIFY(!w.priorityOf(C::PictureSlow));
        play(12, 2s);
        QCOMPARE(w.priorityOf(C::PictureSlow), std::optional(AlarmPriority::Low));
        QVERIFY(w.models().picture.reading(w.now).keepsRate); // caution, and no hold
        const auto raised = w.idOf(C::PictureSlow);
        play(15, 1s); // enough for a moment
        play(12, 2s);
        QCOMPARE(w.idOf(C::PictureSlow), raised); // the same alarm: nobody has to acknowledge it again
        play(15, 4s);
        QVERIFY(!w.priorityOf(C::PictureSlow));
    }

    void eachConditionIsRaisedByItsCause_data()
    {
        QTest::addColumn<int>("number");
        for (int number = 0; number < int(cases().size()); ++number)
            QTest::newRow(cases().at(std::size_t(number)).name) << number;
    }

    void eachConditionIsRaisedByItsCause()
    {
        QFETCH(int, number);
        const auto one = cases().at(std::size_t(number));
        Watched w;
        QVERIFY(!w.priorityOf(one.condition));
        one.cause(w);
        QVERIFY(w.priorityOf(one.condition));
    }

    void aTrackerOfAClosedLinkIsNoAlarm()
    {
        Watched w;
        w.now += 1s;
        QVERIFY(w.priorityOf(C::TrackerStale));
        w.models().sessions.setLinkState(robotId, LinkState::Closed, w.now);
        QVERIFY(w.ends(C::TrackerStale));
    }

    /// Its program stands still, or nobody looked while the report was new: the same fault bars arming.
    void anArmsFaultIsAnAlarmUntilItSaysOtherwise_data()
    {
        QTest::addColumn<int>("age");
        QTest::newRow("found at once") << 0;
        QTest::newRow("found late") << 3000;
    }

    void anArmsFaultIsAnAlarmUntilItSaysOtherwise()
    {
        QFETCH(int, age);
        Watched w;
        const auto report = [&w](ArmPhase phase) {
            ArmStatus arm;
            arm.phase = phase;
            w.models().arm.receive(arm, w.now);
        };
        report(ArmPhase::Fault);
        w.now += std::chrono::milliseconds(age);
        const auto raised = w.idOf(C::DriveFault);
        QVERIFY(raised != 0);
        w.models().alarms.acknowledge(raised, 0);
        w.now += 3s;
        w.look();
        w.now += 3s;
        QCOMPARE(w.idOf(C::DriveFault), raised);
        report(ArmPhase::Hold);
        QVERIFY(w.ends(C::DriveFault));
        report(ArmPhase::Fault);
        QVERIFY(w.priorityOf(C::DriveFault));
        w.models().sessions.setLinkState(armId, LinkState::Closed, w.now);
        QVERIFY(w.ends(C::DriveFault));
    }

    void aPictureLinkIsNotAlsoALostLink()
    {
        Watched w;
        w.models().sessions.setLinkState(xrayId, LinkState::StandBy, w.now);
        QVERIFY(w.priorityOf(C::ImageLost));
        QVERIFY(!w.priorityOf(C::LinkLost));
    }

    /// Whoever has heard of a disk that is nearly full does not know that it is full.
    void whatIsRecordedLessDemandsAttentionAnew()
    {
        Watched w;
        auto& recorder = w.models().recorder;
        const auto attended = [&w] {
            const bool acknowledged = w.priorityOf(C::RecorderStopped).has_value() && w.models().alarms.highest()->acknowledged;
            w.models().alarms.acknowledge(w.idOf(C::RecorderStopped), 0);
            return acknowledged;
        };
        recorder.logTrouble = QStringLiteral("nearly full, 50 MB left");
        QVERIFY(!attended());
        recorder.logTrouble = QStringLiteral("nearly full, 49 MB left");
        QVERIFY(attended());
        recorder.logKept = false;
        recorder.logTrouble = QStringLiteral("cannot be written");
        QVERIFY(!attended());
        recorder.logKept = true; // a moment's room
        recorder.logTrouble = QStringLiteral("nearly full, 0 MB left");
        QVERIFY(attended());
        recorder.logTrouble.clear();
        recorder.auditTrouble = QStringLiteral("the audit file is not written");
        QVERIFY(!attended());
    }

    void doseStaysAnAlarmWhenTheXraySystemIsSilent()
    {
        Watched w;
        receiveKerma(w, 5100);
        QCOMPARE(w.priorityOf(C::AirKerma), AlarmPriority::Medium);
        w.now += 1h;
        QVERIFY(w.priorityOf(C::AirKerma));
    }
};

QTEST_GUILESS_MAIN(TestAlarmWatch)
#include "test_alarm_watch.moc"
