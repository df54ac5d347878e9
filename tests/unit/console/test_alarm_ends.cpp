// When alarms end: what trembles at its limit is one alarm, what an event ends has ended with it, and nothing new waits.
#include "alarm_cases.hpp"

#include <QSignalSpy>
#include <QTest>

using namespace console;
using console::test::alarmCases;
using namespace std::chrono_literals;
using C = AlarmCondition;

namespace {

constexpr auto High = AlarmPriority::High, Medium = AlarmPriority::Medium, Low = AlarmPriority::Low;
constexpr auto turn = 100ms;

AlarmReport report(C condition, AlarmPriority priority, bool latching = false, quint64 causes = 0)
{
    return {condition, 0, priority, latching, QStringLiteral("text"), QStringLiteral("remedy"), 0, causes};
}

/// A list that is told what is there ten times a second.
struct Told {
    AlarmList list;
    QSignalSpy raised{&list, &AlarmList::raised};
    Instant now = Instant{} + 1h;

    void tell(const std::vector<AlarmReport>& reports)
    {
        list.update(reports, now, 0);
        now += turn;
    }

    void tell(const std::vector<AlarmReport>& reports, Duration time)
    {
        for (Duration passed{}; passed < time; passed += turn)
            tell(reports);
    }

    void acknowledge() { list.acknowledge(list.highest()->id, 0); }
};

} // namespace

