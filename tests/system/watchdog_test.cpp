// The watchdog beside a program that hangs, dies, and ends in order; all of them real processes.
#include "watchdog_ride.hpp"

#include <QTest>

using console::test::Ride;

namespace {

constexpr int patience = 30000;
} // namespace

class WatchdogTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void aHangWhileArmedIsAnAlarmUntilBeatsReturn()
    {
        Ride ride(QStringLiteral("armed"));
        QTRY_VERIFY_WITH_TIMEOUT(ride.says("is watched"), patience);
        ride.send(SIGSTOP);
        QTRY_VERIFY_WITH_TIMEOUT(ride.says("ALARM: the console hangs while armed"), patience);
        ride.send(SIGCONT);
        QTRY_VERIFY_WITH_TIMEOUT(ride.says("beats again"), patience);
        QVERIFY(!Ride::isGone(ride.watchdog()));
    }

    void anArmedDeathIsAnAlarmAndLeavesNoOrphan_data()
    {
        QTest::addColumn<bool>("hungBefore");
        QTest::newRow("killed") << false;
        QTest::newRow("killed while it hung") << true;
    }

    void anArmedDeathIsAnAlarmAndLeavesNoOrphan()
    {
        QFETCH(bool, hungBefore);
        Ride ride(QStringLiteral("armed"));
        QTRY_VERIFY_WITH_TIMEOUT(ride.says("is watched"), patience);
        if (hungBefore) {
            ride.send(SIGSTOP);
            QTRY_VERIFY_WITH_TIMEOUT(ride.says("ALARM: the console hangs"), patience);
        }
        ride.send(SIGKILL);
        QTRY_VERIFY_WITH_TIMEOUT(ride.says("ALARM: the console has ended while armed"), patience);
        QTRY_VERIFY_WITH_TIMEOUT(Ride::isGone(ride.watchdog()), patience);
    }

    void anIdleConsoleDiesInSilence()
    {
        Ride ride(QStringLiteral("idle"));
        QTRY_VERIFY_WITH_TIMEOUT(ride.says("is watched"), patience);
        ride.send(SIGKILL);
        QTRY_VERIFY_WITH_TIMEOUT(Ride::isGone(ride.watchdog()), patience);
        QVERIFY(ride.says("ends with the console"));
        QVERIFY(!ride.says("ALARM"));
    }

    void anArmedConsoleThatGoesInOrderTakesItAlong()
    {
        Ride ride(QStringLiteral("armed"), 3600);
        QTRY_VERIFY_WITH_TIMEOUT(ride.says("is watched"), patience);
        ride.rider().closeWriteChannel();
        QVERIFY(ride.rider().waitForFinished(patience));
        QVERIFY(Ride::isGone(ride.watchdog()));
        QVERIFY(ride.says("ends with the console"));
        QVERIFY(!ride.says("has ended while armed"));
    }

    void aConsoleLearnsThatItsWatchdogDied()
    {
        Ride ride(QStringLiteral("armed"));
        QTRY_VERIFY_WITH_TIMEOUT(ride.says("is watched"), patience);
        ::kill(static_cast<pid_t>(ride.watchdog()), SIGKILL);
        QTRY_VERIFY_WITH_TIMEOUT(ride.says("its watchdog has ended"), patience);
    }

    void aConsoleLearnsThatItsWatchdogHangs()
    {
        Ride ride(QStringLiteral("armed"));
        QTRY_VERIFY_WITH_TIMEOUT(ride.says("is watched"), patience);
        ::kill(static_cast<pid_t>(ride.watchdog()), SIGSTOP);
        QTRY_VERIFY_WITH_TIMEOUT(ride.says("does not answer"), patience);
        ::kill(static_cast<pid_t>(ride.watchdog()), SIGCONT);
    }
};

QTEST_GUILESS_MAIN(WatchdogTest)
#include "watchdog_test.moc"
