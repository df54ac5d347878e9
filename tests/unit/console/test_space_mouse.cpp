// A 3-D mouse through libspnav itself and a daemon that the test plays.
#include "fake_spacenavd.hpp"
#include "input/space_mouse_master.hpp"

#include <QSignalSpy>
#include <QTest>

using namespace console;
using namespace console::test;
using namespace std::chrono_literals;

namespace {

constexpr int patience = 10000;
constexpr int dead = 0;
constexpr int clutch = 1;

/// A mouse on a daemon; polled as the loop does, on a clock of the test's own.
struct Mouse {
    FakeSpacenavd daemon;
    std::unique_ptr<SpaceMouseMaster> master;
    Instant now = Instant{} + 1h;

    explicit Mouse(int protocol = 1, bool plugged = true, bool plugWhileAsked = false) : daemon(protocol)
    {
        daemon.mousePlugged = plugged;
        daemon.plugWhileAsked = plugWhileAsked;
        daemon.begin();
        master = std::make_unique<SpaceMouseMaster>();
        master->setListening(true);
    }

    void turn(Duration time = 10ms)
    {
        now += time;
        master->poll(now);
    }

    MasterLife life()
    {
        turn();
        return master->life(now);
    }

    MasterReading read()
    {
        turn();
        return master->read(now);
    }

    bool becomes(MasterLife wanted)
    {
        return QTest::qWaitFor([&] { return life() == wanted; }, patience);
    }

    /// Holds the dead-man, and pushes the cap away.
    bool moves()
    {
        daemon.button(dead, true);
        daemon.push(0, 0, 350);
        return QTest::qWaitFor([&] { return read().deadMan && read().motion.guidewireVelocity > 0; }, patience);
    }
};

} // namespace

