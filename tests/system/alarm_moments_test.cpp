// Alarms of what is over before anybody looks for alarms again: where it ended motion, it is told all the same. The console's own control
// and link, and a robot that can be armed; pictures are painted by hand, so that each is as old as the test says.
#include "app/cockpit_control.hpp"
#include "link/system_link.hpp"
#include "puppet_devices.hpp"
#include "test_system.hpp"

#include <QDeadlineTimer>
#include <QTest>
#include <QTimer>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <thread>
#include <vector>

using namespace console;
using namespace std::chrono_literals;
using liena::test::PuppetRobot;
using liena::test::PuppetXray;
using liena::test::TestSystem;
namespace reference = liena::test::reference;

namespace {

constexpr int patience = 30000;
constexpr int tries = 5;
constexpr auto young = 20ms;
constexpr auto between = 40ms; ///< two pictures

class NoPictures : public FrameSink {
public:
    void showFrame(std::shared_ptr<const XrayFrame> /*frame*/) override {}
};

TestSystem::Options forBusyComputers()
{
    TestSystem::Options options;
    options.lateCommands = true;
    return options;
}

LinkSettings linkSettings(TestSystem& system)
{
    const auto text = [](const std::filesystem::path& path) { return QString::fromStdString(path.string()); };
    const auto own = system.settingsOf("cockpit");
    LinkSettings settings;
    settings.topology = text(own.topology);
    settings.device = QStringLiteral("cockpit");
    settings.registry = {text(system.registry())};
    settings.store = text(own.store);
    settings.certificate = text(own.certificate);
    settings.key = text(own.key);
    settings.authority = text(own.authority);
    return settings;
}

struct Stage {
    TestSystem files{{reference::cockpit, reference::robot, reference::xray}, {"cockpit robot", "cockpit xray"}, forBusyComputers()};
    PuppetRobot robot{files.settingsOf("robot")};
    PuppetXray xray{files.settingsOf("xray")};
    Options options;
    ConsoleModels models;
    NoPictures sink;
    HandDesk hand{options, models};
    std::unique_ptr<SystemLink> link;
    std::unique_ptr<CockpitControl> control;
    QTimer painter;
    std::vector<Alarm> raised; ///< since motion was to end

    Stage()
    {
        models.picture.setProfile(PictureProfile::Coronary);
        models.recorder.logKept = true;
        xray.show(PuppetXray::Pictures::None);
        QString error;
        link = SystemLink::create(linkSettings(files), models, sink, &error);
        if (!link)
            throw std::runtime_error(error.toStdString());
        control = std::make_unique<CockpitControl>(models, *link, hand);
        painter.setTimerType(Qt::PreciseTimer);
        QObject::connect(&painter, &QTimer::timeout, &painter, [this] { paint(young); });
        QObject::connect(&models.alarms, &AlarmList::raised, &painter, [this](quint64 id) { noteRaised(id); });
        link->start();
        control->setHandHasKeys(true);
        control->start();
        painter.start(between);
    }

    ~Stage()
    {
        control->stop();
        link->stop();
    }

    PermitPhase phase() const { return models.permit.phase(); }
    Duration limit() const { return models.picture.limit(); }

    void paint(Duration age)
    {
        PictureStamp stamp;
        stamp.frame = ++m_frame;
        stamp.captureNs = m_frame;
        stamp.source = PictureSource::Simulated;
        stamp.painted = stamp.arrived = std::chrono::steady_clock::now();
        stamp.captured = stamp.painted - age;
        models.picture.notePainted(stamp);
    }

    bool open()
    {
        link->openAll();
        return QTest::qWaitFor([this] { return models.sessions.allOpen(); }, patience);
    }

    void testAlarms()
    {
        auto now = std::chrono::steady_clock::now();
        models.selfTest.begin(now);
        while (models.selfTest.signal())
            models.selfTest.update(false, now += AlarmSelfTest::whole.high);
        models.selfTest.confirm();
    }

    /// Everything that a hand does until it moves the robot, as often as a condition fails on the way.
    bool engage()
    {
        const QDeadlineTimer deadline(3 * patience);
        while (!engageOnce())
            if (deadline.hasExpired())
                return false;
        return true;
    }

    /// The control has just done so: a tenth of a second passes before it does again. It notes the figures in the same turn.
    bool looksForAlarms()
    {
        const auto age = models.trends.latest(TrendFigure::PictureAge);
        return QTest::qWaitFor([&] { return models.trends.latest(TrendFigure::PictureAge) != age; }, patience);
    }

    /// Engages and ends motion that way, again where it ended by something else: a busy computer has several reasons.
    bool endsMotion(void (Stage::*how)(), bool (Stage::*asWanted)() const)
    {
        for (int i = 0; i < tries; ++i) {
            if (!engage() || !looksForAlarms())
                return false;
            if (phase() != PermitPhase::Engaged)
                continue;
            raised.clear();
            (this->*how)();
            const bool held = reaches(PermitPhase::Hold);
            paint(young);
            painter.start(between);
            if (held && (this->*asWanted)())
                return true;
        }
        return false;
    }

