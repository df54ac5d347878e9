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

    void passedStaysPassed()
    {
        AlarmSelfTest test;
        const auto now = runToQuestion(test, start);
        test.confirm();
        test.update(true, now + 1h);
        test.begin(now + 1h);
        test.refuse();
        QVERIFY(test.passed());
    }
};

QTEST_GUILESS_MAIN(TestAlarmSelfTest)
#include "test_alarm_self_test.moc"
