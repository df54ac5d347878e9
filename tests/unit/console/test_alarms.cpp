// Alarms: the rules of the table, latching, acknowledging, and the log.
#include "alarm_cases.hpp"

#include <QFile>
#include <QMap>
#include <QSignalSpy>
#include <QTest>

#include <algorithm>

using namespace console;
using console::test::alarmCases;
using console::test::calmReadings;
using namespace std::chrono_literals;

namespace {

const Instant start = Instant{} + 1h;

/// The cells of each row of the table in docs/ALARMS.md, by the name in the first.
QMap<QString, QStringList> documentedAlarms()
{
    QFile file(QStringLiteral(LIENA_SOURCE_DIR "/docs/ALARMS.md"));
    QMap<QString, QStringList> rows;
    if (!file.open(QIODevice::ReadOnly))
        return rows;
    constexpr int cells = 7;
    for (const QString& line : QString::fromUtf8(file.readAll()).split(QLatin1Char('\n'))) {
        auto row = line.split(QLatin1Char('|'));
        if (row.size() != cells + 2)
            continue;
        row = row.mid(1, cells);
        std::transform(row.begin(), row.end(), row.begin(), [](const QString& cell) { return cell.trimmed(); });
        rows.insert(row.front(), row.mid(1));
    }
    return rows;
}

QString priorityWord(std::optional<AlarmPriority> priority)
{
    if (!priority)
        return QStringLiteral("none");
    return *priority == AlarmPriority::High     ? QStringLiteral("high")
           : *priority == AlarmPriority::Medium ? QStringLiteral("medium")
                                                : QStringLiteral("low");
}

/// Of IEC 60601-1-8, table 1: by what happens when nobody answers, and how soon.
QString priorityOf(const QString& harm, const QString& onset)
{
    static const QStringList onsets{QStringLiteral("immediate"), QStringLiteral("prompt"), QStringLiteral("delayed")};
    static const QMap<QString, QStringList> table{
        {QStringLiteral("irreversible"), {QStringLiteral("high"), QStringLiteral("high"), QStringLiteral("medium")}},
        {QStringLiteral("reversible"), {QStringLiteral("high"), QStringLiteral("medium"), QStringLiteral("low")}},
        {QStringLiteral("minor"), {QStringLiteral("medium"), QStringLiteral("low"), QStringLiteral("low")}}};
    return table.value(harm).value(onsets.indexOf(onset));
}

AlarmReport report(AlarmCondition condition, AlarmPriority priority, bool latching)
{
    return {condition, 0, priority, latching, QStringLiteral("text"), QStringLiteral("remedy")};
}

} // namespace

