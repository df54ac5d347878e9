// What is heard of the alarm's bursts: the real player and the real watchdog play to a real sound server, whose output is recorded.
#include "model/alarm_burst.hpp"
#include "sound/loudspeaker.hpp"
#include "support/sound_room.hpp"
#include "watchdog_ride.hpp"

#include <QSignalSpy>
#include <QTest>

#include <algorithm>
#include <cmath>
#include <memory>

using namespace console;
using namespace console::test;

namespace {

constexpr int patience = 30000;
constexpr double quiet = 800;    ///< ms, more than any gap in a burst
constexpr double inRhythm = 25;  ///< ms
constexpr double inTune = 5;     ///< Hz
constexpr std::size_t group = 5; ///< of pulses, in a high burst

const auto player = QStringLiteral(LIENA_PROGRAM_DIR "/liena-console-player");

constexpr const char* theatre = "theatre"; ///< an output
constexpr const char* corridor = "corridor";

Instant present() { return std::chrono::steady_clock::now(); }

std::size_t pulsesOf(AlarmPriority priority) { return burstOf(priority).size(); }

} // namespace

class BurstTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void initTestCase()
    {
        if (const auto missing = SoundServer::missing(); !missing.isEmpty())
            QSKIP(qPrintable(missing));
        QVERIFY2(m_server.start(), qPrintable(m_server.said()));
        QVERIFY2(m_server.addOutput(theatre), qPrintable(m_server.said()));
        m_record = std::make_unique<SoundRecord>(theatre);
        QTRY_VERIFY2_WITH_TIMEOUT(m_record->length() > 0, qPrintable(m_server.said()), patience);
    }

    void cleanupTestCase() { m_record.reset(); }

    void init()
    {
        QVERIFY(m_record);
        m_from = m_record->length();
    }

    void aBurstIsHeardAsItIsDeclared_data()
    {
        QTest::addColumn<AlarmPriority>("priority");
        QTest::addColumn<bool>("heldUp"); // the player, once it sounds: on a busy computer it is not its turn
        for (const bool heldUp : {false, true}) {
            const char* how = heldUp ? ", its player held up" : "";
            QTest::addRow("high%s", how) << AlarmPriority::High << heldUp;
            QTest::addRow("medium%s", how) << AlarmPriority::Medium << heldUp;
            QTest::addRow("low%s", how) << AlarmPriority::Low << heldUp;
        }
    }

    void aBurstIsHeardAsItIsDeclared()
    {
        QFETCH(AlarmPriority, priority);
        QFETCH(bool, heldUp);
        Loudspeaker voice(player);
        QVERIFY(open(voice));
        const auto told = present();
        voice.play(priority);
        QTRY_VERIFY_WITH_TIMEOUT(!m_record->pulsesSince(m_from).empty(), patience);
        if (heldUp)
            QCOMPARE(::kill(static_cast<pid_t>(voice.processId()), SIGSTOP), 0);
        QTRY_VERIFY_WITH_TIMEOUT(m_record->hasFallenSilent(m_from, quiet), patience);
        QCOMPARE(::kill(static_cast<pid_t>(voice.processId()), SIGCONT), 0);
        const auto heard = m_record->pulsesSince(m_from);
        QCOMPARE(heard.size(), pulsesOf(priority));
        QVERIFY(isBurst(*m_record, priority, heard.begin()));
        sayHowLong("play() -> first sample above noise", told, m_record->firstSound(m_from));
    }

    void silenceEndsABurstAndTheNextOneIsHeardWhole()
    {
        Loudspeaker voice(player);
        QVERIFY(open(voice));
        voice.play(AlarmPriority::High);
        QTRY_VERIFY_WITH_TIMEOUT(m_record->pulsesSince(m_from).size() >= 2, patience);
        const auto told = present();
        voice.silence();
        QTRY_VERIFY_WITH_TIMEOUT(m_record->hasFallenSilent(m_from, quiet), patience);
        QVERIFY(m_record->pulsesSince(m_from).size() < group);
        sayHowLong("silence() -> last sample above noise", told, m_record->lastSound(m_from));

        const double again = m_record->length();
        voice.play(AlarmPriority::High);
        QTRY_VERIFY_WITH_TIMEOUT(m_record->hasFallenSilent(again, quiet), patience);
        const auto heard = m_record->pulsesSince(again);
        QCOMPARE(heard.size(), pulsesOf(AlarmPriority::High));
        QVERIFY(isBurst(*m_record, AlarmPriority::High, heard.begin()));
    }

    void aBurstBeginsInPlaceOfTheOneThatSounds()
    {
        Loudspeaker voice(player);
        QVERIFY(open(voice));
        voice.play(AlarmPriority::Low);
        QTRY_VERIFY_WITH_TIMEOUT(!m_record->pulsesSince(m_from).empty(), patience);
        voice.play(AlarmPriority::High);
        QTRY_VERIFY_WITH_TIMEOUT(m_record->hasFallenSilent(m_from, quiet), patience);
        QVERIFY(endsInAWholeBurst(*m_record, m_from));
    }

    /// An alarm that stands for a minute sounds that often.
    void theTwelfthBurstIsHeardAsTheFirst()
    {
        Loudspeaker voice(player);
        QVERIFY(open(voice));
        for (int i = 0; i < 12; ++i) {
            const double from = m_record->length();
            voice.play(AlarmPriority::Medium);
            QTRY_VERIFY2_WITH_TIMEOUT(m_record->hasFallenSilent(from, quiet), qPrintable(QString::number(i)), patience);
            const auto heard = m_record->pulsesSince(from);
            QVERIFY2(heard.size() == pulsesOf(AlarmPriority::Medium), qPrintable(QStringLiteral("%1: %2 pulses").arg(i).arg(heard.size())));
            QVERIFY2(isBurst(*m_record, AlarmPriority::Medium, heard.begin()), qPrintable(QString::number(i)));
        }
    }

    void theWatchdogIsHeardWhileItsConsoleHangs()
    {
        Ride ride(QStringLiteral("armed"));
        QTRY_VERIFY_WITH_TIMEOUT(ride.says("is watched"), patience);
        QCOMPARE(m_record->pulsesSince(m_from).size(), std::size_t(0));
        const auto stopped = present();
        ride.send(SIGSTOP);
        QTRY_VERIFY_WITH_TIMEOUT(m_record->hasFallenSilent(m_from, quiet), patience);
        const auto heard = m_record->pulsesSince(m_from);
        QCOMPARE(heard.size(), pulsesOf(AlarmPriority::High));
        QVERIFY(isBurst(*m_record, AlarmPriority::High, heard.begin()));
        sayHowLong("console hangs -> first sample above noise", stopped, m_record->firstSound(m_from));

        // It sounds until the console beats again.
        const double again = m_record->length();
        QTRY_VERIFY_WITH_TIMEOUT(m_record->pulsesSince(again).size() >= 2, patience);
        ride.send(SIGCONT);
        QTRY_VERIFY_WITH_TIMEOUT(m_record->hasFallenSilent(again, quiet), patience);
        QVERIFY(m_record->pulsesSince(again).size() < group);
        ride.rider().closeWriteChannel();
        QVERIFY(ride.rider().waitForFinished(patience));
    }

    /// The loudspeaker gives up on it, and another plays.
    void aPlayerThatIsKilledOrHangsIsReplaced_data()
    {
        QTest::addColumn<int>("fate");
        QTest::newRow("killed") << SIGKILL;
        QTest::newRow("hangs") << SIGSTOP;
    }

    void aPlayerThatIsKilledOrHangsIsReplaced()
    {
        QFETCH(int, fate);
        Loudspeaker voice(player);
        QVERIFY(open(voice));
        const auto first = voice.processId();
        QSignalSpy told(&voice, &AlarmVoice::troubleChanged);
        QCOMPARE(::kill(static_cast<pid_t>(first), fate), 0);
        voice.play(AlarmPriority::High); // which nobody plays
        QTRY_COMPARE_WITH_TIMEOUT(told.size(), 2, patience);
        const auto expected = fate == SIGKILL ? QStringLiteral("has ended") : QStringLiteral("does not answer");
        QVERIFY2(told.front().front().toString().contains(expected), qPrintable(told.front().front().toString()));
        QCOMPARE(told.back().front().toString(), QString());
        QVERIFY(voice.processId() != first);
        QVERIFY(Ride::isGone(first));
        QTRY_VERIFY_WITH_TIMEOUT(m_record->hasFallenSilent(m_from, quiet), patience); // the new one does
        const auto heard = m_record->pulsesSince(m_from);
        QCOMPARE(heard.size(), pulsesOf(AlarmPriority::High));
        QVERIFY(isBurst(*m_record, AlarmPriority::High, heard.begin()));
    }

    void whatHasSoundedOrWasSilencedIsNotPlayedByTheNextOne_data()
    {
        QTest::addColumn<bool>("silenced");
        QTest::newRow("sounded") << false;
        QTest::newRow("silenced") << true;
    }

    void whatHasSoundedOrWasSilencedIsNotPlayedByTheNextOne()
    {
        QFETCH(bool, silenced);
        Loudspeaker voice(player);
        QVERIFY(open(voice));
        voice.play(AlarmPriority::High);
        QTRY_VERIFY_WITH_TIMEOUT(!m_record->pulsesSince(m_from).empty(), patience);
        if (silenced)
            voice.silence();
        QTRY_VERIFY_WITH_TIMEOUT(m_record->hasFallenSilent(m_from, quiet), patience);
        const double ended = m_record->length();
        QSignalSpy told(&voice, &AlarmVoice::troubleChanged);
        QCOMPARE(::kill(static_cast<pid_t>(voice.processId()), SIGKILL), 0);
        QTRY_COMPARE_WITH_TIMEOUT(told.size(), 2, patience);
        QCOMPARE(told.back().front().toString(), QString());
        const double again = m_record->length();
        QTRY_VERIFY_WITH_TIMEOUT(m_record->length() > again + 2 * quiet, patience);
        QCOMPARE(m_record->pulsesSince(ended).size(), std::size_t(0));
    }

    void whatItsPlayersEndCutShortIsHeardWhole()
    {
        Loudspeaker voice(player);
        QVERIFY(open(voice));
        voice.play(AlarmPriority::Low); // which the sound server has whole by now
        QTRY_VERIFY_WITH_TIMEOUT(!m_record->pulsesSince(m_from).empty(), patience);
        QCOMPARE(::kill(static_cast<pid_t>(voice.processId()), SIGKILL), 0);
        QTRY_VERIFY_WITH_TIMEOUT(m_record->hasFallenSilent(m_from, quiet), patience);
        const double again = m_record->length();
        QTRY_VERIFY_WITH_TIMEOUT(m_record->hasFallenSilent(again, quiet), patience);
        const auto heard = m_record->pulsesSince(again);
        QCOMPARE(heard.size(), pulsesOf(AlarmPriority::Low));
        QVERIFY(isBurst(*m_record, AlarmPriority::Low, heard.begin()));
    }

    void aPlayerEndsWithItsInput()
    {
        QProcess process;
        process.start(player, QStringList());
        QVERIFY(process.waitForReadyRead(patience));
        process.closeWriteChannel();
        QVERIFY(process.waitForFinished(patience));
        QCOMPARE(process.exitStatus(), QProcess::NormalExit);
        QCOMPARE(process.exitCode(), 0);
    }

    void aPlayerEndsWithWhoeverStartedItHoweverThatEnds_data()
    {
        QTest::addColumn<bool>("hangs");
        QTest::newRow("well") << false;
        QTest::newRow("hangs") << true;
    }

    void aPlayerEndsWithWhoeverStartedItHoweverThatEnds()
    {
        QFETCH(bool, hangs);
        Ride ride(QStringLiteral("idle"));
        QTRY_VERIFY_WITH_TIMEOUT(ride.says("is watched"), patience);
        const auto watchdog = static_cast<pid_t>(ride.watchdog());
        const auto process = childOf(watchdog);
        QVERIFY(process > 0);
        if (hangs)
            QCOMPARE(::kill(process, SIGSTOP), 0);
        QVERIFY(!Ride::isGone(process));
        QCOMPARE(::kill(watchdog, SIGKILL), 0);
        QTRY_VERIFY_WITH_TIMEOUT(Ride::isGone(process), patience);
    }

    /// Never that all is well before an output is open.
    void aSoundServerThatHangsIsToldAndOneThatAnswersAgainIsHeard()
    {
        Loudspeaker voice(player);
        QSignalSpy told(&voice, &AlarmVoice::troubleChanged);
        m_server.freeze();
        voice.start();
        voice.play(AlarmPriority::High);
        const bool noticed = told.wait(patience);
        m_server.thaw();
        QVERIFY(noticed);
        QCOMPARE(told.front().front().toString(), QStringLiteral("the sound output does not answer"));
        QTRY_COMPARE_WITH_TIMEOUT(told.back().front().toString(), QString(), patience);
        const auto heard = [this] {
            return m_record->hasFallenSilent(m_from, quiet) && m_record->pulsesSince(m_from).size() >= pulsesOf(AlarmPriority::High);
        };
        QTRY_VERIFY_WITH_TIMEOUT(heard(), patience); // the server, too, catches up with what it missed
    }

    /// Qt 6.4 looks for it once, after three seconds.
    void aSoundServerThatWasGoneForLongerIsFoundAgain()
    {
        Loudspeaker voice(player);
        QVERIFY(open(voice));
        voice.play(AlarmPriority::High);
        QTRY_VERIFY_WITH_TIMEOUT(!m_record->pulsesSince(m_from).empty(), patience);
        voice.silence();
        QTRY_VERIFY_WITH_TIMEOUT(m_record->hasFallenSilent(m_from, quiet), patience);
        QSignalSpy told(&voice, &AlarmVoice::troubleChanged);
        m_record.reset();
        m_server.stop();
        QTRY_VERIFY_WITH_TIMEOUT(!told.empty(), patience);
        QVERIFY2(told.front().front().toString().contains(QStringLiteral("has failed")), qPrintable(told.front().front().toString()));
        const auto first = voice.processId();
        QTRY_VERIFY_WITH_TIMEOUT(voice.processId() != first && voice.processId() != 0, patience);
        QVERIFY(isTroubled(told));
        initTestCase();
        if (QTest::currentTestFailed())
            return;
        QTRY_COMPARE_WITH_TIMEOUT(told.back().front().toString(), QString(), 2 * patience); // the next player may be twenty seconds away
        m_from = m_record->length();
        voice.play(AlarmPriority::High);
        QTRY_VERIFY_WITH_TIMEOUT(m_record->hasFallenSilent(m_from, quiet), patience);
        const auto heard = m_record->pulsesSince(m_from);
        QCOMPARE(heard.size(), pulsesOf(AlarmPriority::High));
        QVERIFY(isBurst(*m_record, AlarmPriority::High, heard.begin()));
    }

    /// Last: it takes the outputs away.
    void whatIsCutShortByTheEndOfItsOutputIsHeardWholeFromTheNextOne()
    {
        QVERIFY2(m_server.addOutput(corridor), qPrintable(m_server.said()));
        SoundRecord next(corridor);
        QTRY_VERIFY2_WITH_TIMEOUT(next.length() > 0, qPrintable(m_server.said()), patience);
        QString trouble;
        Loudspeaker voice(player);
        QVERIFY(open(voice));
        voice.play(AlarmPriority::High);
        QTRY_VERIFY_WITH_TIMEOUT(m_record->pulsesSince(m_from).size() >= 2, patience);
        QCOMPARE(next.pulsesSince(0).size(), std::size_t(0));
        QVERIFY2(m_server.removeOutput(theatre), qPrintable(m_server.said()));
        QTRY_VERIFY_WITH_TIMEOUT(next.hasFallenSilent(0, quiet), patience);
        QVERIFY(endsInAWholeBurst(next, 0));

        // None, and one that comes later.
        connect(&voice, &AlarmVoice::troubleChanged, this, [&trouble](const QString& told) { trouble = told; });
        QVERIFY2(m_server.removeOutput(corridor), qPrintable(m_server.said()));
        QTRY_VERIFY2_WITH_TIMEOUT(trouble.contains(QStringLiteral("no sound output")), qPrintable(trouble), patience);
        QVERIFY2(m_server.addOutput(theatre), qPrintable(m_server.said()));
        QTRY_COMPARE_WITH_TIMEOUT(trouble, QString(), patience);
        SoundRecord again(theatre);
        QTRY_VERIFY2_WITH_TIMEOUT(again.length() > 0, qPrintable(m_server.said()), patience);
        voice.play(AlarmPriority::High);
        QTRY_VERIFY_WITH_TIMEOUT(again.hasFallenSilent(0, quiet), patience);
        QCOMPARE(again.pulsesSince(0).size(), pulsesOf(AlarmPriority::High));
    }