class TestSpaceMouse : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void capMovesWhatItSays_data()
    {
        QTest::addColumn<QVector<int>>("cap");
        QTest::addColumn<QVector<double>>("signs");
        QTest::newRow("push") << QVector<int>{0, 0, 300, 0, 0, 0} << QVector<double>{1, 0, 0, 0};
        QTest::newRow("pull") << QVector<int>{0, 0, -300, 0, 0, 0} << QVector<double>{-1, 0, 0, 0};
        QTest::newRow("twist clockwise") << QVector<int>{0, 0, 0, 0, -300, 0} << QVector<double>{0, 1, 0, 0};
        QTest::newRow("lift") << QVector<int>{0, 300, 0, 0, 0, 0} << QVector<double>{0, 0, 1, 0};
        QTest::newRow("tilt right") << QVector<int>{0, 0, 0, 0, 0, 300} << QVector<double>{0, 0, 0, 1};
        QTest::newRow("push, and tilt a little") << QVector<int>{40, -60, 300, 90, 0, 60} << QVector<double>{1, 0, 0, 0};
        QTest::newRow("sideways moves nothing") << QVector<int>{350, 0, 0, 350, 0, 0} << QVector<double>{0, 0, 0, 0};
        QTest::newRow("the weight of a hand") << QVector<int>{0, -30, 20, 0, 10, 10} << QVector<double>{0, 0, 0, 0};
    }

    void capMovesWhatItSays()
    {
        QFETCH(QVector<int>, cap);
        QFETCH(QVector<double>, signs);
        Mouse mouse;
        QVERIFY(mouse.becomes(MasterLife::Alive));
        mouse.daemon.push(cap[0], cap[1], cap[2], cap[3], cap[4], cap[5]);
        mouse.daemon.button(dead, true); // told after the motion
        QTRY_VERIFY_WITH_TIMEOUT(mouse.read().deadMan, patience);
        const auto m = mouse.read().motion;
        const auto sign = [](double v) { return double(v > 0) - double(v < 0); };
        QCOMPARE(
            (QVector<double>{sign(m.guidewireVelocity), sign(m.guidewireRotation), sign(m.catheterVelocity), sign(m.catheterRotation)}),
            signs);
    }

    void buttonsAreDeadManAndClutch()
    {
        Mouse mouse;
        QVERIFY(mouse.becomes(MasterLife::Alive));
        QSignalSpy changes(mouse.master.get(), &MasterDevice::deadManChanged);
        mouse.daemon.button(dead, true);
        mouse.daemon.button(clutch, true);
        QTRY_VERIFY_WITH_TIMEOUT(mouse.read().deadMan && mouse.read().clutch, patience);
        mouse.daemon.button(dead, false);
        QTRY_VERIFY_WITH_TIMEOUT(!mouse.read().deadMan, patience);
        QCOMPARE(changes.size(), 2);
    }

    void aDeflectionThatIsNotToldAgainEnds()
    {
        Mouse mouse;
        QVERIFY(mouse.becomes(MasterLife::Alive));
        QVERIFY(mouse.moves());
        for (auto past = 0ms; past <= SpaceMouseMaster::deflectionLasts; past += 10ms)
            mouse.turn();
        QVERIFY(mouse.read().motion.isZero());
        QVERIFY(mouse.read().alive && mouse.read().deadMan);
        mouse.daemon.push(0, 0, 350);
        QTRY_VERIFY_WITH_TIMEOUT(!mouse.read().motion.isZero(), patience);
    }

    void aDeflectionAtTheEngageDoesNotMoveEvenWhenItIsOld()
    {
        Mouse mouse;
        QVERIFY(mouse.becomes(MasterLife::Alive));
        QVERIFY(mouse.moves());
        for (int i = 0; i < 40; ++i)
            mouse.turn();
        mouse.master->rezero(mouse.now);
        QSignalSpy counted(mouse.master.get(), &MasterDevice::deadManChanged);
        mouse.daemon.push(0, 0, 350);
        mouse.daemon.button(dead, false);
        QTRY_COMPARE_WITH_TIMEOUT(counted.size(), 1, patience); // so the push was heard, too
        QVERIFY(mouse.read().motion.isZero());
        mouse.daemon.push(0, 0, 0);
        mouse.daemon.push(0, 0, 350);
        QTRY_VERIFY_WITH_TIMEOUT(!mouse.read().motion.isZero(), patience);
    }

    void anUnpluggedMouseIsGone()
    {
        Mouse mouse;
        QVERIFY(mouse.becomes(MasterLife::Alive));
        QVERIFY(mouse.moves());
        QSignalSpy life(mouse.master.get(), &MasterDevice::lifeChanged);
        mouse.daemon.plug(false);
        QTRY_VERIFY_WITH_TIMEOUT(life.size() > 0, patience);
        QVERIFY(mouse.becomes(MasterLife::Gone));
        QVERIFY(!mouse.read().alive && !mouse.read().deadMan && mouse.read().motion.isZero());
        QTRY_VERIFY_WITH_TIMEOUT(mouse.daemon.connections() == 2 && mouse.daemon.hasClient(), patience);
        QCOMPARE(mouse.life(), MasterLife::Gone);
        mouse.daemon.plug(true);
        QVERIFY(mouse.becomes(MasterLife::Alive));
        QVERIFY(!mouse.read().deadMan); // its button was held before it went, and that counts no more
    }

    void aDaemonThatEndsTakesTheMouseWithIt()
    {
        Mouse mouse;
        QVERIFY(mouse.becomes(MasterLife::Alive));
        QVERIFY(mouse.moves());
        mouse.daemon.end();
        QVERIFY(mouse.becomes(MasterLife::Gone));
        QVERIFY(!mouse.read().deadMan && mouse.read().motion.isZero());
        QVERIFY(mouse.daemon.begin());
        QVERIFY(mouse.becomes(MasterLife::Alive));
    }

    void aBrokenEventEndsTheLine()
    {
        Mouse mouse;
        QVERIFY(mouse.becomes(MasterLife::Alive));
        QVERIFY(mouse.moves());
        QSignalSpy life(mouse.master.get(), &MasterDevice::lifeChanged);
        mouse.daemon.sendBytes(QByteArray(20, '\x55'));
        QTRY_VERIFY_WITH_TIMEOUT(life.size() > 0, patience);
        QVERIFY(mouse.read().motion.isZero());
    }

    void whatIsNoEventMovesNothing()
    {
        Mouse mouse;
        QVERIFY(mouse.becomes(MasterLife::Alive));
        mouse.daemon.send({-5, 350, 350, 350, 350, 350, 350, 350});
        mouse.daemon.send({0x7fffffff, 350, 350, 350, 350, 350, 350, 350});
        mouse.daemon.button(77, true);
        mouse.daemon.button(-1, true);
        mouse.daemon.button(clutch, true);
        QTRY_VERIFY_WITH_TIMEOUT(mouse.read().clutch, patience);
        QVERIFY(mouse.read().motion.isZero() && !mouse.read().deadMan);
    }

    void withoutADaemonThereIsNoMouse()
    {
        qputenv("SPNAV_SOCKET", "/no/such/socket");
        SpaceMouseMaster master;
        master.poll(Instant{} + 1h);
        QCOMPARE(master.life(Instant{} + 1h), MasterLife::Gone);
    }

    void aDaemonWithoutAMouseIsWaitedFor()
    {
        Mouse mouse(1, false);
        QTRY_VERIFY_WITH_TIMEOUT(mouse.daemon.hasClient(), patience);
        QCOMPARE(mouse.life(), MasterLife::Gone);
        mouse.daemon.plug(true);
        QVERIFY(mouse.becomes(MasterLife::Alive));
    }

    void aMouseThatComesWhileTheLineOpensIsFound()
    {
        Mouse mouse(1, false, true);
        QVERIFY(mouse.becomes(MasterLife::Alive));
        QCOMPARE(mouse.daemon.connections(), 2);
    }

    void anOldDaemonIsRefusedAndSaid()
    {
        Mouse mouse(0);
        QTRY_VERIFY_WITH_TIMEOUT(mouse.master->note().contains(QStringLiteral("too old")), patience);
        QCOMPARE(mouse.life(), MasterLife::Gone);
    }

    void aLineThatEndsWhileItOpensLeavesNothingBehind()
    {
        Mouse first(0);
        QTRY_VERIFY_WITH_TIMEOUT(first.daemon.hasClient(), patience);
        first.master.reset();
        QTRY_VERIFY_WITH_TIMEOUT(!first.daemon.hasClient(), patience);
        Mouse second;
        QVERIFY(second.becomes(MasterLife::Alive));
    }

    void openingDoesNotHoldUpThisThread()
    {
        Mouse mouse(0); // the library waits for an answer that does not come
        QTRY_VERIFY_WITH_TIMEOUT(mouse.daemon.hasClient(), patience);
        int turns = 0;
        QTimer clock;
        QObject::connect(&clock, &QTimer::timeout, &clock, [&turns] { ++turns; });
        clock.start(1);
        QTRY_VERIFY_WITH_TIMEOUT(!mouse.master->note().isEmpty(), patience);
        QVERIFY2(turns > 3, qPrintable(QString::number(turns)));
    }
};

QTEST_GUILESS_MAIN(TestSpaceMouse)
#include "test_space_mouse.moc"
