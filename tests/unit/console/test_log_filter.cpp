// Filtering of the logs and what is written into a file.
#include "model/alarm_log_model.hpp"
#include "model/event_log.hpp"
#include "model/log_filter.hpp"
#include "model/log_moments.hpp"
#include "model/log_roles.hpp"

#include <QAbstractItemModelTester>
#include <QTest>

using namespace console;

namespace {

constexpr qint64 noon = 1'772'452'800'000; // 2026-03-02T12:00:00Z

void fill(EventLog& log)
{
    log.append(LogKind::Note, QStringLiteral("alarm log: /tmp/a"), noon);
    log.append(LogKind::Link, QStringLiteral("Robot: open"), noon + 1);
    log.append(LogKind::Trouble, QStringLiteral("Robot: lost"), noon + 2);
    log.append(LogKind::Permit, QStringLiteral("READY -> ARMING"), noon + 3);
}

QStringList texts(const LogFilter& filter)
{
    QStringList all;
    for (int row = 0; row < filter.rowCount(); ++row)
        all << filter.index(row, 0).data(LogTextRole).toString();
    return all;
}

} // namespace

class TestLogFilter : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void kindsAndWordsNarrowTheLog()
    {
        EventLog log;
        LogFilter filter;
        const QAbstractItemModelTester tester(&filter, QAbstractItemModelTester::FailureReportingMode::QtTest);
        filter.setSourceModel(&log);
        fill(log);
        QCOMPARE(filter.rowCount(), 4);
        filter.setKinds({int(LogKind::Link), int(LogKind::Trouble)});
        QCOMPARE(texts(filter), (QStringList{QStringLiteral("Robot: open"), QStringLiteral("Robot: lost")}));
        filter.setWords(QStringLiteral("LOST"));
        QCOMPARE(texts(filter), QStringList{QStringLiteral("Robot: lost")});
        filter.setKinds({});
        filter.setWords(QStringLiteral(".*"));
        QCOMPARE(filter.rowCount(), 0); // words, no pattern
        filter.setWords({});
        QCOMPARE(filter.rowCount(), 4);
    }

    /// The wall clock goes back by an hour between the second line and the third.
    void theNewestLineUntilAMomentIsFoundWhateverTheWallClockSays()
    {
        const Instant start = std::chrono::steady_clock::now();
        const auto at = [start](int seconds) { return start + std::chrono::seconds(seconds); };
        EventLog log;
        LogFilter filter;
        filter.setSourceModel(&log);
        QVERIFY(!newestLineUntil(filter, start).isValid());
        log.append(LogKind::Note, QStringLiteral("one"), noon, at(1));
        log.append(LogKind::Link, QStringLiteral("two"), noon + 1000, at(2));
        log.append(LogKind::Note, QStringLiteral("three"), noon + 2000 - 3'600'000, at(3));
        const auto textAt = [&](Instant moment) { return newestLineUntil(filter, moment).data(LogTextRole).toString(); };
        QVERIFY(!newestLineUntil(filter, at(1) - std::chrono::nanoseconds(1)).isValid());
        QCOMPARE(textAt(at(1)), QStringLiteral("one"));
        QCOMPARE(textAt(at(3) - std::chrono::nanoseconds(1)), QStringLiteral("two"));
        QCOMPARE(textAt(at(3)), QStringLiteral("three"));
        QCOMPARE(textAt(at(99)), QStringLiteral("three"));
        filter.setKinds({int(LogKind::Note)});
        QCOMPARE(textAt(at(2)), QStringLiteral("one"));
        QCOMPARE(momentOf(filter.index(1, 0)), std::optional<Instant>(at(3)));
        QCOMPARE(momentOf({}), std::nullopt);
    }

    void alarmsOfEarlierRunsHaveNoMomentAndComeBeforeAll()
    {
        AlarmList alarms;
        const AlarmLogModel model(alarms);
        const Instant start = std::chrono::steady_clock::now();
        alarms.restoreLog({{noon + 5000, AlarmPriority::High, QStringLiteral("raised: then")}});
        alarms.note(noon, QStringLiteral("console started."), start);
        alarms.update({{AlarmCondition::ForceStop, 0, AlarmPriority::High, true, QStringLiteral("FORCE"), {}}},
                      start + std::chrono::seconds(1), noon + 1000);
        QCOMPARE(momentOf(model.index(0, 0)), std::nullopt);
        QCOMPARE(momentOf(model.index(2, 0)), std::optional<Instant>(start + std::chrono::seconds(1)));
        QCOMPARE(newestLineUntil(model, start - std::chrono::seconds(1)).row(), 0);
        QCOMPARE(newestLineUntil(model, start).row(), 1);
    }

    void newLinesPassTheFilterToo()
    {
        EventLog log(3);
        LogFilter filter;
        filter.setSourceModel(&log);
        filter.setKinds({int(LogKind::Trouble)});
        for (int i = 0; i < 10; ++i)
            log.append(i % 2 == 0 ? LogKind::Trouble : LogKind::Note, QString::number(i), noon);
        QCOMPARE(texts(filter), QStringList{QStringLiteral("8")}); // 7, 8 and 9 are kept
    }

    void alarmLogFollowsItsList()
    {
        AlarmList alarms;
        AlarmLogModel model(alarms);
        const QAbstractItemModelTester tester(&model, QAbstractItemModelTester::FailureReportingMode::QtTest);
        alarms.note(noon + 5, QStringLiteral("now"));
        alarms.restoreLog({{noon, AlarmPriority::High, QStringLiteral("yesterday")}});
        QCOMPARE(model.rowCount(), 2);
        QCOMPARE(model.index(0).data(LogTextRole).toString(), QStringLiteral("yesterday"));
        QCOMPARE(model.index(0).data(LogKindWordRole).toString(), QStringLiteral("high"));
    }

    void alarmLogStaysAsBoundedAsItsList()
    {
        AlarmList alarms;
        const AlarmLogModel model(alarms);
        for (std::size_t i = 0; i < 3 * AlarmList::logLimit; ++i)
            alarms.note(noon, QString::number(i));
        QCOMPARE(model.rowCount(), int(AlarmList::logLimit));
        QCOMPARE(model.rowCount(), int(alarms.log().size()));
        QCOMPARE(model.index(model.rowCount() - 1).data(LogTextRole).toString(), alarms.log().back().text);
        QCOMPARE(model.index(0).data(LogTextRole).toString(), alarms.log().front().text);
    }

    void fileSaysWhatItIsAndWhatWasLeftOut()
    {
        EventLog log;
        fill(log);
        LogFilter filter;
        filter.setSourceModel(&log);
        filter.setKinds({int(LogKind::Link), int(LogKind::Trouble)});
        filter.setWords(QStringLiteral("robot"));
        QCOMPARE(QString::fromUtf8(logText(filter, QStringLiteral("event log of this run"), noon + 60'000)),
                 QStringLiteral("# LiENa console, event log of this run, written 2026-03-02T12:01:00.000Z\n"
                                "# 2 of 4 lines\n"
                                "# kinds: link, trouble\n"
                                "# with the words: robot\n"
                                "2026-03-02T12:00:00.001Z\tlink\tRobot: open\n"
                                "2026-03-02T12:00:00.002Z\ttrouble\tRobot: lost\n"));
    }

    void aNameFromAPeerMakesNoLineOfItsOwn()
    {
        EventLog log;
        log.append(LogKind::Link, QStringLiteral("evil\n2026-01-01T00:00:00.000Z\toperator\tall well\r\u2028x"), noon);
        LogFilter filter;
        filter.setSourceModel(&log);
        const QByteArray text = logText(filter, QStringLiteral("log"), noon);
        QCOMPARE(text.count('\n'), 3);
        QCOMPARE(text.count('\t'), 2);
        QVERIFY(!text.contains('\r') && !text.contains("\xE2\x80\xA8"));
    }

    void anEmptyLogIsAFileOfItsHead()
    {
        EventLog log;
        LogFilter filter;
        filter.setSourceModel(&log);
        filter.setKinds({int(LogKind::Alarm)});
        const QByteArray text = logText(filter, QStringLiteral("log"), noon);
        QVERIFY2(text.contains("# 0 of 0 lines\n# kinds: of the chosen kinds there is none\n"), text.constData());
    }
};

QTEST_GUILESS_MAIN(TestLogFilter)
#include "test_log_filter.moc"