private:
    /// With an output.
    static bool open(Loudspeaker& voice)
    {
        QSignalSpy told(&voice, &AlarmVoice::troubleChanged);
        voice.start();
        return told.wait(patience) && told.front().front().toString().isEmpty();
    }

    /// The first one; 0: none.
    static pid_t childOf(pid_t parent)
    {
        QFile children(QStringLiteral("/proc/%1/task/%1/children").arg(parent));
        return children.open(QIODevice::ReadOnly) ? static_cast<pid_t>(children.readAll().split(' ').front().toInt()) : 0;
    }

    /// All the time: each thing that was told is another, and none of them that it is well.
    static bool isTroubled(const QSignalSpy& told)
    {
        return std::all_of(told.begin(), told.end(), [](const QVariantList& change) { return !change.front().toString().isEmpty(); });
    }

    /// Judged by where the pulses end: the first one may touch what it cut short.
    static bool isBurst(const SoundRecord& record, AlarmPriority priority, std::vector<HeardPulse>::const_iterator heard)
    {
        const auto declared = burstOf(priority);
        const auto endOf = [](const SoundPulse& pulse) { return double((pulse.start + pulse.length).count()); };
        const double begun = heard->end - endOf(declared.front());
        bool good = true;
        for (const auto& pulse : declared) {
            const double end = heard->end - begun;
            const double length = heard->end - heard->start;
            const double excess = length - double(pulse.length.count());
            const double pitch = record.pitchOf({std::max(heard->start, heard->end - double(pulse.length.count())), heard->end});
            const bool first = pulse.start == declared.front().start;
            if (std::abs(end - endOf(pulse)) > inRhythm || excess < -inRhythm || (excess > inRhythm && !first) ||
                std::abs(pitch - pulse.pitch) > inTune) {
                qWarning("heard until %.0f ms for %.0f ms with %.0f Hz; declared until %.0f for %lld with %.0f", end, length, pitch,
                         endOf(pulse), static_cast<long long>(pulse.length.count()), pulse.pitch);
                good = false;
            }
            ++heard;
        }
        return good;
    }

    /// After what was cut short.
    static bool endsInAWholeBurst(const SoundRecord& record, double start)
    {
        const auto heard = record.pulsesSince(start);
        const auto whole = pulsesOf(AlarmPriority::High);
        if (heard.size() >= whole && heard.size() < whole + group)
            return isBurst(record, AlarmPriority::High, heard.end() - std::ptrdiff_t(whole));
        qWarning("heard %zu pulses", heard.size());
        return false;
    }

    static void sayHowLong(const char* what, Instant from, std::optional<Instant> to)
    {
        QVERIFY(to);
        qInfo("%s: %.0f ms", what, milliseconds(*to - from));
    }

    SoundServer m_server; ///< first: it goes last
    std::unique_ptr<SoundRecord> m_record;
    double m_from = 0; ///< of this test, in the record
};

QTEST_GUILESS_MAIN(BurstTest)
#include "burst_test.moc"
