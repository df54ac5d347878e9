// A disk that fills: from what the system says of its room to the alarm, while entries are still kept.
#include "app/alarm_service.hpp"
#include "invented_cockpit.hpp"

#include <QTemporaryDir>
#include <QTest>

#include <atomic>
#include <chrono>

#include <dlfcn.h>
#include <sys/statvfs.h>

using namespace console;
using namespace console::test;
using C = AlarmCondition;

namespace {

std::atomic<qint64> roomLeft{-1}; ///< bytes; below zero: as it is

} // namespace

// Stands before the system's own, which Qt asks.
extern "C" int statvfs64(const char* path, struct statvfs64* about) noexcept
{
    using Ask = int (*)(const char*, struct statvfs64*);
    static const auto ask = reinterpret_cast<Ask>(::dlsym(RTLD_NEXT, "statvfs64"));
    const int result = ask(path, about);
    if (result == 0 && roomLeft >= 0) {
        about->f_bsize = about->f_frsize = 1;
        about->f_bavail = static_cast<fsblkcnt64_t>(roomLeft.load());
    }
    return result;
}

class TestDiskRoom : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void cleanup() { roomLeft = -1; }

    void aDiskThatIsNearlyFullIsAnAlarmWhileEntriesAreKept()
    {
        qputenv("PULSE_SERVER", "unix:/nowhere");
        InventedCockpit cockpit;
        AlarmWatch watch{cockpit.models, robotId};
        const QTemporaryDir folder;
        const AlarmService service(cockpit.models, watch, {folder.path(), QStringLiteral("alarms"), {}});
        const auto raised = [&]() -> const Alarm* {
            watch.update(std::chrono::steady_clock::now(), 0);
            for (const auto& alarm : cockpit.models.alarms.alarms())
                if (alarm.condition == C::RecorderStopped && alarm.present)
                    return &alarm;
            return nullptr;
        };
        const auto note = [&cockpit] { cockpit.models.alarms.note(1, QStringLiteral("an entry")); };
        note();
        QTRY_VERIFY(cockpit.models.recorder.logKept);
        QVERIFY(!raised());
        roomLeft = 10 * 1024 * 1024;
        note();
        QTRY_VERIFY(raised() != nullptr);
        QCOMPARE(raised()->priority, AlarmPriority::Low);
        QVERIFY2(raised()->text.contains(QStringLiteral("nearly full, 10 MB left")), qPrintable(raised()->text));
        QVERIFY(raised()->latching);
        QVERIFY(cockpit.models.recorder.logKept);
        roomLeft = -1;
        note();
        QTRY_VERIFY(!raised());
    }

    /// By whatever else writes there, in a quiet procedure; and when somebody has made room again.
    void aDiskThatFillsIsToldOfThoughNothingIsWritten()
    {
        const QTemporaryDir folder;
        const AlarmJournal journal(folder.path(), QStringLiteral("alarms"), std::chrono::milliseconds(20));
        QCOMPARE(journal.trouble(), QString());
        roomLeft = 10 * 1024 * 1024;
        QTRY_VERIFY(journal.trouble().contains(QStringLiteral("nearly full, 10 MB left")));
        QVERIFY(journal.keeps());
        roomLeft = -1;
        QTRY_COMPARE(journal.trouble(), QString());
    }
};

QTEST_GUILESS_MAIN(TestDiskRoom)
#include "test_disk_room.moc"
