// Whether the narrowest place of a path has become wider, by how late pieces are.
#include "tasks/piece_wait.hpp"

#include <QTest>

using liena::tasks::PieceWait;
using namespace std::chrono_literals;
using Nanoseconds = std::chrono::nanoseconds;

namespace {

constexpr Nanoseconds own = 2500us; ///< of a piece at some 9 Mbit/s

/// One piece each 20 ms.
struct Pieces {
    bool wait(Nanoseconds time)
    {
        now += 20ms;
        return pieceWait.isOver(time, own, now);
    }

    /// How often it was over.
    int wait(Nanoseconds time, int pieces)
    {
        int over = 0;
        for (int i = 0; i < pieces; ++i)
            over += wait(time) ? 1 : 0;
        return over;
    }

    PieceWait pieceWait;
    PieceWait::Instant now{1h};
};

} // namespace

class PieceWaitTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void threePiecesThatAreHardlyLateTellOfAWiderPath()
    {
        Pieces pieces;
        QCOMPARE(pieces.wait(2300us, 100), 0);
        QVERIFY(!pieces.wait(400us));
        QVERIFY(!pieces.wait(900us));
        QVERIFY(pieces.wait(300us));
        QCOMPARE(pieces.wait(300us, 200), 0); // once
    }

    void aLittleLessTellsNothing()
    {
        Pieces pieces;
        QCOMPARE(pieces.wait(2300us, 100), 0);
        QCOMPARE(pieces.wait(1300us, 200), 0);
    }

    void whatWasNotLateForASecondIsNotOver()
    {
        Pieces pieces;
        QCOMPARE(pieces.wait(2300us, 40), 0);
        QCOMPARE(pieces.wait(400us, 100), 0);
    }

    /// As where a computer is late now and then: what a piece takes is the least that is seen.
    void aPieceOrTwoThatAreHardlyLateAreChance()
    {
        Pieces pieces;
        QCOMPARE(pieces.wait(2300us, 100), 0);
        QCOMPARE(pieces.wait(400us, 2), 0);
        QCOMPARE(pieces.wait(2300us, 30), 0);
        QCOMPARE(pieces.wait(400us, 20), 0);
        QCOMPARE(pieces.wait(2300us, 100), 0);
        QCOMPARE(pieces.wait(400us, 3), 1); // what was chance is long ago
    }

    /// The bucket is filled between two bursts.
    void beforeATokenBucketNothingIsOver()
    {
        Pieces pieces;
        for (int i = 0; i < 100; ++i) {
            QCOMPARE(pieces.wait(2300us, 12), 0);
            QCOMPARE(pieces.wait(200us, 5), 0);
        }
    }

    /// Late by less than a quarter of what a piece takes at the rate: that was the way's own.
    void whatIsNoPiecesTimeTellsNothing()
    {
        Pieces pieces;
        QCOMPARE(pieces.wait(600us, 100), 0);
        QCOMPARE(pieces.wait(100us, 100), 0);
    }

    /// Standstills may have brought it to a third of what the path carries.
    void aRateThatIsTooLowHearsItAsWell()
    {
        Pieces pieces;
        QCOMPARE(pieces.wait(800us, 100), 0);
        QCOMPARE(pieces.wait(100us, 10), 1);
    }

    void anotherPathIsAnother()
    {
        Pieces pieces;
        QCOMPARE(pieces.wait(2300us, 100), 0);
        pieces.pieceWait.forget();
        QCOMPARE(pieces.wait(400us, 20), 0);
    }
};

QTEST_APPLESS_MAIN(PieceWaitTest)
#include "piece_wait_test.moc"
