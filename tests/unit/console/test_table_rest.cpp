// Tests of since when the table stood where a picture shows the patient.
#include "model/table_rest.hpp"

#include <QTest>

#include <limits>

using namespace console;
using namespace std::chrono_literals;

namespace {

const Instant start = Instant() + 1h;

std::array<double, 3> at(double longitudinal) { return {0, longitudinal, 900}; }

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
    }
};

QTEST_GUILESS_MAIN(TestTableRest)
#include "test_table_rest.moc"
