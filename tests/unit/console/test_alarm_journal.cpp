// The alarm log's files: kept, bounded, torn, changed, and a disk that does not take them.
#include "app/alarm_journal.hpp"

#include <QDir>
#include <QFile>
#include <QTemporaryDir>
#include <QTest>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <functional>

#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

using namespace console;

namespace {

/// A disk that takes what is written and does not keep it: so many times from now on.
std::atomic<int> disksFailures = 0;
std::atomic<off_t> kept = 0; ///< bytes of the newest file

} // namespace

/// In the C library's place. As of a kernel that gives up the pages that it could not write: what they held is gone, and is told of once.
extern "C" int fdatasync(int descriptor)
{
    if (disksFailures > 0) {
        --disksFailures;
        if (::ftruncate(descriptor, kept) == 0)
            errno = EIO;
        return -1;
    }
    struct stat file {};
    if (::fstat(descriptor, &file) == 0)
        kept = file.st_size;
    return static_cast<int>(::syscall(SYS_fdatasync, descriptor));
}

namespace {

AlarmLogEntry entry(int number) { return {number, AlarmPriority::Medium, QStringLiteral("raised: \"%1\" \u00B5\n").arg(number)}; }

struct Folder {
    QTemporaryDir place;

    QString file() const { return place.filePath(QStringLiteral("alarms.jsonl")); }

    void write(int first, int last) const
    {
        AlarmJournal journal(place.path(), QStringLiteral("alarms"));
        for (int number = first; number <= last; ++number)
            journal.append(entry(number));
    }

    void change(const std::function<void(QByteArray&)>& how) const
    {
        QFile file(this->file());
        QVERIFY(file.open(QIODevice::ReadWrite));
        auto bytes = file.readAll();
        how(bytes);
        file.resize(0);
        file.seek(0);
        file.write(bytes);
    }
};

} // namespace

