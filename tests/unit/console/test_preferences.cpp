// Preferences: bounds, and a file that is missing, broken, too long, foreign, or cannot be written.
#include "app/preference_store.hpp"
#include "model/motion_permit.hpp"

#include <QDir>
#include <QFile>
#include <QTemporaryDir>
#include <QTest>

using namespace console;
using namespace std::chrono_literals;

namespace {

struct Folder {
    QTemporaryDir folder;
    QString path = folder.filePath(QStringLiteral("deep/preferences.ini"));

    void put(const QByteArray& text) const
    {
        QDir().mkpath(folder.filePath(QStringLiteral("deep")));
        QFile file(path);
        if (!file.open(QIODevice::WriteOnly) || file.write(text) != text.size())
            qFatal("cannot prepare the file");
    }

    QByteArray contents(const QString& name) const
    {
        QFile file(name);
        return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
    }
};

Preferences unusual()
{
    Preferences p;
    p.language = QStringLiteral("zh_CN");
    p.brightness = Brightness::Dim;
    p.audioPause = 90s;
    p.trendSpan = TrendSpan::TenMinutes;
    p.pictureFolder = QStringLiteral("/tmp/\u56FE \u00FC; =% [x]/a,b");
    p.patientSide = QStringLiteral("\u624B\u672F\u5BA4 2; +86 10, \"4711\"");
    p.window = WindowChoice::Wide;
    p.noiseReduction = 40;
    p.edge = 30;
    p.edgeMethod = EdgeMethod::MultiScale;
    p.pulseRate = 7.5;
    p.holdPictures = 8;
    p.objectHeight = 125;
    p.tableTop = -35;
    return p;
}

} // namespace

