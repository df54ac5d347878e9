// The alarm self-test: in order, never confirmed unseen, and it gives way to a real alarm.
#include "model/alarm_self_test.hpp"

#include <QTest>

using namespace console;
using namespace std::chrono_literals;
using Step = AlarmSelfTest::Step;

namespace {

const Instant start = Instant{} + 1h;

Instant runToQuestion(AlarmSelfTest& test, Instant now)
{
    test.begin(now);
    for (int i = 0; i < 70; ++i)
        test.update(false, now += 100ms);
    return now;
}

} // namespace

class TestAlarmSelfTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void showsEachPriorityInTurnAndThenAsks()
    {
        AlarmSelfTest test;
        std::vector<std::optional<AlarmPriority>> seen;
        connect(&test, &AlarmSelfTest::changed, this, [&] { seen.push_back(test.signal()); });
        runToQuestion(test, start);
        QVERIFY((seen ==
                 std::vector<std::optional<AlarmPriority>>{AlarmPriority::High, AlarmPriority::Medium, AlarmPriority::Low, std::nullopt}));
        QCOMPARE(test.step(), Step::Asking);
        test.confirm();
        QVERIFY(test.passed());
    }

    void nobodyConfirmsWhatWasNotShown()
    {
        AlarmSelfTest test;
        test.confirm();
        QVERIFY(!test.passed());
        test.begin(start);
        test.confirm();
        QCOMPARE(test.step(), Step::High);
    }

    void refusedIsNotPassedAndCanBeRepeated()
    {
        AlarmSelfTest test;
        const auto now = runToQuestion(test, start);
        test.refuse();
        QCOMPARE(test.step(), Step::Failed);
        test.confirm();
        QVERIFY(!test.passed());
        runToQuestion(test, now);
        test.confirm();
        QVERIFY(test.passed());
    }

    void givesWayToAHighAlarm_data()
    {
        QTest::addColumn<int>("after");
        QTest::newRow("while it shows") << 10;
        QTest::newRow("while it asks") << 100;
    }

    void givesWayToAHighAlarm()
    {
        QFETCH(int, after);
        AlarmSelfTest test;
        test.begin(start);
        for (int i = 0; i < after; ++i)
            test.update(false, start + i * 100ms);
        QVERIFY(test.running());
        test.update(true, start + after * 100ms);
        QCOMPARE(test.step(), Step::NotDone);
        QVERIFY(!test.signal());
    }

    void passedStaysPassedThroughAHighAlarm()
    {
        AlarmSelfTest test;
        const auto now = runToQuestion(test, start);
        test.confirm();
        test.update(true, now + 1min);
        test.begin(now + 1min);
        test.refuse();
        QVERIFY(test.passed());
    }

    void armingUsesItUp()
    {
        AlarmSelfTest test;
        auto now = runToQuestion(test, start);
        test.confirm();
        test.follow(PermitPhase::Ready, now);
        test.follow(PermitPhase::Arming, now);
        QVERIFY(test.passed());
        test.follow(PermitPhase::Armed, now);
        QCOMPARE(test.step(), Step::InUse);
        QVERIFY(!test.passed());
        test.follow(PermitPhase::Engaged, now);
        test.follow(PermitPhase::Armed, now);
        test.begin(now); // no test while instruments may move
        QCOMPARE(test.step(), Step::InUse);
        test.follow(PermitPhase::Hold, now);
        QCOMPARE(test.step(), Step::NotDone);
        test.begin(now);
        QVERIFY(test.running());
    }

    void everyWayOutOfArmedAsksAnew_data()
    {
        QTest::addColumn<int>("phase");
        for (const auto phase : {PermitPhase::Ready, PermitPhase::Hold, PermitPhase::Incident, PermitPhase::Off})
            QTest::newRow(qPrintable(word(phase))) << int(phase);
    }

    void everyWayOutOfArmedAsksAnew()
    {
        QFETCH(int, phase);
        AlarmSelfTest test;
        const auto now = runToQuestion(test, start);
        test.confirm();
        test.follow(PermitPhase::Armed, now);
        test.follow(PermitPhase(phase), now);
        QCOMPARE(test.step(), Step::NotDone);
    }

    void aStandByMakesItVoid()
    {
        AlarmSelfTest test;
        const auto now = runToQuestion(test, start);
        test.confirm();
        test.follow(PermitPhase::Standby, now);
        QVERIFY(test.passed());
        test.follow(PermitPhase::Incident, now);
        QCOMPARE(test.step(), Step::NotDone);
    }

    void unusedItLastsTenMinutes()
    {
        AlarmSelfTest test;
        test.begin(start);
        auto now = start;
        while (test.step() != Step::Asking)
            test.update(false, now += 100ms);
        test.confirm();
        test.update(false, now + AlarmSelfTest::validity - 1ms);
        QVERIFY(test.passed());
        test.update(false, now + AlarmSelfTest::validity);
        QCOMPARE(test.step(), Step::NotDone);
    }

    void nobodyVouchesForWhatSoundedLongAgo()
    {
        AlarmSelfTest test;
        const auto now = runToQuestion(test, start);
        test.update(false, now + AlarmSelfTest::answerTime);
        QCOMPARE(test.step(), Step::NotDone);
        test.confirm();
        QVERIFY(!test.passed());
        QCOMPARE(test.passedInAll(), 0);
    }

    void theFirstIsWholeAndThoseAfterItAreBrief()
    {
        AlarmSelfTest test;
        const auto timeToQuestion = [&test](Instant from) {
            auto now = from;
            for (test.begin(from); test.step() != Step::Asking;)
                test.update(false, now += 100ms);
            return now - from;
        };
        QCOMPARE(Duration(timeToQuestion(start)), Duration(6400ms));
        test.confirm();
        test.follow(PermitPhase::Armed, start + 10s);
        test.follow(PermitPhase::Hold, start + 20s);
        QCOMPARE(Duration(timeToQuestion(start + 30s)), Duration(3300ms));
        test.confirm();
        QCOMPARE(test.passedInAll(), 2);
    }
};

QTEST_GUILESS_MAIN(TestAlarmSelfTest)
#include "test_alarm_self_test.moc"
