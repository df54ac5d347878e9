// A log's file: whole or not at all, never over another, and every failure says what to do.
#include "app/log_saver.hpp"

#include <QDir>
#include <QFile>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>

using namespace console;

namespace {

struct Room {
    QTemporaryDir folder;
    LogSaver saver;
    QSignalSpy saved{&saver, &LogSaver::saved};
    QSignalSpy failed{&saver, &LogSaver::failed};

    QString path(const char* name) const { return folder.filePath(QString::fromLatin1(name)); }
    QByteArray content(const char* name) const
    {
        QFile file(path(name));
        return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray("none");
    }
    QString reason() { return failed.isEmpty() ? QString() : failed.last().first().toString(); }
};

} // namespace

class TestLogSaver : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void writesTheFileAndItsFolder()
    {
        Room room;
        room.saver.save("a\nb\n", room.path("new/deep/log.txt"));
        QTRY_COMPARE(room.saved.count(), 1);
        QCOMPARE(room.saved.first().first().toString(), room.path("new/deep/log.txt"));
        QCOMPARE(room.content("new/deep/log.txt"), QByteArray("a\nb\n"));
        QCOMPARE(QDir(room.path("new/deep")).entryList(QDir::Files).size(), 1); // nothing half-written beside it
    }

    void aFileThatIsThereStays()
    {
        Room room;
        QFile old(room.path("log.txt"));
        QVERIFY(old.open(QIODevice::WriteOnly) && old.write("old") == 3);
        old.close();
        room.saver.save("new", room.path("log.txt"));
        QTRY_COMPARE(room.failed.count(), 1);
        QCOMPARE(room.content("log.txt"), QByteArray("old"));
        QVERIFY2(room.reason().contains(room.path("log.txt")) && room.reason().contains(QStringLiteral("Name another file")),
                 qPrintable(room.reason()));
    }

    void everyFailureNamesTheFileAndTheRemedy_data()
    {
        QTest::addColumn<QString>("path");
        QTest::addColumn<QString>("named");
        QTest::addColumn<QString>("remedy");
        QTest::newRow("nothing named") << QString() << QStringLiteral("No file") << QStringLiteral("Write the name of one");
        QTest::newRow("a folder that is a file")
            << QStringLiteral("/dev/null/log.txt") << QStringLiteral("/dev/null") << QStringLiteral("in another one");
        QTest::newRow("a folder that takes none")
            << QStringLiteral("/proc/log.txt") << QStringLiteral("/proc/log.txt") << QStringLiteral("another folder");
    }

    void everyFailureNamesTheFileAndTheRemedy()
    {
        QFETCH(QString, path);
        QFETCH(QString, named);
        QFETCH(QString, remedy);
        Room room;
        room.saver.save("x", path);
        QTRY_COMPARE(room.failed.count(), 1);
        QVERIFY2(room.reason().contains(named) && room.reason().contains(remedy), qPrintable(room.reason()));
    }

    void oneAtATime()
    {
        Room room;
        room.saver.save("1", room.path("1.txt"));
        room.saver.save("2", room.path("2.txt"));
        QTRY_COMPARE(room.saved.count(), 1);
        QCOMPARE(room.failed.count(), 1);
        QCOMPARE(room.content("2.txt"), QByteArray("none"));
        room.saver.save("2", room.path("2.txt"));
        QTRY_COMPARE(room.saved.count(), 2);
    }

    void aNameIsSuggestedPerLog()
    {
        const QString path = suggestedLogPath(QStringLiteral("alarms"));
        QVERIFY2(path.contains(QStringLiteral("/liena/alarms_")) && path.endsWith(QStringLiteral(".txt")), qPrintable(path));
    }
};

QTEST_GUILESS_MAIN(TestLogSaver)
#include "test_log_saver.moc"
