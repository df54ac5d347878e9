// Alarms of the console's own computer by what causes them: a disk that is full, no loudspeaker, a thread that has no time to paint.
#include "full_disk.hpp"
#include "gui/shown_texts.hpp"
#include "puppet_theatre.hpp"
#include "shown_alarms.hpp"
#include "sound/alarm_voice.hpp"
#include "widgets/alarm_band.hpp"
#include "widgets/status_strip.hpp"
#include "widgets/theme.hpp"

#include <QApplication>
#include <QTest>
#include <QThread>
#include <QTimer>

#include <algorithm>

using namespace console;
using console::test::isPresent;
using console::test::present;
using console::test::PuppetTheatre;
using console::test::puppetWishes;
using console::test::textsPaintedBy;
using console::test::Theatre;
using C = AlarmCondition;

namespace {

constexpr int patience = Theatre::patience;

/// A loudspeaker that is there.
class GoodVoice : public AlarmVoice {
public:
    void play(AlarmPriority) override {}
    void silence() override {}
};

Theatre::Wishes heardBy(AlarmVoice& voice)
{
    auto wishes = puppetWishes();
    wishes.voice = &voice;
    return wishes;
}

/// The band says it, as the highest or as a chip.
bool bandSays(Theatre& theatre, const QString& start)
{
    const auto texts = textsPaintedBy(*theatre.window().findChild<AlarmBand*>());
    return std::any_of(texts.begin(), texts.end(), [&start](const auto& shown) { return shown.text.startsWith(start); });
}

bool stripSays(Theatre& theatre, const QString& field, const QString& value)
{
    const auto labels = theatre.window().findChild<StatusStrip*>()->findChildren<NameLabel*>();
    return std::any_of(labels.begin(), labels.end(),
                       [&](const NameLabel* label) { return label->accessibleName() == field + QStringLiteral(": ") + value; });
}

GuardLine recorded(const Theatre& theatre) { return theatre.models().permit.checklist().at(std::size_t(Guard::Recorded)); }

/// Takes the console's thread for more than half of the time; the pedal's word still comes within its lease.
class OtherWork {
public:
    OtherWork()
    {
        QObject::connect(&m_timer, &QTimer::timeout, &m_timer, [] { QThread::msleep(120); });
        m_timer.start(140);
    }
    void end() { m_timer.stop(); }

private:
    QTimer m_timer;
};

} // namespace

class AlarmConsoleTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void initTestCase()
    {
        qputenv("PULSE_SERVER", "unix:/nowhere");
        theme::apply(*qobject_cast<QApplication*>(QCoreApplication::instance()));
    }

    /// 17. Armed: motion ends with the first turn that is missed, and the alarm is of an armed time.
    void picturesThatAreNotPaintedInTimeAreAnAlarm_data() { armedAndNot(); }

    void picturesThatAreNotPaintedInTimeAreAnAlarm()
    {
        QFETCH(bool, armed);
        auto wishes = puppetWishes();
        wishes.player = QStringLiteral(LIENA_PROGRAM_DIR "/liena-console-player");
        PuppetTheatre stage(wishes);
        auto& theatre = stage.theatre;
        QVERIFY(theatre.openAll());
        if (armed)
            QVERIFY2(theatre.arm(), qPrintable(theatre.story()));
        else
            theatre.hold(Qt::Key_F);
        const auto live = [&theatre] { return theatre.models().picture.reading(std::chrono::steady_clock::now()).shownPerSecond > 12; };
        const auto told = [&theatre] { return present(theatre, C::PaintingBehind) != nullptr; };
        QTRY_VERIFY2_WITH_TIMEOUT(live() && !told(), qPrintable(theatre.story()), patience);
        OtherWork work;
        QTRY_VERIFY2_WITH_TIMEOUT(told(), qPrintable(theatre.story()), patience);
        QVERIFY2(isPresent(theatre, C::PaintingBehind, armed ? AlarmPriority::Medium : AlarmPriority::Low), qPrintable(theatre.story()));
        QVERIFY(theatre.phase() != PermitPhase::Armed && theatre.phase() != PermitPhase::Engaged);
        work.end();
        QTRY_VERIFY2_WITH_TIMEOUT(!told(), qPrintable(theatre.story()), patience);
        theatre.releaseAll();
    }

    /// 18, with all that is said of it: nobody arms what is not written down.
    void aFullDiskIsAnAlarmAndArmsNothing()
    {
        GoodVoice voice;
        PuppetTheatre stage(heardBy(voice));
        auto& theatre = stage.theatre;
        QVERIFY(theatre.openAll());
        QVERIFY2(theatre.makeReady(), qPrintable(theatre.story()));
        const auto told = [&theatre] { return isPresent(theatre, C::RecorderStopped, AlarmPriority::Low); };
        const auto field = QStringLiteral("Recorder");
        QVERIFY(!told() && stripSays(theatre, field, QStringLiteral("Alarm log")));
        {
            const liena::test::FullDisk full;
            theatre.strike(Qt::Key_F9); // which is to be written down
            QTRY_VERIFY2_WITH_TIMEOUT(told(), qPrintable(theatre.story()), patience);
            QTRY_VERIFY2_WITH_TIMEOUT(!recorded(theatre).met, qPrintable(recorded(theatre).text), patience);
            QCOMPARE(recorded(theatre).text, QStringLiteral("Alarm log is not kept"));
            QTRY_VERIFY_WITH_TIMEOUT(stripSays(theatre, field, QStringLiteral("Stopped")), patience);
            QTRY_VERIFY_WITH_TIMEOUT(bandSays(theatre, QStringLiteral("Recording: ")), patience);
            theatre.hold(Qt::Key_R);
            QVERIFY(!theatre.reaches(PermitPhase::Arming, Theatre::twiceArmHold));
            theatre.release(Qt::Key_R);
            QCOMPARE(stage.robot.armRequests(), 0);
        }
        theatre.strike(Qt::Key_F9);
        QTRY_VERIFY2_WITH_TIMEOUT(!told() && recorded(theatre).met, qPrintable(theatre.story()), patience);
        QTRY_VERIFY_WITH_TIMEOUT(stripSays(theatre, field, QStringLiteral("Alarm log")), patience);
        theatre.releaseAll();
    }

    /// 20: there is no sound server.
    void noLoudspeakerIsAnAlarm_data() { armedAndNot(); }

    void noLoudspeakerIsAnAlarm()
    {
        QFETCH(bool, armed);
        PuppetTheatre stage;
        auto& theatre = stage.theatre;
        QVERIFY(theatre.openAll());
        if (armed)
            QVERIFY2(theatre.arm(), qPrintable(theatre.story()));
        const auto priority = armed ? AlarmPriority::Medium : AlarmPriority::Low;
        QTRY_VERIFY2_WITH_TIMEOUT(isPresent(theatre, C::SoundFailed, priority), qPrintable(theatre.story()), patience);
        QTRY_VERIFY_WITH_TIMEOUT(bandSays(theatre, QStringLiteral("No alarm sound: ")), patience);
        if (armed)
            QVERIFY2(theatre.mayMove() || theatre.heldByThisComputer(), qPrintable(theatre.story())); // it is told, and ends nothing
        theatre.releaseAll();
    }

    void aLoudspeakerThatIsThereIsNone()
    {
        GoodVoice voice;
        PuppetTheatre stage(heardBy(voice));
        QVERIFY(stage.theatre.openAll());
        QVERIFY2(stage.theatre.makeReady(), qPrintable(stage.theatre.story()));
        QVERIFY(present(stage.theatre, C::SoundFailed) == nullptr);
        Q_EMIT voice.troubleChanged(QStringLiteral("the loudspeaker was pulled out"));
        QTRY_VERIFY_WITH_TIMEOUT(isPresent(stage.theatre, C::SoundFailed, AlarmPriority::Low), patience);
        Q_EMIT voice.troubleChanged({});
        QTRY_VERIFY_WITH_TIMEOUT(present(stage.theatre, C::SoundFailed) == nullptr, patience);
        stage.theatre.releaseAll();
    }

private:
    static void armedAndNot()
    {
        QTest::addColumn<bool>("armed");
        QTest::newRow("not armed") << false;
        QTest::newRow("armed") << true;
    }
};

QTEST_MAIN(AlarmConsoleTest)
#include "alarm_console_test.moc"
