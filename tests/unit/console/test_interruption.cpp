// The account of an interruption: its stages, what it says, and that it says "unknown" where nothing is known.
#include "model/interruption.hpp"

#include <QTest>

using namespace console;
using namespace std::chrono_literals;
using Stage = InterruptionAccount::Stage;

namespace {

const Instant start = Instant{} + 1h;

RobotStatus robot(double force, double contrast)
{
    RobotStatus status;
    status.state = RobotState::Engaged;
    status.guidewireForce = force;
    status.contrastRemaining = contrast;
    status.guidewirePosition = 800;
    return status;
}

SystemSnapshot known(Instant at)
{
    SystemSnapshot snapshot;
    snapshot.robot = robot(0.46, 78.5);
    snapshot.robotAt = at;
    snapshot.tip = TipPose{true, {10, 20, 30}, {1, 0, 0, 0}, 0.3};
    snapshot.drives = DriveStatus{};
    snapshot.drives->enabled = {true, true, true, true};
    snapshot.xray = AcquisitionStatus{};
    snapshot.xray->fluoroscopyTime = 100;
    snapshot.xray->geometry.sourceDetectorDistance = 1100;
    snapshot.xray->framesAcquired = 1500;
    snapshot.xrayAt = at;
    snapshot.picturesReceived = 1490;
    return snapshot;
}

struct Interrupted {
    InterruptionAccount account;
    Instant now = start;

    explicit Interrupted(const SystemSnapshot& before = known(start))
    {
        account.note(before);
        account.begin(QStringLiteral("Robot link"), now, 0);
        now += 12400ms;
    }

    void end(const SystemSnapshot& after)
    {
        account.end(now);
        account.note(after);
    }

    AccountLine line(const char* name) const
    {
        for (const auto& one : accountLines(account))
            if (one.name == QLatin1String(name))
                return one;
        return {};
    }
    QString text(const char* name) const { return line(name).text; }
};

struct Change {
    const char* name;
    void (*change)(SystemSnapshot&);
    const char* line;
    const char* says;
};

const std::vector<Change>& changes()
{
    static const std::vector<Change> all{
        {"nothing moved", [](auto&) {}, "Tip", "moved 0.0\u00A0mm (tracker \u00B10.4\u00A0mm)"},
        {"tip moved",
         [](auto& s) {
             s.tip->position = {11, 22, 32};
         },
         "Tip", "moved 3.0\u00A0mm"},
        {"tracker gone", [](auto& s) { s.tip.reset(); }, "Tip", "unknown: no valid tracker position now"},
        {"force", [](auto& s) { s.robot->guidewireForce = 0.08; }, "Force", "0.46\u00A0N before, 0.08\u00A0N now (\u22120.38\u00A0N)"},
        {"force as it was", [](auto&) {}, "Force", "0.46\u00A0N, as before"},
        {"contrast used", [](auto& s) { s.robot->contrastRemaining = 73.7; }, "Contrast", "4.8\u00A0mL used, 73.7\u00A0mL left"},
        {"contrast filled up", [](auto& s) { s.robot->contrastRemaining = 100; }, "Contrast",
         "unknown: 78.5\u00A0mL before, 100.0\u00A0mL now"},
        {"beam", [](auto& s) { s.xray->fluoroscopyTime = 103.2; }, "X-ray time", "3.2 s of beam"},
        {"beam counts anew", [](auto& s) { s.xray->fluoroscopyTime = 3; }, "X-ray time", "unknown: the X-ray system counts anew"},
        {"no picture taken", [](auto&) {}, "Pictures", "none was taken meanwhile"},
        {"pictures lost", [](auto& s) { s.xray->framesAcquired = 1560, s.picturesReceived = 1508; }, "Pictures",
         "60 taken, 42 of them did not come here"},
        {"more came than were taken", [](auto& s) { s.xray->framesAcquired = 1501, s.picturesReceived = 1499; }, "Pictures",
         "1 taken, all came"},
        {"robot silent now", [](auto& s) { s.robot.reset(); }, "Force", "unknown: no report of the robot now"},
        {"X-ray system silent now", [](auto& s) { s.xray.reset(); }, "Pictures", "unknown: no report of the X-ray system now"},
        {"stands as it did", [](auto&) {}, "C-arm and table", "where they were"},
        {"C-arm turned", [](auto& s) { s.xray->geometry.primaryAngle = -30; }, "C-arm and table",
         "LAO/RAO at 0.0\u00B0 before, \u221230.0\u00B0 now"},
        {"C-arm tilted and drawn back",
         [](auto& s) {
             s.xray->geometry.secondaryAngle = 12.5;
             s.xray->geometry.sourceDetectorDistance = 1200;
         },
         "C-arm and table", "CRA/CAU at 0.0\u00B0 before, 12.5\u00B0 now; detector at 1100.0\u00A0mm before, 1200.0\u00A0mm now"},
        {"distance not told any more", [](auto& s) { s.xray->geometry.sourceDetectorDistance = 0; }, "C-arm and table",
         "detector: distance unknown now"},
        {"a full turn is none", [](auto& s) { s.xray->geometry.primaryAngle = 360; }, "C-arm and table", "where they were"},
        {"table moved",
         [](auto& s) {
             s.xray->geometry.table = {3, 0, -4};
         },
         "C-arm and table", "table moved 5.0\u00A0mm"},
        {"C-arm not told", [](auto& s) { s.xray.reset(); }, "C-arm and table", "unknown: no report of the X-ray system now"},
        {"nothing done", [](auto&) {}, "Patient side", "nothing that the robot's reports tell of"},
        {"robot's state", [](auto& s) { s.robot->state = RobotState::Ready; }, "Patient side", "robot: engaged before, ready now"},
        {"drives off", [](auto& s) { s.drives->enabled = {}; }, "Patient side", "drives enabled: 4 of 4 before, 0 now"},
        {"drives not told", [](auto& s) { s.drives.reset(); }, "Patient side", "drives: unknown"},
        {"emergency stop", [](auto& s) { s.robot->emergencyStopToken = 9; }, "Patient side", "emergency stop pressed, in force"},
        {"gripper", [](auto& s) { s.robot->guidewireGripperClosed = true; }, "Patient side", "guidewire gripper closed"},
        {"pulled by hand", [](auto& s) { s.robot->guidewirePosition = 790; }, "Patient side",
         "guidewire at 800.0\u00A0mm before, 790.0\u00A0mm now"},
    };
    return all;
}

} // namespace