class TestAlarmEnds : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void whatTremblesIsOneAlarmAndStaysAcknowledged_data()
    {
        QTest::addColumn<bool>("latching");
        QTest::newRow("a force at the warning") << false;
        QTest::newRow("a drive at its temperature") << true;
    }

    void whatTremblesIsOneAlarmAndStaysAcknowledged()
    {
        QFETCH(bool, latching);
        const auto there = report(latching ? C::DriveFault : C::ForceWarn, latching ? High : Medium, latching);
        Told told;
        told.tell({there});
        told.acknowledge();
        const auto id = told.list.highest()->id;
        for (int i = 0; i < 50; ++i) {
            told.tell({});
            told.tell({there});
            QCOMPARE(told.list.highest()->id, id);
            QVERIFY(told.list.highest()->acknowledged && told.list.highest()->present);
        }
        told.tell({}, 2s);
        QVERIFY(!told.list.alarms().empty());
        told.tell({});
        QVERIFY(told.list.alarms().empty());
        QCOMPARE(told.raised.count(), 1);
        QCOMPARE(told.list.log().size(), std::size_t(3)); // raised, acknowledged, ended
        told.tell({there});
        QVERIFY(!told.list.highest()->acknowledged); // it had ended, and is news
    }

    void whatEndsLatchedStaysUntilItIsAcknowledged()
    {
        Told told;
        told.tell({report(C::ForceStop, High, true)});
        told.tell({}, 2s);
        QVERIFY(told.list.highest()->present);
        told.tell({});
        QVERIFY(!told.list.highest()->present && told.list.unacknowledgedHigh());
        told.tell({report(C::ForceStop, High, true)});
        QCOMPARE(told.raised.count(), 2); // at once, and anew
    }

    void whatHasEndedSaysWhen()
    {
        AlarmList list;
        const auto lost = report(C::LinkLost, High, true);
        const Instant start = Instant{} + 1h;
        list.update({lost}, start, 1000);
        list.update({}, start + 1s, 2000);
        QCOMPARE(list.highest()->endedWallMs, qint64(2000));
        list.update({}, start + 2s, 3000); // it ended once
        QCOMPARE(list.highest()->endedWallMs, qint64(2000));
        QCOMPARE(list.log().back().wallMs, qint64(2000));
        list.update({lost}, start + 3s, 4000);
        QVERIFY(list.highest()->present);
        QCOMPARE(list.alarms().size(), std::size_t(1));
    }

    /// Also when nobody has seen the one, and somebody the other: the band's words are of now. Of another priority it is that which counts.
    void whatIsThereStandsBeforeWhatHasEndedAndIsAsUrgent()
    {
        AlarmList list;
        const auto conditions = [&list] {
            std::vector<C> all;
            for (const Alarm& alarm : list.alarms())
                all.push_back(alarm.condition);
            return all;
        };
        const auto lost = report(C::LinkLost, High, true);
        const auto fault = report(C::DriveFault, High, true);
        const auto force = report(C::ForceWarn, Medium, false);
        const Instant start = Instant{} + 1h;
        list.update({fault, force}, start, 0);
        list.acknowledge(list.highest()->id, 0);
        list.update({fault, force, lost}, start + 1s, 0);
        QCOMPARE(list.highest()->condition, C::LinkLost); // newer, and not acknowledged
        list.update({fault, force}, start + 2s, 0);
        const std::vector wanted{C::DriveFault, C::LinkLost, C::ForceWarn};
        QVERIFY(conditions() == wanted);
        QVERIFY(list.highest()->acknowledged && !list.alarms()[1].acknowledged);
        QVERIFY(list.unacknowledgedHigh()); // none that was missed is lost
    }

    /// Acknowledged while its end is awaited: it goes with its end, and not before.
    void whatIsAcknowledgedWithinTheDelayIsNoNewAlarmWhenItComesBack()
    {
        Told told;
        told.tell({report(C::ForceStop, High, true)});
        told.tell({}, 1s);
        told.acknowledge();
        told.tell({report(C::ForceStop, High, true)});
        QCOMPARE(told.raised.count(), 1);
        QVERIFY(told.list.highest()->acknowledged);
    }

    void whatIsMoreUrgentOrHasAnotherCauseDoesNotWait()
    {
        Told told;
        told.tell({report(C::DriveFault, Medium, true, 1)});
        told.acknowledge();
        told.tell({}, 1s);
        told.tell({report(C::DriveFault, Medium, true, 4)});
        QVERIFY(!told.list.highest()->acknowledged);
        told.acknowledge();
        told.tell({}, 1s);
        told.tell({report(C::DriveFault, High, true, 4)});
        QVERIFY(!told.list.highest()->acknowledged);
        QCOMPARE(told.list.highest()->priority, High);
        QCOMPARE(told.raised.count(), 3);
    }

    void aPriorityThatTremblesStaysAcknowledged()
    {
        Told told;
        told.tell({report(C::CommandRoundTrip, Medium)});
        told.acknowledge();
        for (int i = 0; i < 50; ++i) {
            told.tell({report(C::CommandRoundTrip, Low)});
            told.tell({report(C::CommandRoundTrip, Medium)});
        }
        QCOMPARE(told.raised.count(), 1);
        told.tell({report(C::CommandRoundTrip, Low)}, 2s);
        QCOMPARE(told.list.highest()->priority, Medium);
        told.tell({report(C::CommandRoundTrip, Low)});
        QCOMPARE(told.list.highest()->priority, Low);
    }

    void aCauseThatTremblesStaysAcknowledged_data()
    {
        QTest::addColumn<quint64>("otherwise");
        QTest::newRow("beside another") << quint64(1);
        QTest::newRow("in turn with another") << quint64(2);
    }

    void aCauseThatTremblesStaysAcknowledged()
    {
        QFETCH(quint64, otherwise);
        const quint64 most = otherwise == 1 ? 3 : 1;
        Told told;
        told.tell({report(C::SoftLimit, Low, false, otherwise)});
        told.tell({report(C::SoftLimit, Low, false, most)});
        told.acknowledge();
        QCOMPARE(told.raised.count(), 2);
        for (int i = 0; i < 5; ++i) {
            told.tell({report(C::SoftLimit, Low, false, otherwise)});
            told.tell({report(C::SoftLimit, Low, false, most)});
        }
        QCOMPARE(told.raised.count(), 2);
        told.tell({report(C::SoftLimit, Low, false, otherwise)}, 3s); // the other has gone
        told.tell({report(C::SoftLimit, Low, false, most)});
        QCOMPARE(told.raised.count(), 3);
    }

    /// After each of these the next one is another: a link that is lost again, a stop that is pressed again.
    void whatAnEventEndsHasEndedWithIt_data()
    {
        QTest::addColumn<int>("condition");
        QTest::newRow("link") << int(C::LinkLost);
        QTest::newRow("picture link") << int(C::ImageLost);
        QTest::newRow("hold") << int(C::HoldNotConfirmed);
        QTest::newRow("stop") << int(C::EmergencyStop);
        QTest::newRow("stop unheard") << int(C::StopUnheard);
    }

    void whatAnEventEndsHasEndedWithIt()
    {
        QFETCH(int, condition);
        Told told;
        told.tell({report(C(condition), High, true)});
        told.acknowledge();
        told.tell({});
        QVERIFY(told.list.alarms().empty());
        told.tell({report(C(condition), High, true)});
        QVERIFY(told.list.unacknowledgedHigh());
        QCOMPARE(told.raised.count(), 2);
    }

    void noneIsRaisedLate_data()
    {
        QTest::addColumn<int>("condition");
        for (const auto& one : alarmCases())
            QTest::newRow(one.name) << int(one.condition);
    }

    void noneIsRaisedLate()
    {
        QFETCH(int, condition);
        Told told;
        told.tell({report(C(condition), Medium)});
        QCOMPARE(told.raised.count(), 1);
        told.tell({}, 3s);
        QVERIFY(told.list.alarms().empty());
        told.tell({report(C(condition), Medium)});
        QCOMPARE(told.raised.count(), 2);
    }

    /// Nobody arms beside a high alarm that is seen and heard; to acknowledge it is enough.
    void aHighAlarmCountsUntilItHasEndedOrIsAcknowledged()
    {
        Told told;
        told.tell({report(C::PictureStale, High)});
        told.tell({}, 2s);
        QVERIFY(told.list.unacknowledgedHigh());
        told.tell({});
        QVERIFY(!told.list.unacknowledgedHigh());
        told.tell({report(C::PictureStale, High)});
        told.tell({});
        told.acknowledge();
        QVERIFY(!told.list.unacknowledgedHigh());
    }
};

QTEST_GUILESS_MAIN(TestAlarmEnds)
#include "test_alarm_ends.moc"
