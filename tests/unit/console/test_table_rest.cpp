// Tests of where the table stood in a picture, and since when.
#include "model/table_rest.hpp"

#include <QTest>

#include <cmath>
#include <limits>

using namespace console;
using namespace std::chrono_literals;

namespace {

const Instant start = Instant() + 1h;

std::array<double, 3> at(double longitudinal) { return {0, longitudinal, 900}; }

/// Of a picture that takes no time on its way.
std::optional<TableWay> wayAt(const TableRest& rest, Instant moment) { return rest.wayOf(moment, moment); }

} // namespace

class TestTableRest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void isUnknownUntilAReportComesAfterThePicture()
    {
        TableRest rest;
        QVERIFY(!rest.since(start));
        rest.note(at(0), start);
        QVERIFY(!rest.since(start));
        QVERIFY(!rest.since(start + 50ms));
        rest.note(at(0), start + 100ms);
        QVERIFY(rest.since(start + 50ms) == start);
    }

    void nothingBeforeTheFirstReportCounts()
    {
        TableRest rest;
        rest.note(at(0), start);
        QVERIFY(rest.since(start - 50ms) == start);
    }

    void aMovementCountsForPicturesOfBothSides()
    {
        TableRest rest;
        rest.note(at(0), start);
        rest.note(at(0), start + 100ms);
        rest.note(at(5), start + 200ms);
        rest.note(at(5), start + 300ms);
        QVERIFY(rest.since(start + 50ms) == start);          // it was there before the table went
        QVERIFY(rest.since(start + 150ms) == start + 200ms); // perhaps taken while it went
        QVERIFY(rest.since(start + 250ms) == start + 200ms);
    }

    void aTableThatCreepsMoves()
    {
        TableRest rest;
        for (int report = 0; report <= 3; ++report)
            rest.note(at(0.06 * report), start + report * 100ms);
        QVERIFY(rest.since(start + 250ms) == start + 200ms);
    }

    void aPlaceThatIsNoNumberIsAnother()
    {
        TableRest rest;
        rest.note(at(0), start);
        rest.note(at(std::numeric_limits<double>::quiet_NaN()), start + 100ms);
        rest.note(at(0), start + 200ms);
        rest.note(at(0), start + 300ms);
        QVERIFY(rest.since(start + 250ms) == start + 200ms);
    }

    void whatIsForgottenIsNotTakenForRest()
    {
        TableRest rest;
        const int reports = int(TableRest::movementsKept) + 6;
        for (int report = 0; report < reports; ++report)
            rest.note(at(report), start + report * 100ms);
        QVERIFY(rest.since(start + 350ms) == Instant::max());
        QVERIFY(rest.since(start + (reports - 1) * 100ms - 50ms) == start + (reports - 1) * 100ms);
        QVERIFY(std::isnan(wayAt(rest, start + 350ms)->to[1]));
        QVERIFY(std::isnan(wayAt(rest, start + 550ms)->from[1])); // where the oldest movement that is kept came from
        QCOMPARE(wayAt(rest, start + 550ms)->to, at(6));
    }

    void saysWhereTheTableWasInAPicture()
    {
        TableRest rest;
        QVERIFY(!wayAt(rest, start));
        rest.note(at(0), start);
        rest.note(at(0), start + 100ms);
        QCOMPARE(wayAt(rest, start + 150ms)->to, at(0)); // no later report yet
        rest.note(at(5), start + 200ms);
        rest.note(at(5), start + 300ms);
        for (const auto early : {-50ms, 50ms, 100ms}) {
            QCOMPARE(wayAt(rest, start + early)->from, at(0));
            QCOMPARE(wayAt(rest, start + early)->to, at(0));
        }
        QCOMPARE(wayAt(rest, start + 150ms)->from, at(0)); // on its way
        QCOMPARE(wayAt(rest, start + 150ms)->to, at(5));
        for (const auto late : {200ms, 250ms, 350ms}) {
            QCOMPARE(wayAt(rest, start + late)->from, at(5));
            QCOMPARE(wayAt(rest, start + late)->to, at(5));
        }
    }

    void aPictureThatIsLateHasTheMovementsOfItsWayInIt()
    {
        TableRest rest;
        for (int report = 0; report <= 4; ++report)
            rest.note(at(report < 2 ? 0 : 5), start + report * 100ms);
        const auto from = [&rest](Duration taken) { return rest.wayOf(start + taken, start + 400ms)->from; };
        for (const auto before : {-50ms, 50ms, 100ms, 150ms})
            QCOMPARE(from(before), at(0));
        QCOMPARE(from(200ms), at(5));
        QCOMPARE(rest.wayOf(start, start + 400ms)->to, at(5));
        QCOMPARE(rest.wayOf(start, start + 100ms)->to, at(0));
    }

    void tellsReportsFromGuesses()
    {
        TableRest rest;
        QVERIFY(!rest.spans(start, start));
        rest.note(at(0), start);
        rest.note(at(0), start + 100ms);
        QVERIFY(rest.spans(start - 500ms, start + 600ms));
        QVERIFY(!rest.spans(start - 501ms, start));
        QVERIFY(!rest.spans(start, start + 601ms));
    }
};

QTEST_GUILESS_MAIN(TestTableRest)
#include "test_table_rest.moc"