class TestPreferences : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void withoutAFileThereAreTheDefaultsAndNoTrouble()
    {
        const Folder at;
        PreferenceStore store(at.path);
        const auto reading = store.read();
        QCOMPARE(reading.preferences, Preferences());
        QVERIFY(reading.troubles.isEmpty());
        QVERIFY(!QFile::exists(at.path));
    }

    void whatIsWrittenIsReadAgain()
    {
        const Folder at;
        PreferenceStore store(at.path);
        store.read();
        QCOMPARE(store.write(unusual()), QString());
        const auto reading = PreferenceStore(at.path).read();
        QVERIFY2(reading.troubles.isEmpty(), qPrintable(reading.troubles.join(QLatin1Char('|'))));
        QCOMPARE(reading.preferences, unusual());
    }

    void anEntryThatMakesNoSenseIsNamedAndTheOthersCount_data()
    {
        QTest::addColumn<QByteArray>("line");
        QTest::addColumn<QString>("key");
        QTest::newRow("pause too long") << QByteArray("audio-pause-seconds=3600") << QStringLiteral("audio-pause-seconds");
        QTest::newRow("pause too short") << QByteArray("audio-pause-seconds=1") << QStringLiteral("audio-pause-seconds");
        QTest::newRow("pause is a word") << QByteArray("audio-pause-seconds=ever") << QStringLiteral("audio-pause-seconds");
        QTest::newRow("brightness") << QByteArray("brightness=blinding") << QStringLiteral("brightness");
        QTest::newRow("span") << QByteArray("trend-span=12h") << QStringLiteral("trend-span");
        QTest::newRow("window by hand") << QByteArray("window=fixed") << QStringLiteral("window");
        QTest::newRow("noise") << QByteArray("noise-reduction=-5") << QStringLiteral("noise-reduction");
        QTest::newRow("edge method") << QByteArray("edge-method=magic") << QStringLiteral("edge-method");
        QTest::newRow("hold of three") << QByteArray("hold-pictures=3") << QStringLiteral("hold-pictures");
        QTest::newRow("hold of none") << QByteArray("hold-pictures=0") << QStringLiteral("hold-pictures");
        QTest::newRow("hold is a word") << QByteArray("hold-pictures=many") << QStringLiteral("hold-pictures");
        QTest::newRow("object's height") << QByteArray("object-above-table-mm=90") << QStringLiteral("object-above-table-mm");
        QTest::newRow("table top too far") << QByteArray("table-top-below-isocentre-mm=1001")
                                           << QStringLiteral("table-top-below-isocentre-mm");
        QTest::newRow("table top is a word") << QByteArray("table-top-below-isocentre-mm=low")
                                             << QStringLiteral("table-top-below-isocentre-mm");
        QTest::newRow("language") << QByteArray("language=tlh") << QStringLiteral("language");
        QTest::newRow("patient side") << QByteArray("patient-side=\"a\\x1b[2Jb\"") << QStringLiteral("patient-side");
        QTest::newRow("folder with a comma, no quotes") << QByteArray("picture-folder=/tmp/a,b") << QStringLiteral("picture-folder");
        QTest::newRow("two languages") << QByteArray("language=en, zh_CN") << QStringLiteral("language");
        QTest::newRow("folder") << QByteArray("picture-folder=\"a\\x1b[2Jb\"") << QStringLiteral("picture-folder");
    }

    void anEntryThatMakesNoSenseIsNamedAndTheOthersCount()
    {
        QFETCH(QByteArray, line);
        QFETCH(QString, key);
        const Folder at;
        at.put("[General]\nedge=70\n" + line + "\n");
        const auto reading = PreferenceStore(at.path).read();
        QCOMPARE(reading.troubles.size(), 1);
        QVERIFY2(reading.troubles.first().contains(key) && reading.troubles.first().contains(at.path),
                 qPrintable(reading.troubles.first()));
        Preferences expected;
        expected.edge = 70;
        QCOMPARE(reading.preferences, expected);
    }

    /// As a person writes it who does not know that this file wants quotes then.
    void aNumberWithCommasIsWholeAlsoWithoutQuotes()
    {
        const Folder at;
        at.put("[General]\npatient-side=Dr Li, +86 755 1234, theatre 2\n");
        PreferenceStore store(at.path);
        const auto reading = store.read();
        QVERIFY2(reading.troubles.isEmpty(), qPrintable(reading.troubles.join(QLatin1Char('|'))));
        QCOMPARE(reading.preferences.patientSide, QStringLiteral("Dr Li, +86 755 1234, theatre 2"));
        QCOMPARE(store.write(reading.preferences), QString());
        QCOMPARE(PreferenceStore(at.path).read().preferences, reading.preferences);
    }

    void aBrokenFileIsKeptBesideTheNewOne_data()
    {
        QTest::addColumn<QByteArray>("text");
        QTest::newRow("no such thing") << QByteArray("audio-pause-seconds=9\n");
        QTest::newRow("bytes") << QByteArray("\0\1\2\3", 4);
        QTest::newRow("too long") << QByteArray("edge=1\n") + QByteArray(70'000, 'x');
    }

    void aBrokenFileIsKeptBesideTheNewOne()
    {
        QFETCH(QByteArray, text);
        const Folder at;
        at.put(text);
        PreferenceStore store(at.path);
        QVERIFY(!store.read().troubles.isEmpty());
        QCOMPARE(at.contents(at.path), text); // reading alone changes nothing
        QCOMPARE(store.write(unusual()), QString());
        QCOMPARE(at.contents(at.path + QStringLiteral(".kept-1")), text);
        const auto again = PreferenceStore(at.path).read();
        QVERIFY(again.troubles.isEmpty());
        QCOMPARE(again.preferences, unusual());
    }

    void entriesOfOthersStay()
    {
        const Folder at;
        at.put("[General]\nedge=70\nof-a-later-version=17\n");
        PreferenceStore store(at.path);
        store.read();
        QCOMPARE(store.write(unusual()), QString());
        QVERIFY(at.contents(at.path).contains("of-a-later-version=17"));
    }

    void whatCannotBeWrittenIsSaid()
    {
        const Folder at;
        QFile file(at.folder.filePath(QStringLiteral("deep"))); // a file where the folder should be
        QVERIFY(file.open(QIODevice::WriteOnly));
        file.close();
        PreferenceStore store(at.path);
        QCOMPARE(store.read().preferences, Preferences());
        const QString trouble = store.write(unusual());
        QVERIFY2(trouble.contains(at.path) && trouble.contains(QStringLiteral("cannot be written")), qPrintable(trouble));
    }

    void aFolderInItsPlaceIsSaid()
    {
        const Folder at;
        QVERIFY(QDir().mkpath(at.path));
        PreferenceStore store(at.path);
        QVERIFY(!store.read().troubles.isEmpty());
        QVERIFY(!store.write(unusual()).isEmpty());
        QVERIFY(QFileInfo(at.path).isDir());
    }

    void everythingIsBroughtWithinItsBounds()
    {
        Preferences p = unusual();
        p.audioPause = 4000s;
        p.noiseReduction = 900;
        p.pulseRate = 3;
        p.holdPictures = 3;
        p.objectHeight = 99;
        p.tableTop = 1001;
        p.window = WindowChoice::Fixed;
        p.language = QStringLiteral("xx");
        const Preferences bounded = withinBounds(p);
        QCOMPARE(bounded.audioPause, 120s);
        QCOMPARE(bounded.noiseReduction, 100);
        QCOMPARE(bounded.pulseRate, 15.0);
        QCOMPARE(bounded.holdPictures, 1);
        QCOMPARE(bounded.objectHeight, 100);
        QVERIFY(!bounded.tableTop);
        QVERIFY(bounded.window == WindowChoice::AsSent);
        QVERIFY(bounded.language.isEmpty());
    }

    void nothingChangesWhileMotionIsPermittedOrMayComeBack()
    {
        for (const auto phase : {PermitPhase::Arming, PermitPhase::Armed, PermitPhase::Engaged, PermitPhase::Hold})
            QVERIFY(!preferencesMayChange(phase));
        for (const auto phase : {PermitPhase::Off, PermitPhase::Standby, PermitPhase::Ready, PermitPhase::Incident, PermitPhase::Verifying})
            QVERIFY(preferencesMayChange(phase));
    }

    void audioPauseLastsAsLongAsWasSetAndNeverLongerThanTheSiteAllows_data()
    {
        QTest::addColumn<int>("wanted");
        QTest::addColumn<int>("got");
        QTest::newRow("usual") << 60 << 60;
        QTest::newRow("long") << 120 << 120;
        QTest::newRow("too long") << 7200 << 120;
        QTest::newRow("none") << 0 << 30;
    }

    void audioPauseLastsAsLongAsWasSetAndNeverLongerThanTheSiteAllows()
    {
        QFETCH(int, wanted);
        QFETCH(int, got);
        AlarmList alarms;
        const Instant now{};
        alarms.setAudioPause(std::chrono::seconds(wanted));
        alarms.pauseAudio(now);
        QVERIFY(alarms.audioPauseLeft(now + std::chrono::seconds(got) - 1ms));
        QVERIFY(!alarms.audioPauseLeft(now + std::chrono::seconds(got)));
    }
};

QTEST_GUILESS_MAIN(TestPreferences)
#include "test_preferences.moc"