class TestAlarms : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void anAcknowledgedAlarmThatFallsAndRisesDemandsAttentionAnew()
    {
        AlarmList list;
        const auto urgent = report(AlarmCondition::CommandRoundTrip, AlarmPriority::Medium, false);
        const auto cautious = report(AlarmCondition::CommandRoundTrip, AlarmPriority::Low, false);
        list.update({urgent}, start, 0);
        list.acknowledge(list.highest()->id, 0);
        list.update({cautious}, start, 0);
        list.update({cautious}, start + 2s, 0);
        QCOMPARE(list.highest()->priority, AlarmPriority::Low);
        QVERIFY(list.highest()->acknowledged);
        list.update({urgent}, start + 2s, 0);
        QCOMPARE(list.highest()->priority, AlarmPriority::Medium);
        QVERIFY(!list.highest()->acknowledged);
    }

    void aSecondCauseDemandsAttentionAnew()
    {
        auto readings = calmReadings();
        readings.armed = true;
        AlarmList list;
        const auto at = [&](quint16 switches) {
            readings.limitSwitches = switches;
            list.update(presentAlarms(readings), start, 0);
            return list.highest();
        };
        const auto* first = at(GuidewireSoftHigh);
        QVERIFY(first != nullptr);
        const auto condition = first->condition;
        list.acknowledge(first->id, 0);
        QVERIFY(at(GuidewireSoftHigh)->acknowledged);
        const auto* second = at(GuidewireSoftHigh | CatheterSoftLow);
        QCOMPARE(second->condition, condition);
        QVERIFY(!second->acknowledged);
    }

    void eachIsDocumentedAsItIs()
    {
        auto documented = documentedAlarms();
        for (const auto& one : alarmCases()) {
            const auto row = documented.take(QString::fromLatin1(one.name));
            QVERIFY2(row.size() == 6, one.name);
            const QStringList expected{priorityWord(one.armed), priorityWord(one.otherwise),
                                       one.latching ? QStringLiteral("yes") : QStringLiteral("no"),
                                       endDelay(one.condition) == 0s ? QStringLiteral("at once") : QStringLiteral("after 2 s")};
            QCOMPARE(row.mid(0, 4), expected);
            QVERIFY2(priorityOf(row[4], row[5]) == row[0], one.name); // and it has the priority that it was reckoned to have
        }
        QStringList left = documented.keys();
        left.removeAll(QStringLiteral("condition"));
        left.removeIf([](const QString& name) { return name.startsWith(QLatin1String("---")); });
        QVERIFY2(left.isEmpty(), qPrintable(left.join(QLatin1Char(','))));
    }

    void aDriveIsToldOfWhateverTheRobotStoppedForBefore()
    {
        for (const quint16 code : std::initializer_list<quint16>{0, 1, 4, 5}) {
            auto readings = calmReadings();
            readings.faultCode = code;
            readings.drivesHealthy = false;
            const auto present = presentAlarms(readings);
            QVERIFY(std::any_of(present.begin(), present.end(),
                                [](const AlarmReport& one) { return one.condition == AlarmCondition::DriveFault; }));
        }
    }

    void fluoroscopySignalsWithEveryFiveMinutesAndNotBefore_data()
    {
        QTest::addColumn<double>("seconds");
        QTest::addColumn<QString>("told");
        const auto reached = [](int minutes) { return QStringLiteral("Fluoroscopy has reached %1 min").arg(minutes); };
        QTest::newRow("just below") << 299.9 << QString();
        QTest::newRow("five minutes") << 300.0 << reached(5);
        QTest::newRow("just below ten") << 599.9 << reached(5);
        QTest::newRow("ten minutes") << 600.0 << reached(10);
    }

    void fluoroscopySignalsWithEveryFiveMinutesAndNotBefore()
    {
        QFETCH(double, seconds);
        QFETCH(QString, told);
        auto readings = calmReadings();
        readings.fluoroscopyTime = seconds;
        const auto present = presentAlarms(readings);
        QCOMPARE(present.empty() ? QString() : present.front().text, told);
    }

    void theNextFiveMinutesDemandAttentionAnew()
    {
        auto readings = calmReadings();
        AlarmList list;
        const auto at = [&](double seconds) {
            readings.fluoroscopyTime = seconds;
            list.update(presentAlarms(readings), start, 0);
            return list.highest();
        };
        list.acknowledge(at(300)->id, 0);
        QVERIFY(at(599)->acknowledged);
        QVERIFY(!at(600)->acknowledged);
    }

    void overdueReportsHaveTheirTitles_data()
    {
        QTest::addColumn<QString>("message");
        QTest::addColumn<QString>("text");
        QTest::newRow("tip") << QStringLiteral("TipPose") << QStringLiteral("Vascular robot: position of the tip overdue");
        QTest::newRow("dose") << QStringLiteral("AcquisitionStatus") << QStringLiteral("Vascular robot: report of beam and dose overdue");
        QTest::newRow("another set's") << QStringLiteral("PumpFlow") << QStringLiteral("Vascular robot: PumpFlow overdue");
    }

    void overdueReportsHaveTheirTitles()
    {
        QFETCH(QString, message);
        QFETCH(QString, text);
        auto readings = calmReadings();
        readings.links[0].title = QStringLiteral("Vascular robot");
        readings.links[0].deadlineMissed = message;
        QCOMPARE(presentAlarms(readings).front().text, text);
    }

    void calmRaisesNothing()
    {
        QVERIFY(presentAlarms(calmReadings()).empty());
        auto armed = calmReadings();
        armed.armed = armed.engaged = true;
        QVERIFY(presentAlarms(armed).empty());
        armed.awaitingHold = 200ms;
        QVERIFY(presentAlarms(armed).empty());
        armed.picture.condition = PictureCondition::Held;
        QVERIFY(presentAlarms(armed).empty());
        armed.picture.reduction = {6, 15, 15, PixelEncoding::Jpeg, 75};
        QVERIFY(presentAlarms(armed).empty()); // nothing is expected; the held picture says it
        armed.picture.condition = PictureCondition::Live;
        armed.picture.reduction = {2, 15, 15, PixelEncoding::JpegLs, 0};
        QVERIFY(presentAlarms(armed).empty()); // not one pixel differs
    }

    void conditionsHaveThePrioritiesOfTheTable_data()
    {
        QTest::addColumn<int>("number");
        for (int number = 0; number < int(alarmCases().size()); ++number)
            QTest::newRow(alarmCases().at(std::size_t(number)).name) << number;
    }

    void conditionsHaveThePrioritiesOfTheTable()
    {
        QFETCH(int, number);
        const auto& one = alarmCases().at(std::size_t(number));
        auto readings = calmReadings();
        one.change(readings);
        auto present = presentAlarms(readings);
        QCOMPARE(present.size(), std::size_t(one.otherwise ? 1 : 0));
        if (one.otherwise)
            QCOMPARE(present.front().priority, *one.otherwise);
        readings.armed = readings.engaged = true;
        present = presentAlarms(readings);
        QCOMPARE(present.size(), std::size_t(1));
        QCOMPARE(present.front().condition, one.condition);
        QCOMPARE(present.front().priority, one.armed);
        QCOMPARE(present.front().latching, one.latching);
        QVERIFY(!present.front().text.isEmpty() && present.front().remedy.endsWith(QLatin1Char('.')));
    }

    void latchedAlarmStaysUntilAcknowledged()
    {
        AlarmList list;
        list.update({report(AlarmCondition::LinkLost, AlarmPriority::High, true)}, start, 0);
        QVERIFY(list.unacknowledgedHigh());
        list.update({}, start, 1);
        QCOMPARE(list.alarms().size(), std::size_t(1));
        QVERIFY(!list.highest()->present);
        QVERIFY(list.unacknowledgedHigh());
        list.acknowledge(list.highest()->id, 2);
        QVERIFY(list.alarms().empty());
    }

    void alarmThatDoesNotLatchEndsByItself()
    {
        AlarmList list;
        list.update({report(AlarmCondition::PictureStale, AlarmPriority::High, false)}, start, 0);
        list.update({}, start, 1);
        list.update({}, start + 2s, 1);
        QVERIFY(list.alarms().empty());
        QCOMPARE(list.log().size(), std::size_t(2));
    }

    void acknowledgedAlarmSoundsAgainWhenItReturnsOrGrows()
    {
        AlarmList list;
        QSignalSpy raised(&list, &AlarmList::raised);
        const auto low = report(AlarmCondition::DriveFault, AlarmPriority::Medium, true);
        list.update({low}, start, 0);
        list.acknowledge(list.highest()->id, 0);
        QVERIFY(!list.highest()->demandsAttention());
        list.update({low}, start, 0);
        QVERIFY(!list.highest()->demandsAttention());
        list.update({report(AlarmCondition::DriveFault, AlarmPriority::High, true)}, start, 0);
        QVERIFY(list.highest()->demandsAttention());
        list.acknowledge(list.highest()->id, 0);
        list.update({}, start, 0);
        list.update({}, start + 2s, 0);
        list.update({low}, start + 2s, 0);
        QVERIFY(list.highest()->demandsAttention());
        QCOMPARE(raised.size(), 3);
    }

    void showsTheHighestFirst()
    {
        AlarmList list;
        list.update({report(AlarmCondition::SoftLimit, AlarmPriority::Low, false),
                     report(AlarmCondition::LinkLost, AlarmPriority::High, true),
                     report(AlarmCondition::ForceWarn, AlarmPriority::Medium, false)},
                    start, 0);
        QCOMPARE(list.alarms()[0].priority, AlarmPriority::High);
        QCOMPARE(list.alarms()[1].priority, AlarmPriority::Medium);
        QCOMPARE(list.alarms()[2].priority, AlarmPriority::Low);
        QCOMPARE(list.count(AlarmPriority::Medium), 1);
    }

    void newHighAlarmEndsTheAudioPause()
    {
        AlarmList list;
        list.pauseAudio(start);
        QCOMPARE(*list.audioPauseLeft(start + 20s), Duration(40s));
        QVERIFY(!list.audioPauseLeft(start + 60s));
        list.update({report(AlarmCondition::ForceWarn, AlarmPriority::Medium, false)}, start, 0);
        QVERIFY(list.audioPauseLeft(start));
        list.update({report(AlarmCondition::ForceStop, AlarmPriority::High, false)}, start, 0);
        QVERIFY(!list.audioPauseLeft(start));
    }

    /// However a pause ended. Who is armed may begin the next one only then.
    void soundIsAudibleForLongTenSecondsAfterAPause()
    {
        AlarmList list;
        const auto since = [&list](Instant end) { return !list.audibleForLong(end + 9999ms) && list.audibleForLong(end + 10s); };
        QVERIFY(list.audibleForLong(start)); // there was none
        list.pauseAudio(start);
        QVERIFY(!list.audibleForLong(start) && !list.audibleForLong(start + 59s));
        QVERIFY(since(start + 60s)); // it ended by itself
        QCOMPARE(list.audibleForLongIn(start + 63s), Duration(7s));
        list.resumeAudio(start + 20s, 0);
        QVERIFY(since(start + 20s));
        list.pauseAudio(start + 100s);
        list.update({report(AlarmCondition::ForceStop, AlarmPriority::High, false)}, start + 105s, 0);
        QVERIFY(since(start + 105s));
        list.update({report(AlarmCondition::LinkLost, AlarmPriority::High, true)}, start + 200s, 0);
        list.resumeAudio(start + 200s, 0);
        QVERIFY(list.audibleForLong(start + 200s)); // what ends no pause counts for nothing
    }

    void eachFurtherGrayDemandsAttentionAnew()
    {
        AlarmList list;
        auto readings = calmReadings();
        const auto at = [&](double milligrays) {
            readings.airKerma = milligrays;
            list.update(presentAlarms(readings), start, 0);
            return list.alarms().size() == 1 && list.highest()->demandsAttention();
        };
        QVERIFY(at(3000));
        list.acknowledge(list.highest()->id, 0);
        QVERIFY(!at(3999));
        QVERIFY(at(4000));
        list.acknowledge(list.highest()->id, 0);
        QVERIFY(at(5000));
        QCOMPARE(list.highest()->priority, AlarmPriority::Medium);
        QVERIFY(at(1e300)); // whatever a device sends, it stays one alarm
        QVERIFY(at(6000));
    }

    void aRoundTripOfAClosedLinkIsNoAlarm()
    {
        auto readings = calmReadings();
        readings.armed = true;
        readings.links[0].commandRoundTrip = 900ms;
        readings.links[0].state = LinkState::Closed;
        QVERIFY(presentAlarms(readings).empty());
    }

    void logTellsWhoAcknowledged()
    {
        AlarmList list;
        QSignalSpy logged(&list, &AlarmList::logged);
        list.update({report(AlarmCondition::ForceStop, AlarmPriority::High, true)}, start, 0);
        list.acknowledge(list.highest()->id, 7, QStringLiteral("Dr Wu"));
        QCOMPARE(list.log().back().text, QStringLiteral("acknowledged by Dr Wu: text"));
        QCOMPARE(list.log().back().wallMs, qint64(7));
        QCOMPARE(logged.count(), 2);
    }

    void logOfEarlierRunsStandsBeforeThisOne()
    {
        AlarmList list;
        list.note(5, QStringLiteral("now"));
        list.restoreLog({{1, AlarmPriority::High, QStringLiteral("raised: then")}});
        QCOMPARE(list.log().size(), std::size_t(2));
        QCOMPARE(list.log().front().text, QStringLiteral("raised: then"));
    }

    void logIsBounded()
    {
        AlarmList list;
        for (int turn = 0; turn < 1500; ++turn) {
            list.update({report(AlarmCondition::SoundFailed, AlarmPriority::Medium, false)}, start, turn);
            list.update({}, start, turn);
        }
        QCOMPARE(list.log().size(), AlarmList::logLimit);
        QCOMPARE(list.log().back().wallMs, qint64(1499));
    }
};

QTEST_GUILESS_MAIN(TestAlarms)
#include "test_alarms.moc"
