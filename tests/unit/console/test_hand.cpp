// The surgeon's hand: keys, scale, recordings.
#include "input/hand_scale.hpp"
#include "input/keyboard_master.hpp"
#include "input/recorded_master.hpp"

#include <QSignalSpy>
#include <QTest>

#include <limits>

using namespace console;
using namespace std::chrono_literals;

namespace {

const Instant start = Instant{} + 1h;
const QString header = QStringLiteral("time,x,y,z,buttons\n");

} // namespace

class TestHand : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void deadManLastsWhileItsKeyIsDown()
    {
        KeyboardMaster master;
        master.setListening(true);
        QSignalSpy changes(&master, &KeyboardMaster::deadManChanged);
        QVERIFY(master.press(Qt::Key_D));
        QVERIFY(master.read(start).deadMan);
        QVERIFY(master.release(Qt::Key_D));
        QVERIFY(!master.read(start).deadMan);
        QCOMPARE(changes.size(), 2);
    }

    void autoRepeatIsNeitherPressNorRelease()
    {
        KeyboardMaster master;
        master.setListening(true);
        QSignalSpy deadMan(&master, &KeyboardMaster::deadManChanged);
        QSignalSpy arm(&master, &KeyboardMaster::armHeldChanged);
        QSignalSpy scale(&master, &KeyboardMaster::scaleStepRequested);
        master.press(Qt::Key_D, true);
        master.press(Qt::Key_R, true);
        master.press(Qt::Key_Up, true);
        master.press(Qt::Key_PageUp, true);
        QVERIFY(!master.read(start).deadMan);
        QVERIFY(master.read(start).motion.isZero());
        QCOMPARE(deadMan.size() + arm.size() + scale.size(), 0);
        master.press(Qt::Key_D);
        master.release(Qt::Key_D, true);
        QVERIFY(master.read(start).deadMan);
        master.press(Qt::Key_D);
        QCOMPARE(deadMan.size(), 1);
    }

    void lostKeyboardCountsAsReleased()
    {
        KeyboardMaster master;
        master.setListening(true);
        QSignalSpy deadMan(&master, &KeyboardMaster::deadManChanged);
        QSignalSpy arm(&master, &KeyboardMaster::armHeldChanged);
        QSignalSpy pedal(&master, &KeyboardMaster::pedalChanged);
        for (const int key : {Qt::Key_D, Qt::Key_R, Qt::Key_F, Qt::Key_Up})
            master.press(key);
        master.setListening(false);
        const auto reading = master.read(start);
        QVERIFY(!reading.alive && !reading.deadMan && reading.motion.isZero());
        for (auto* spy : {&deadMan, &arm, &pedal}) {
            QCOMPARE(spy->size(), 2);
            QCOMPARE(spy->last().first().toBool(), false);
        }
        // A key that stayed down counts only when it is pressed again.
        master.setListening(true);
        QVERIFY(!master.read(start).deadMan);
        master.press(Qt::Key_D, true);
        QVERIFY(!master.read(start).deadMan);
    }

    /// A repeat begins no hold, and what ends it is always told.
    void resetOfTheStopLastsWhileItsKeyIsDown()
    {
        KeyboardMaster master;
        QSignalSpy reset(&master, &KeyboardMaster::resetHeldChanged);
        QVERIFY(!master.press(Qt::Key_U)); // nobody's keys are heard
        master.setListening(true);
        master.press(Qt::Key_U, true); // held since before
        QCOMPARE(reset.size(), 0);
        master.press(Qt::Key_U);
        master.press(Qt::Key_U, true);
        QCOMPARE(reset.size(), 1);
        QVERIFY(reset.last().first().toBool());
        master.rezero(start);
        master.release(Qt::Key_U);
        QCOMPARE(reset.size(), 2);
        QVERIFY(!reset.last().first().toBool());
        master.press(Qt::Key_U);
        master.setListening(false);
        QCOMPARE(reset.size(), 4);
        QVERIFY(!reset.last().first().toBool());
    }

    void hearsNothingWithoutTheKeyboard()
    {
        KeyboardMaster master;
        QVERIFY(!master.press(Qt::Key_D));
        QVERIFY(!master.read(start).deadMan);
    }

    void leavesSpaceAndEnterAlone_data()
    {
        QTest::addColumn<int>("key");
        for (const auto key : {Qt::Key_Space, Qt::Key_Return, Qt::Key_Enter, Qt::Key_Escape, Qt::Key_Tab, Qt::Key_F1})
            QTest::addRow("key %x", key) << int(key);
    }

    void leavesSpaceAndEnterAlone()
    {
        QFETCH(int, key);
        KeyboardMaster master;
        master.setListening(true);
        QVERIFY(!master.press(key));
        QVERIFY(!master.release(key));
    }

    void keysMoveWhatTheySay_data()
    {
        QTest::addColumn<int>("key");
        QTest::addColumn<QVector<double>>("signs");
        QTest::newRow("up") << int(Qt::Key_Up) << QVector<double>{1, 0, 0, 0};
        QTest::newRow("down") << int(Qt::Key_Down) << QVector<double>{-1, 0, 0, 0};
        QTest::newRow("right") << int(Qt::Key_Right) << QVector<double>{0, 1, 0, 0};
        QTest::newRow("left") << int(Qt::Key_Left) << QVector<double>{0, -1, 0, 0};
        QTest::newRow("I") << int(Qt::Key_I) << QVector<double>{0, 0, 1, 0};
        QTest::newRow("K") << int(Qt::Key_K) << QVector<double>{0, 0, -1, 0};
        QTest::newRow("L") << int(Qt::Key_L) << QVector<double>{0, 0, 0, 1};
        QTest::newRow("J") << int(Qt::Key_J) << QVector<double>{0, 0, 0, -1};
    }

    void keysMoveWhatTheySay()
    {
        QFETCH(int, key);
        QFETCH(QVector<double>, signs);
        KeyboardMaster master;
        master.setListening(true);
        master.press(key);
        const auto m = master.read(start).motion;
        const auto sign = [](double value) { return double(value > 0) - double(value < 0); };
        const QVector<double> seen{sign(m.guidewireVelocity), sign(m.guidewireRotation), sign(m.catheterVelocity),
                                   sign(m.catheterRotation)};
        QCOMPARE(seen, signs);
    }

    void oppositeKeysMoveNothing()
    {
        KeyboardMaster master;
        master.setListening(true);
        master.press(Qt::Key_Up);
        master.press(Qt::Key_Down);
        QVERIFY(master.read(start).motion.isZero());
    }

    void keyHeldBeforeTheEngageDoesNotMove()
    {
        KeyboardMaster master;
        master.setListening(true);
        master.press(Qt::Key_Up);
        master.press(Qt::Key_D);
        master.rezero(start);
        QVERIFY(master.read(start).deadMan);
        QVERIFY(master.read(start).motion.isZero());
        master.press(Qt::Key_Up, true);
        QVERIFY(master.read(start).motion.isZero());
        master.press(Qt::Key_Up);
        QVERIFY(!master.read(start).motion.isZero());
    }

    void motionNeedsDeadManAndNoClutch()
    {
        const HandMotion hand{10, 0, 5, 0};
        QVERIFY(askedMotion(hand, 1, false, false).isZero());
        QVERIFY(askedMotion(hand, 1, true, true).isZero());
        QCOMPARE(askedMotion(hand, 0.5, true, false).guidewireVelocity, 5.0);
    }

    void motionStaysWithinTheRobotsBounds()
    {
        const auto most = limited({1e9, -1e9, 41, 361});
        QCOMPARE(most, (HandMotion{40, -720, 40, 360}));
        const double none = std::numeric_limits<double>::quiet_NaN();
        const double endless = std::numeric_limits<double>::infinity();
        QVERIFY(limited({none, endless, -endless, none}).isZero());
    }

    void scaleIsNeverRaisedWhileEngaged()
    {
        QCOMPARE(nextScale(1.0, 1.5, false), 1.5);
        QCOMPARE(nextScale(1.0, 1.5, true), 1.0);
        QCOMPARE(nextScale(1.0, 0.5, true), 0.5);
        QCOMPARE(nextScale(1.0, 99, false), largestScale);
        QCOMPARE(nextScale(1.0, -1, false), smallestScale);
        QCOMPARE(nextScale(1.0, std::numeric_limits<double>::quiet_NaN(), false), 1.0);
    }

    void whereTheHandWasWhileItDidNotCountDoesNotMatter()
    {
        PositionTracker tracker;
        QCOMPARE(tracker.velocity({5, 0, 0}, start)[0], 0.0);
        QCOMPARE(tracker.velocity({6, 0, 0}, start + 100ms)[0], 10.0);
        tracker.rezero();
        QCOMPARE(tracker.velocity({900, 0, 0}, start + 200ms)[0], 0.0);
        QCOMPARE(tracker.velocity({900, 0, 1}, start + 300ms)[2], 10.0);
        QCOMPARE(tracker.velocity({900, 0, 9}, start + 300ms)[2], 0.0); // no time, no speed
    }

    void playsARecordingFromTheEngage()
    {
        QString error;
        const auto samples =
            readRecording(header + QStringLiteral("0,0,0,0,1\n1,0,0,10,1\n2,0,0,10,3\n3,0,0,20,3\n"), QStringLiteral("a.csv"), &error);
        QVERIFY2(samples.has_value(), qPrintable(error));
        RecordedMaster master(*samples);
        QVERIFY(master.read(start).motion.isZero());
        master.rezero(start + 5s);
        QVERIFY(master.read(start + 5s).motion.isZero());
        QCOMPARE(master.read(start + 5s + 500ms).motion.guidewireVelocity, 10.0);
        master.read(start + 7s);
        const auto clutched = master.read(start + 7s + 500ms);
        QVERIFY(clutched.clutch && clutched.motion.isZero());
        QVERIFY(master.read(start + 9s).motion.isZero()); // from the beginning again, without a jump
        QCOMPARE(master.length(), Duration(3s));
    }

    void refusesARecordingThatIsWrong_data()
    {
        QTest::addColumn<QString>("text");
        QTest::addColumn<QString>("place");
        QTest::newRow("empty") << QString() << QStringLiteral("a.csv:1:1:");
        QTest::newRow("other header") << QStringLiteral("t,x\n") << QStringLiteral("a.csv:1:1:");
        QTest::newRow("one sample") << header + QStringLiteral("0,0,0,0,0\n") << QStringLiteral("two samples");
        QTest::newRow("four values") << header + QStringLiteral("0,0,0,0\n") << QStringLiteral("a.csv:2:1:");
        QTest::newRow("a word") << header + QStringLiteral("0,0,zero,0,0\n") << QStringLiteral("a.csv:2:5: 'zero'");
        QTest::newRow("not finite") << header + QStringLiteral("0,inf,0,0,0\n") << QStringLiteral("a.csv:2:3:");
        QTest::newRow("negative buttons") << header + QStringLiteral("0,0,0,0,-1\n") << QStringLiteral("a.csv:2:9:");
        QTest::newRow("time stands") << header + QStringLiteral("0,0,0,0,0\n0,0,0,0,0\n") << QStringLiteral("a.csv:3:1:");
        QTest::newRow("time starts late") << header + QStringLiteral("1,0,0,0,0\n2,0,0,0,0\n") << QStringLiteral("a.csv:2:1:");
    }

    void refusesARecordingThatIsWrong()
    {
        QFETCH(QString, text);
        QFETCH(QString, place);
        QString error;
        QVERIFY(!readRecording(text, QStringLiteral("a.csv"), &error));
        QVERIFY2(error.contains(place), qPrintable(error));
    }

    void readsTheRecordingThatComesWithTheProject()
    {
        QString error;
        const auto samples = RecordedMaster::load(QStringLiteral(LIENA_SOURCE_DIR "/resources/recordings/jog.csv"), &error);
        QVERIFY2(samples.size() > 100, qPrintable(error));
        RecordedMaster master(samples);
        master.rezero(start);
        double fastest = 0;
        for (auto at = 0ms; at < master.length(); at += 10ms)
            fastest = std::max(fastest, std::abs(master.read(start + at).motion.guidewireVelocity));
        QVERIFY2(fastest > 3 && fastest < 20, qPrintable(QString::number(fastest)));
        QVERIFY(RecordedMaster::load(QStringLiteral("/no/such/file.csv"), &error).empty());
        QVERIFY(error.contains(QStringLiteral("/no/such/file.csv")));
    }
};

QTEST_GUILESS_MAIN(TestHand)
#include "test_hand.moc"