class TestInterruption : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void nothingIsToBeReadBeforeAnyLoss()
    {
        InterruptionAccount account;
        QVERIFY(account.settled());
        account.end(start);
        QVERIFY(!account.acknowledge(start + 1h));
        QVERIFY(account.settled());
    }

    void isReadOnlyAfterTheEndAndNotAtOnce()
    {
        Interrupted one;
        QCOMPARE(one.account.stage(), Stage::Running);
        QVERIFY(!one.account.acknowledge(one.now + 1h));
        one.end(known(one.now));
        QVERIFY(!one.account.settled());
        QVERIFY(!one.account.acknowledge(one.now + InterruptionAccount::readTime - 1ms));
        QVERIFY(one.account.acknowledge(one.now + InterruptionAccount::readTime));
        QVERIFY(one.account.settled());
    }

    void saysWhatChanged_data()
    {
        QTest::addColumn<int>("number");
        for (int number = 0; number < int(changes().size()); ++number)
            QTest::newRow(changes().at(std::size_t(number)).name) << number;
    }

    void saysWhatChanged()
    {
        QFETCH(int, number);
        const auto& one = changes().at(std::size_t(number));
        Interrupted interrupted;
        auto after = known(interrupted.now);
        one.change(after);
        interrupted.end(after);
        const auto said = interrupted.text(one.line);
        QVERIFY2(said.contains(QString::fromUtf8(one.says)), qPrintable(said));
    }

    void theDifferenceIsThatOfTheFiguresShown()
    {
        auto before = known(start);
        before.robot->guidewireForce = 0.364;
        Interrupted one(before);
        auto after = known(one.now);
        after.robot->guidewireForce = 0.006;
        one.end(after);
        QCOMPARE(one.text("Force"), QStringLiteral("0.36\u00A0N before, 0.01\u00A0N now (\u22120.35\u00A0N)"));
        QVERIFY(one.line("Force").changed);
    }

    void whatIsUnknownIsRemarked()
    {
        Interrupted interrupted(SystemSnapshot{});
        interrupted.end({});
        for (const char* name : {"Tip", "Force", "Contrast", "X-ray time", "Pictures", "C-arm and table", "Patient side"}) {
            QVERIFY2(interrupted.text(name).startsWith(QStringLiteral("unknown")), name);
            QVERIFY(interrupted.line(name).changed);
        }
        QVERIFY(interrupted.text("Tip").contains(QStringLiteral("neither before the loss nor now")));
    }

    void aReportLongBeforeTheLossIsNotHowThingsStood()
    {
        Interrupted old(known(start - InterruptionAccount::beforeLimit - 1ms));
        old.end(known(old.now));
        QVERIFY2(old.text("Tip").contains(QStringLiteral("before the loss")), qPrintable(old.text("Tip")));
        QVERIFY(old.text("Contrast").startsWith(QStringLiteral("unknown")));
        QVERIFY(old.text("Pictures").startsWith(QStringLiteral("unknown")));
    }

    void anInvalidTrackerBeforeTheLossIsUnknown()
    {
        Interrupted one;
        InterruptionAccount& account = one.account;
        one.end(known(one.now));
        QVERIFY(account.acknowledge(one.now + 1s));
        auto blind = known(one.now + 2s);
        blind.tip.reset();
        account.note(blind);
        account.begin(QStringLiteral("Robot link"), one.now + 2s, 0);
        account.end(one.now + 3s);
        account.note(known(one.now + 3s));
        QVERIFY2(one.text("Tip").contains(QStringLiteral("unknown")), qPrintable(one.text("Tip")));
    }

    void whatComesWhileItRunsIsNotHowThingsStoodBefore()
    {
        Interrupted one;
        auto during = known(one.now);
        during.tip->position = {99, 99, 99};
        one.account.note(during);
        auto after = known(one.now);
        after.tip->position = {10, 20, 31};
        one.end(after);
        QVERIFY2(one.text("Tip").startsWith(QStringLiteral("moved 1.0\u00A0mm")), qPrintable(one.text("Tip")));
    }

    void aFurtherLossExtendsTheAccount()
    {
        Interrupted one;
        one.end(known(one.now));
        one.now += 500ms;
        one.account.begin(QStringLiteral("X-ray link"), one.now, 5000);
        QVERIFY(!one.account.acknowledge(one.now + 1h));
        one.now += 2600ms;
        auto after = known(one.now);
        after.tip->position = {10, 20, 32};
        one.end(after);
        QVERIFY(!one.account.readable(one.now + 999ms));
        QCOMPARE(one.account.losses(), 2);
        QCOMPARE(one.account.lasted(), Duration(15s));
        QCOMPARE(one.text("Lost"), QStringLiteral("Robot link, X-ray link"));
        QVERIFY2(one.text("Tip").startsWith(QStringLiteral("moved 2.0\u00A0mm")), qPrintable(one.text("Tip")));
        QVERIFY(accountHeadline(one.account).startsWith(QStringLiteral("2 losses, interrupted for 15.0 s in all, first at ")));
    }

    void theNextAccountBeginsWithWhatWasRead()
    {
        Interrupted one;
        auto moved = known(one.now);
        moved.tip->position = {10, 20, 35};
        one.end(moved);
        QVERIFY(one.account.acknowledge(one.now + 1s));
        moved.robotAt = moved.xrayAt = one.now + 2s;
        one.account.note(moved);
        one.account.begin(QStringLiteral("Robot link"), one.now + 2s, 0);
        one.account.end(one.now + 3s);
        one.account.note(moved);
        QCOMPARE(one.account.losses(), 1);
        QCOMPARE(one.account.lasted(), Duration(1s));
        QVERIFY2(one.text("Tip").startsWith(QStringLiteral("moved 0.0\u00A0mm")), qPrintable(one.text("Tip")));
        QVERIFY(accountHeadline(one.account).startsWith(QStringLiteral("Interrupted for 1.0 s, since ")));
    }

    void manyLossesStayOneAccountOfBoundedSize()
    {
        Interrupted one;
        for (int i = 0; i < 1000; ++i) {
            one.account.begin(QStringLiteral("link %1").arg(i), one.now, 0);
            one.account.end(one.now += 10ms);
        }
        QCOMPARE(one.account.losses(), 1001);
        QVERIFY(one.account.lost().size() <= 8);
        QCOMPARE(accountLines(one.account).size(), std::size_t(8));
    }
};

QTEST_GUILESS_MAIN(TestInterruption)
#include "test_interruption.moc"
