// The watchdog beside a program that hangs, dies, and ends in order; all of them real processes.
#include <QFile>
#include <QProcess>
#include <QTemporaryDir>
#include <QTest>

#include <csignal>

namespace {

constexpr int patience = 30000;

/// A rider and its watchdog. Both write to one file, so that the watchdog is heard when the rider is dead.
class Ride {
public:
    explicit Ride(const QString& how, int mourning = 1)
    {
        m_rider.setStandardErrorFile(said());
        m_rider.start(QStringLiteral(LIENA_PROGRAM_DIR "/watchdog_rider"),
                      {QStringLiteral(LIENA_PROGRAM_DIR "/liena-console-watchdog"), how, QString::number(mourning)});
    }

    ~Ride()
    {
        if (m_rider.state() == QProcess::NotRunning)
            return;
        send(SIGCONT);
        m_rider.kill();
        m_rider.waitForFinished();
    }

    QString said() const { return m_folder.filePath(QStringLiteral("said")); }

    bool says(const char* words) const
    {
        QFile file(said());
        return file.open(QIODevice::ReadOnly) && file.readAll().contains(words);
    }

    /// Of the watchdog, as it says itself; 0 before.
    qint64 watchdog() const
    {
        QFile file(said());
        if (!file.open(QIODevice::ReadOnly))
            return 0;
        const auto text = QString::fromUtf8(file.readAll());
        const auto at = text.indexOf(QStringLiteral("process "));
        return at < 0 ? 0 : text.mid(at + 8).section(QLatin1Char('\n'), 0, 0).toLongLong();
    }

    /// Ended, whoever has to collect it.
    static bool isGone(qint64 process)
    {
        QFile file(QStringLiteral("/proc/%1/stat").arg(process));
        return !file.open(QIODevice::ReadOnly) || file.readAll().contains(") Z ");
    }

    void send(int signal) const { ::kill(static_cast<pid_t>(m_rider.processId()), signal); }
    QProcess& rider() { return m_rider; }

private:
    QTemporaryDir m_folder;
    QProcess m_rider;
};

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
