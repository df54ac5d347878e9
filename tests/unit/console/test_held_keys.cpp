// Keys that are known again when they come up, whatever they are called by then.
#include "widgets/held_keys.hpp"

#include <QTest>

#include <optional>

using console::HeldKeys;

namespace {

// Scan codes of X11.
constexpr quint32 deadMan = 40;
constexpr quint32 pedal = 41;
constexpr quint32 padUp = 80;
constexpr quint32 arrowUp = 111;

} // namespace

class TestHeldKeys : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void aKeyComesUpAsItWasPressed_data()
    {
        QTest::addColumn<quint32>("scanCode");
        QTest::addColumn<int>("down");
        QTest::addColumn<int>("up");
        QTest::newRow("same code") << deadMan << int(Qt::Key_D) << int(Qt::Key_D);
        QTest::newRow("AltGr held") << deadMan << int(Qt::Key_D) << int(Qt::Key_ETH);
        QTest::newRow("another layout") << pedal << int(Qt::Key_F) << 0x410;
        QTest::newRow("Num Lock on") << padUp << int(Qt::Key_Up) << int(Qt::Key_8);
        QTest::newRow("no scan code") << quint32(0) << int(Qt::Key_D) << int(Qt::Key_D);
    }

    void aKeyComesUpAsItWasPressed()
    {
        QFETCH(quint32, scanCode);
        QFETCH(int, down);
        QFETCH(int, up);
        HeldKeys keys;
        QVERIFY(!keys.press(scanCode, down));
        QCOMPARE(keys.release(scanCode, up), QList<int>{down});
        QCOMPARE(keys.release(scanCode, up), QList<int>{up}); // it is up, and told all the same
    }

    void keysThatAreHeldBesideItStay()
    {
        HeldKeys keys;
        keys.press(deadMan, Qt::Key_D);
        keys.press(pedal, Qt::Key_F);
        keys.press(padUp, Qt::Key_8);
        QCOMPARE(keys.release(padUp, Qt::Key_Up), QList<int>{Qt::Key_8});
        // Another key that is called D by now, and one whose press nobody heard.
        keys.press(43, Qt::Key_H);
        QCOMPARE(keys.release(43, Qt::Key_D), QList<int>{Qt::Key_H});
        QCOMPARE(keys.release(96, Qt::Key_F12), QList<int>{Qt::Key_F12});
        QCOMPARE(keys.release(deadMan, Qt::Key_ETH), QList<int>{Qt::Key_D});
        QCOMPARE(keys.release(pedal, Qt::Key_F), QList<int>{Qt::Key_F});
    }

    void withoutScanCodesOthersThatWereHeardLetGoOfNothing()
    {
        HeldKeys keys;
        keys.press(0, Qt::Key_D);
        keys.press(0, Qt::Key_F9);
        QCOMPARE(keys.release(0, Qt::Key_F9), QList<int>{Qt::Key_F9});
        QCOMPARE(keys.release(0, Qt::Key_D), QList<int>{Qt::Key_D});
    }

    /// It may have been the dead-man.
    void withoutScanCodesAnUnknownOneLetsGoOfAll()
    {
        HeldKeys keys;
        keys.press(pedal, Qt::Key_F);
        keys.press(0, Qt::Key_D);
        keys.press(0, Qt::Key_Up);
        QCOMPARE(keys.release(0, Qt::Key_ETH), (QList<int>{Qt::Key_Up, Qt::Key_D, Qt::Key_F, Qt::Key_ETH})); // motion before pictures
        QCOMPARE(keys.release(0, Qt::Key_Q), QList<int>{Qt::Key_Q});
    }

    /// Pressed by a program that types without scan codes, let go of by the keyboard, or the other way round.
    void whatHasAScanCodeOnOneWayOnlyIsLetGo()
    {
        HeldKeys keys;
        keys.press(deadMan, Qt::Key_D);
        QCOMPARE(keys.release(0, Qt::Key_D), QList<int>{Qt::Key_D});
        keys.press(0, Qt::Key_D);
        QCOMPARE(keys.release(deadMan, Qt::Key_D), QList<int>{Qt::Key_D});
        keys.press(0, Qt::Key_D);
        QCOMPARE(keys.release(deadMan, Qt::Key_ETH), (QList<int>{Qt::Key_D, Qt::Key_ETH}));
    }

    /// The motion that both ask for ends with the first one, as it would for a code alone.
    void twoKeysOfOneCodeAreTwo()
    {
        HeldKeys keys;
        keys.press(padUp, Qt::Key_Up);
        keys.press(arrowUp, Qt::Key_Up);
        QCOMPARE(keys.release(arrowUp, Qt::Key_Up), QList<int>{Qt::Key_Up});
        QCOMPARE(keys.release(padUp, Qt::Key_8), QList<int>{Qt::Key_Up});
    }

    void aPressOfWhatIsHeldAsAnotherCodeTellsOfThatOne()
    {
        HeldKeys keys;
        QVERIFY(!keys.press(deadMan, Qt::Key_D));
        QVERIFY(!keys.press(deadMan, Qt::Key_D)); // asked of several widgets
        QCOMPARE(keys.press(deadMan, Qt::Key_ETH), std::optional<int>(Qt::Key_D));
        QCOMPARE(keys.release(deadMan, Qt::Key_D), QList<int>{Qt::Key_ETH});
    }

    void whatWasClearedIsHeldNoLonger()
    {
        HeldKeys keys;
        keys.press(deadMan, Qt::Key_D);
        keys.clear();
        QVERIFY(!keys.press(deadMan, Qt::Key_ETH));
        QCOMPARE(keys.release(deadMan, Qt::Key_D), QList<int>{Qt::Key_ETH});
    }
};

QTEST_GUILESS_MAIN(TestHeldKeys)
#include "test_held_keys.moc"