class TestAlarmJournal : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void cleanup() { disksFailures = 0; }

    void whatTheDiskTookAndDidNotKeepIsWrittenAgain()
    {
        const Folder folder;
        {
            AlarmJournal journal(folder.place.path(), QStringLiteral("alarms"));
            journal.append(entry(1));
            QTRY_VERIFY(kept > 0);
            disksFailures = 1;
            journal.append(entry(2));
            QTRY_VERIFY(journal.trouble().contains(QStringLiteral("is not kept")));
            QVERIFY(!journal.keeps());
            journal.append(entry(3));
            QTRY_VERIFY(journal.keeps());
        }
        const AlarmJournal journal(folder.place.path(), QStringLiteral("alarms"));
        QCOMPARE(journal.remark(), QString());
        QCOMPARE(journal.restored().size(), std::size_t(3));
        for (std::size_t i = 0; i < 3; ++i)
            QCOMPARE(journal.restored()[i].text, entry(int(i) + 1).text);
    }

    void keepsEveryEntryAndItsText()
    {
        const Folder folder;
        folder.write(1, 3);
        const AlarmJournal journal(folder.place.path(), QStringLiteral("alarms"));
        QCOMPARE(journal.restored().size(), std::size_t(3));
        QCOMPARE(journal.restored()[1].text, entry(2).text);
        QCOMPARE(journal.restored()[1].wallMs, qint64(2));
        QCOMPARE(journal.restored()[1].priority, AlarmPriority::Medium);
        QCOMPARE(journal.remark(), QString());
        QCOMPARE(journal.trouble(), QString());
    }

    void isBoundedAndKeepsTheLastThousand()
    {
        const Folder folder;
        folder.write(1, 4500);
        const AlarmJournal journal(folder.place.path(), QStringLiteral("alarms"));
        QVERIFY(journal.restored().size() >= 1000 && journal.restored().size() <= 2 * AlarmJournal::fileLimit);
        QCOMPARE(journal.restored().back().wallMs, qint64(4500));
        for (std::size_t i = 1; i < journal.restored().size(); ++i)
            QCOMPARE(journal.restored()[i].wallMs, journal.restored()[i - 1].wallMs + 1);
        QCOMPARE(journal.remark(), QString());
        QCOMPARE(QDir(folder.place.path()).entryList({QStringLiteral("*.jsonl")}).size(), 2);
    }

    void linesAsLongAsTheyMayBeLeaveAsMany()
    {
        const Folder folder;
        {
            AlarmJournal journal(folder.place.path(), QStringLiteral("alarms"));
            for (int number = 1; number <= 2100; ++number)
                journal.append({number, AlarmPriority::Medium, QString(3 * alarmLineLimit, QLatin1Char('x'))});
        }
        const AlarmJournal journal(folder.place.path(), QStringLiteral("alarms"));
        QVERIFY2(journal.restored().size() >= AlarmJournal::fileLimit, qPrintable(QString::number(journal.restored().size())));
        QCOMPARE(journal.restored().back().wallMs, qint64(2100));
        QCOMPARE(journal.remark(), QString());
    }

    void aTornLastLineIsToldAndDropped()
    {
        const Folder folder;
        folder.write(1, 3);
        folder.change([](QByteArray& bytes) { bytes.chop(10); });
        {
            AlarmJournal journal(folder.place.path(), QStringLiteral("alarms"));
            QVERIFY2(journal.remark().contains(QStringLiteral("torn")), qPrintable(journal.remark()));
            QCOMPARE(journal.restored().size(), std::size_t(2));
            journal.append(entry(4));
        }
        const AlarmJournal after(folder.place.path(), QStringLiteral("alarms"));
        QCOMPARE(after.remark(), QString());
        QCOMPARE(after.restored().size(), std::size_t(3));
        QCOMPARE(after.restored().back().wallMs, qint64(4));
    }

    void aChangedLineDoesNotFit_data()
    {
        QTest::addColumn<QByteArray>("from");
        QTest::addColumn<QByteArray>("to");
        QTest::newRow("text") << QByteArray("\\\"2\\\"") << QByteArray("\\\"7\\\"");
        QTest::newRow("no JSON") << QByteArray("{\"at\":\"1970-01-01T00:00:00.002Z\"") << QByteArray("{{");
    }

    void aChangedLineDoesNotFit()
    {
        QFETCH(QByteArray, from);
        QFETCH(QByteArray, to);
        const Folder folder;
        folder.write(1, 3);
        folder.change([&](QByteArray& bytes) {
            QVERIFY(bytes.contains(from));
            bytes.replace(from, to);
        });
        const AlarmJournal journal(folder.place.path(), QStringLiteral("alarms"));
        QVERIFY2(journal.remark().contains(QStringLiteral("changed or damaged")), qPrintable(journal.remark()));
    }

    void aRemovedLineIsMissed()
    {
        const Folder folder;
        folder.write(1, 3);
        folder.change([&](QByteArray& bytes) {
            const auto first = bytes.indexOf('\n') + 1;
            bytes.remove(first, bytes.indexOf('\n', first) + 1 - first);
        });
        const AlarmJournal journal(folder.place.path(), QStringLiteral("alarms"));
        QVERIFY(journal.remark().contains(QStringLiteral("changed or damaged")));
    }

    void anotherConsoleOfThatNameIsToldWhy()
    {
        const Folder folder;
        const AlarmJournal first(folder.place.path(), QStringLiteral("alarms"));
        AlarmJournal second(folder.place.path(), QStringLiteral("alarms"));
        QVERIFY(second.trouble().contains(QStringLiteral("in use")));
        second.append(entry(1));
    }

    void theLockOfADeadConsoleStopsNobody()
    {
        const Folder folder;
        const auto child = ::fork();
        if (child == 0) {
            QLockFile lock(folder.file() + QStringLiteral(".lock"));
            lock.tryLock(0);
            ::_exit(0);
        }
        QCOMPARE(::waitpid(child, nullptr, 0), child);
        QVERIFY(QFile::exists(folder.file() + QStringLiteral(".lock")));
        folder.write(1, 1);
        const AlarmJournal journal(folder.place.path(), QStringLiteral("alarms"));
        QCOMPARE(journal.trouble(), QString());
        QCOMPARE(journal.restored().size(), std::size_t(1));
    }

    void aFolderThatCannotBeIsToldByName()
    {
        const Folder folder;
        QFile file(folder.place.filePath(QStringLiteral("plain")));
        QVERIFY(file.open(QIODevice::WriteOnly));
        const AlarmJournal journal(file.fileName() + QStringLiteral("/below"), QStringLiteral("alarms"));
        QVERIFY2(journal.trouble().contains(QStringLiteral("plain/below")), qPrintable(journal.trouble()));
    }

    void aDiskThatTakesNothingIsTold()
    {
        const Folder folder;
        QVERIFY(QFile::link(QStringLiteral("/dev/full"), folder.file()));
        AlarmJournal journal(folder.place.path(), QStringLiteral("alarms"));
        journal.append(entry(1));
        QTRY_VERIFY2(!journal.trouble().isEmpty(), "an entry that was not written must be told");
        QVERIFY(journal.trouble().contains(folder.file()));
    }

    /// A full disk that is emptied: nothing new has to happen for the log to be kept again, and nothing of it is missing.
    void whatTheDiskDidNotTakeIsWrittenWhenItDoes()
    {
        const Folder folder;
        {
            AlarmJournal journal(folder.place.path(), QStringLiteral("alarms"));
            rlimit usual{};
            QCOMPARE(::getrlimit(RLIMIT_FSIZE, &usual), 0);
            const auto before = std::signal(SIGXFSZ, SIG_IGN);
            const rlimit none{0, usual.rlim_max};
            QCOMPARE(::setrlimit(RLIMIT_FSIZE, &none), 0);
            for (int number = 1; number <= 3; ++number)
                journal.append(entry(number));
            const bool told = QTest::qWaitFor([&journal] { return !journal.keeps(); });
            QCOMPARE(::setrlimit(RLIMIT_FSIZE, &usual), 0);
            std::signal(SIGXFSZ, before);
            QVERIFY(told);
            QTRY_VERIFY2(journal.keeps(), qPrintable(journal.trouble()));
        }
        const AlarmJournal journal(folder.place.path(), QStringLiteral("alarms"));
        QCOMPARE(journal.restored().size(), std::size_t(3));
        QCOMPARE(journal.restored()[2].text, entry(3).text);
        QCOMPARE(journal.remark(), QString());
    }
};

QTEST_GUILESS_MAIN(TestAlarmJournal)
#include "test_alarm_journal.moc"