    /// By 30 ms, and what comes after it is in time.
    void paintOneLate()
    {
        painter.stop();
        paint(limit() + 30ms);
    }

    /// The picture is young enough when this thread looks, too old for the last check before the wire, and replaced when this one looks
    /// again.
    void closeGate()
    {
        painter.stop();
        paint(limit() - 30ms);
        Q_EMIT hand.lifeChanged(); // every guard is looked at, and what is shown is handed over
        const QDeadlineTimer deadline(patience);
        while (phase() == PermitPhase::Engaged && !link->blockedPermit() && !deadline.hasExpired())
            std::this_thread::yield();
        paint(young);
    }

    bool gateClosed() const { return models.permit.state().cause == HoldCause::GateClosed; }

    /// Found by the guards, or by the last check before them.
    bool pictureFroze() const
    {
        return gateClosed() || (models.permit.state().cause == HoldCause::GuardFailed &&
                                models.permit.holdReasons().contains(QStringLiteral("Picture: FROZEN")));
    }

    /// In the log, whatever has become of it since.
    bool pictureIsTold() const
    {
        const auto& log = models.alarms.log();
        return std::any_of(raised.begin(), raised.end(), [&log](const Alarm& alarm) {
            const QString line = QStringLiteral("raised: ") + alarm.text;
            return alarm.condition == AlarmCondition::PictureStale && alarm.priority == AlarmPriority::High &&
                   std::any_of(log.begin(), log.end(), [&line](const AlarmLogEntry& entry) { return entry.text == line; });
        });
    }

    QString story() const
    {
        QString text = word(phase()) + QStringLiteral(": ") + models.permit.holdReasons().join(QStringLiteral(" · ")) + QLatin1Char('\n') +
                       models.permit.unmetText(9) + QLatin1Char('\n');
        for (const auto& entry : models.alarms.log())
            text += word(entry.priority) + QLatin1Char(' ') + entry.text + QLatin1Char('\n');
        return text;
    }

private:
    bool reaches(PermitPhase wanted)
    {
        return QTest::qWaitFor([&] { return phase() == wanted; }, 6000);
    }

    bool engageOnce()
    {
        auto& keys = hand.keyboard();
        keys.releaseAll();
        const auto alarms = models.alarms.alarms();
        for (const auto& alarm : alarms)
            models.alarms.acknowledge(alarm.id, 0);
        keys.press(Qt::Key_F);
        if (!reaches(PermitPhase::Ready))
            return false;
        keys.press(Qt::Key_R);
        if (!reaches(PermitPhase::Armed))
            return false;
        keys.release(Qt::Key_R);
        keys.press(Qt::Key_D);
        const int heard = robot.engagedAtRest();
        const auto commanded = [&] { return robot.engagedAtRest() > heard + 10; };
        return reaches(PermitPhase::Engaged) && QTest::qWaitFor([&] { return commanded() || phase() != PermitPhase::Engaged; }, patience) &&
               phase() == PermitPhase::Engaged;
    }

    void noteRaised(quint64 id)
    {
        const auto& alarms = models.alarms.alarms();
        const auto found = std::find_if(alarms.begin(), alarms.end(), [id](const Alarm& alarm) { return alarm.id == id; });
        if (found != alarms.end())
            raised.push_back(*found);
    }

    quint32 m_frame = 0;
};

} // namespace

class AlarmMomentsTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void init()
    {
        m_stage = std::make_unique<Stage>();
        QVERIFY(m_stage->open());
        m_stage->testAlarms();
    }

    void cleanup() { m_stage.reset(); }

    // 3 of the table of alarms.

    void onePictureThatCameTooLateIsToldWhereItEndedMotion()
    {
        QVERIFY2(m_stage->endsMotion(&Stage::paintOneLate, &Stage::pictureFroze), qPrintable(m_stage->story()));
        QTRY_VERIFY2_WITH_TIMEOUT(m_stage->pictureIsTold(), qPrintable(m_stage->story()), 5000);
    }

    void aPictureThatWasTooOldForTheLastCheckAloneIsToldToo()
    {
        QVERIFY2(m_stage->endsMotion(&Stage::closeGate, &Stage::gateClosed), qPrintable(m_stage->story()));
        QTRY_VERIFY2_WITH_TIMEOUT(m_stage->pictureIsTold(), qPrintable(m_stage->story()), 5000);
    }

private:
    std::unique_ptr<Stage> m_stage;
};

QTEST_GUILESS_MAIN(AlarmMomentsTest)
#include "alarm_moments_test.moc"
