// When a periodic run of the comparison was due.
#include "measure/due_grid.hpp"

#include <QTest>

using namespace liena::compare;

class DueGridTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void lateRunWasDueOnTheGrid()
    {
        using std::chrono::milliseconds;
        DueGrid grid(milliseconds(2));
        const Instant start{milliseconds(1000)};
        QVERIFY(grid.due(start) == start);
        QVERIFY(grid.due(start + milliseconds(3)) == start + milliseconds(2)); // 1 ms late
        QVERIFY(grid.due(start + milliseconds(4)) == start + milliseconds(4)); // and the next in time again
    }

    void gridBeginsAnewAfterMoreThanAPeriod()
    {
        using std::chrono::milliseconds;
        DueGrid grid(milliseconds(2));
        const Instant start{milliseconds(1000)};
        (void)grid.due(start);
        QVERIFY(grid.due(start + milliseconds(9)) == start + milliseconds(2)); // 7 ms late: told, not hidden
        QVERIFY(grid.due(start + milliseconds(9)) == start + milliseconds(9)); // at once, as every() does
        QVERIFY(grid.due(start + milliseconds(11)) == start + milliseconds(11));
    }
};

QTEST_APPLESS_MAIN(DueGridTest)
#include "due_grid_test.moc"
