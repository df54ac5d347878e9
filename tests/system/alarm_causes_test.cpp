// Alarms of the whole console by what causes them: what a robot and an X-ray system really send, or leave out, and what becomes of it.
//
// Those whose cause is a device that dies or a person beside it are tried by system.alarm_losses, one that is over in a moment by
// system.alarm_moments, those of a line by system.alarm_lines and system.alarm_round_trip, those of this computer by system.alarm_console,
// how urgent each is while nothing is armed by system.alarm_priorities; and a disk, a loudspeaker and a watchdog apart from the window by
// unit.disk_room, unit.alarm_service, unit.alarm_sounder and system.watchdog.
#include "alarm_stage.hpp"
#include "shown_alarms.hpp"
#include "widgets/theme.hpp"

#include <QApplication>
#include <QDeadlineTimer>
#include <QFile>
#include <QTest>

#include <filesystem>
#include <stdexcept>

using namespace console;
using console::test::isPresent;
using console::test::present;
using console::test::puppetWishes;
using console::test::Theatre;
using liena::Message;
using liena::test::PuppetRobot;
using liena::test::PuppetXray;
using C = AlarmCondition;

namespace {

constexpr int patience = Theatre::patience;

struct Stage : console::test::AlarmStage {
    const Alarm* alarm(C condition) const { return present(theatre, condition); }
};

struct Cause {
    const char* name;
    C condition;
    AlarmPriority priority; ///< while armed
    void (*make)(Stage&);
    void (*end)(Stage&);
};

void truth(Stage& stage)
{
    stage.robot.alterStatus({});
    stage.robot.alterTip({});
    stage.robot.setTipSilent(false);
    stage.robot.alterDrives({});
    stage.xray.alterStatus({});
    stage.xray.alterFrame({});
}

void robotSays(Stage& stage, PuppetRobot::Alter what) { stage.robot.alterStatus(std::move(what)); }

void endRoadmap(Stage& stage)
{
    truth(stage);
    stage.endRoadmap();
}

/// Until it is told; armed again where a busy computer ended that first.
void turnDriveOff(Stage& stage)
{
    const QDeadlineTimer deadline(3 * patience);
    const auto told = [&stage] { return stage.alarm(C::DriveFault) != nullptr; };
    while (!told() && !deadline.hasExpired()) {
        stage.robot.alterDrives({});
        if (!stage.theatre.mayMove() && !stage.theatre.armAndMove())
            return;
        stage.robot.alterDrives([](Message& m) { m.set("enabled", std::vector<double>{1, 0, 1, 1}); });
        (void)QTest::qWaitFor([&] { return told() || stage.theatre.heldByThisComputer(); }, patience);
    }
}

/// By a hold that is long enough; armed again where a busy computer ended that first.
void beginInjection(Stage& stage)
{
    auto& theatre = stage.theatre;
    const QDeadlineTimer deadline(3 * patience);
    const auto injecting = [&theatre] { return theatre.models().instrument.injecting(); };
    stage.robot.setInjector(true);
    while (!injecting() && !deadline.hasExpired()) {
        if (!theatre.mayMove() && !theatre.arm())
            return;
        theatre.release(Qt::Key_Up);
        theatre.release(Qt::Key_D);
        theatre.hold(Qt::Key_G);
        (void)QTest::qWaitFor([&] { return injecting() || !theatre.mayMove(); }, patience);
    }
}

const std::vector<Cause>& causes()
{
    static const std::vector<Cause> all{
        {"2 the robot lives and does not confirm its hold", C::HoldNotConfirmed, AlarmPriority::High,
         [](Stage& s) {
             robotSays(s, [](Message& m) { m.set("hold_confirmed", false); });
             s.theatre.strike(Qt::Key_F12);
         },
         truth},
        {"3 the picture freezes", C::PictureStale, AlarmPriority::High, [](Stage& s) { s.xray.show(PuppetXray::Pictures::None); },
         [](Stage& s) { s.xray.show(PuppetXray::Pictures::Good); }},
        {"5 force at the stop", C::ForceStop, AlarmPriority::High, [](Stage& s) { s.robot.setForce(2.3); },
         [](Stage& s) { s.robot.setForce(0); }},
        {"5 force at the warning", C::ForceWarn, AlarmPriority::Medium, [](Stage& s) { s.robot.setForce(1.4); },
         [](Stage& s) { s.robot.setForce(0); }},
        {"6 a drive fails", C::DriveFault, AlarmPriority::High,
         [](Stage& s) { robotSays(s, [](Message& m) { m.set("fault_code", 2).set("state", std::string_view("Fault")); }); }, truth},
        {"6 a drive is off while it is armed", C::DriveFault, AlarmPriority::High, turnDriveOff, truth},
        {"6 the arm fails", C::DriveFault, AlarmPriority::High, [](Stage& s) { s.arm.setFault(true); },
         [](Stage& s) { s.arm.setFault(false); }},
        {"7 emergency stop at the other site", C::EmergencyStop, AlarmPriority::High,
         [](Stage& s) {
             robotSays(s, [](Message& m) { m.set("emergency_stop_token", 77U).set("state", std::string_view("EmergencyStop")); });
         },
         truth},
        {"11 the tracker loses the tip", C::TrackerStale, AlarmPriority::Medium,
         [](Stage& s) { s.robot.alterTip([](Message& m) { m.set("valid", false); }); }, truth},
        {"11 the tracker is silent", C::TrackerStale, AlarmPriority::Medium, [](Stage& s) { s.robot.setTipSilent(true); }, truth},
        {"12 the table moves under a roadmap", C::RoadmapRemoved, AlarmPriority::Low,
         [](Stage& s) {
             (void)s.makeRoadmap();
             s.xray.alterStatus([](Message& m) { m.set("table_position", std::vector<double>{0, 5, 0}); });
         },
         endRoadmap},
        {"12 the C-arm turns under a roadmap", C::RoadmapRemoved, AlarmPriority::Low,
         [](Stage& s) {
             (void)s.makeRoadmap();
             s.xray.alterFrame([](Message& m) { m.set("primary_angle", 3.0); });
         },
         endRoadmap},
        {"12 the detector moves under a roadmap", C::RoadmapRemoved, AlarmPriority::Low,
         [](Stage& s) {
             (void)s.makeRoadmap();
             s.xray.alterFrame([](Message& m) { m.set("source_detector_distance", 1100.0); });
         },
         endRoadmap},
        {"12 the zoom changes under a roadmap", C::RoadmapRemoved, AlarmPriority::Low,
         [](Stage& s) {
             (void)s.makeRoadmap();
             s.xray.alterFrame([](Message& m) { m.set("imager_pixel_spacing", 0.2); });
         },
         endRoadmap},
        {"12 the patient moves under a roadmap", C::RoadmapRemoved, AlarmPriority::Low,
         [](Stage& s) {
             (void)s.makeRoadmap();
             s.xray.show(PuppetXray::Pictures::Good); // the contrast is gone, which alone is no displacement
             s.xray.movePatient(6);
         },
         [](Stage& s) {
             s.xray.movePatient(0);
             endRoadmap(s);
         }},
        {"13 contrast runs low", C::ContrastLow, AlarmPriority::Low,
         [](Stage& s) { robotSays(s, [](Message& m) { m.set("contrast_remaining", 3.0); }); }, truth},
        {"13 contrast runs out during an injection", C::ContrastEmpty, AlarmPriority::Medium,
         [](Stage& s) {
             beginInjection(s);
             s.robot.setContrast(0); // it stops with that, and tells both in one turn
         },
         [](Stage& s) {
             s.robot.setInjector(false);
             s.robot.setContrast(80);
         }},
        {"15 soft limit", C::SoftLimit, AlarmPriority::Low, [](Stage& s) { robotSays(s, [](Message& m) { m.set("limit_switches", 2U); }); },
         truth},
        {"15 hard limit", C::HardLimit, AlarmPriority::Medium,
         [](Stage& s) { robotSays(s, [](Message& m) { m.set("limit_switches", 8U); }); }, truth},
        {"a report is overdue", C::DeadlineMissed, AlarmPriority::Medium, [](Stage& s) { s.robot.setSilent(true); },
         [](Stage& s) { s.robot.setSilent(false); }},
        {"9 the link is suspect three times", C::LinkUnsteady, AlarmPriority::Low,
         [](Stage& s) {
             const auto suspect = [&s] { return s.theatre.link("robot") == LinkState::Suspect; };
             for (int i = 0; i < 3; ++i) {
                 s.robot.standStill(std::chrono::milliseconds(600)); // suspect after 500 ms of silence, lost after 800
                 (void)QTest::qWaitFor(suspect, patience);
                 (void)QTest::qWaitFor([&] { return !suspect(); }, patience);
             }
         },
         truth},
        {"14 three gray of air kerma", C::AirKerma, AlarmPriority::Low,
         [](Stage& s) { s.xray.alterStatus([](Message& m) { m.set("air_kerma", 3100.0); }); }, truth},
        {"14 five gray of air kerma", C::AirKerma, AlarmPriority::Medium,
         [](Stage& s) { s.xray.alterStatus([](Message& m) { m.set("air_kerma", 5100.0); }); }, truth},
        {"five minutes of fluoroscopy", C::FluoroscopyTime, AlarmPriority::Low,
         [](Stage& s) { s.xray.alterStatus([](Message& m) { m.set("fluoroscopy_time", 301.0); }); }, truth},
    };
    return all;
}

/// A copy with one text in place of another; throws where that does not stand.
void copyWith(const std::filesystem::path& from, const std::filesystem::path& to, const QByteArray& text, const QByteArray& other)
{
    QFile source(QString::fromStdString(from.string()));
    QFile copy(QString::fromStdString(to.string()));
    auto bytes = source.open(QIODevice::ReadOnly) ? source.readAll() : QByteArray();
    const bool found = bytes.contains(text);
    bytes.replace(text, other);
    if (!found || !copy.open(QIODevice::WriteOnly) || copy.write(bytes) != bytes.size())
        throw std::runtime_error("cannot make " + to.string());
}

void giveAnotherTopology(Theatre& theatre, liena::Settings& settings)
{
    const auto other = theatre.files.folder() / "another.xml";
    copyWith(settings.topology, other, "name=\"test\"", "name=\"another\"");
    settings.topology = other;
}

/// Its commands may be faster than ours.
void giveAnotherSet(Theatre& theatre, liena::Settings& settings)
{
    const auto folder = theatre.files.folder() / "other-sets";
    const auto& usual = settings.registry.front();
    std::filesystem::copy(usual, folder, std::filesystem::copy_options::recursive);
    std::filesystem::remove(folder / "vascular-robot.xml");
    copyWith(usual / "vascular-robot.xml", folder / "vascular-robot.xml", "min=\"-40\" max=\"40\"", "min=\"-41\" max=\"41\"");
    settings.registry = {folder};
}

} // namespace

class AlarmCausesTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void initTestCase()
    {
        theme::apply(*qobject_cast<QApplication*>(QCoreApplication::instance()));
        m_stage = std::make_unique<Stage>();
        QVERIFY(m_stage->theatre.openAll());
    }

    void cleanupTestCase() { m_stage.reset(); }

    void whatHappensWhileTheRobotMovesIsAnAlarm_data()
    {
        QTest::addColumn<int>("number");
        for (std::size_t i = 0; i < causes().size(); ++i)
            QTest::newRow(causes()[i].name) << int(i);
    }

    void whatHappensWhileTheRobotMovesIsAnAlarm()
    {
        QFETCH(int, number);
        const Cause& cause = causes().at(std::size_t(number));
        Stage& stage = *m_stage;
        truth(stage); // whatever became of the row before
        QVERIFY2(stage.theatre.armAndMove(), qPrintable(stage.theatre.story()));
        // What another cause left behind is told for some seconds.
        QTRY_VERIFY2_WITH_TIMEOUT(stage.alarm(cause.condition) == nullptr, qPrintable(stage.theatre.story()), patience);
        cause.make(stage);
        QTRY_VERIFY2_WITH_TIMEOUT(stage.alarm(cause.condition) != nullptr, qPrintable(stage.theatre.story()), patience);
        QVERIFY2(stage.alarm(cause.condition)->priority == cause.priority, qPrintable(stage.theatre.story()));
        cause.end(stage);
        stage.theatre.releaseAll();
        const bool forAWhile = cause.condition == C::LinkUnsteady || cause.condition == C::DeadlineMissed;
        if (!forAWhile)
            QTRY_VERIFY2_WITH_TIMEOUT(stage.alarm(cause.condition) == nullptr, qPrintable(stage.theatre.story()), patience);
    }

    /// 3, before the first picture since the console was started.
    void aRunWithoutAnyPictureIsAnAlarm()
    {
        Stage stage;
        stage.xray.show(PuppetXray::Pictures::None);
        QVERIFY(stage.theatre.openAll());
        stage.theatre.hold(Qt::Key_F);
        const auto told = [&stage] { return isPresent(stage.theatre, C::PictureStale, AlarmPriority::Low); };
        QTRY_VERIFY2_WITH_TIMEOUT(told(), qPrintable(stage.theatre.story()), patience);
        QCOMPARE(stage.theatre.models().picture.paintedCount(), quint64(0));
        stage.xray.show(PuppetXray::Pictures::Good);
        QTRY_VERIFY2_WITH_TIMEOUT(stage.alarm(C::PictureStale) == nullptr, qPrintable(stage.theatre.story()), patience);
        stage.theatre.releaseAll();
    }

    /// 14.
    void eachFurtherGrayDemandsAttentionAnew()
    {
        Stage stage;
        QVERIFY(stage.theatre.openAll());
        const auto reaches = [&stage](double milligrays, int grays, AlarmPriority priority) {
            stage.xray.alterStatus([milligrays](Message& m) { m.set("air_kerma", milligrays); });
            const auto told = [&] {
                const auto* alarm = stage.alarm(C::AirKerma);
                return alarm != nullptr && alarm->text.endsWith(QStringLiteral(" %1 Gy").arg(grays)) && alarm->priority == priority &&
                       !alarm->acknowledged;
            };
            return QTest::qWaitFor(told, patience);
        };
        const auto acknowledge = [&stage] {
            if (auto* button = stage.theatre.button(QStringLiteral("Acknowledge")); button != nullptr && button->isEnabled())
                QTest::mouseClick(button, Qt::LeftButton); // others may come first
            return stage.alarm(C::AirKerma)->acknowledged;
        };
        QVERIFY(stage.alarm(C::AirKerma) == nullptr);
        QVERIFY2(reaches(3050, 3, AlarmPriority::Low), qPrintable(stage.theatre.story()));
        QTRY_VERIFY2_WITH_TIMEOUT(acknowledge(), qPrintable(stage.theatre.story()), patience);
        stage.xray.alterStatus([](Message& m) { m.set("air_kerma", 3950.0); });
        QTRY_COMPARE_WITH_TIMEOUT(stage.theatre.models().xray.status().value.airKerma, 3950.0, patience);
        QVERIFY(stage.alarm(C::AirKerma)->acknowledged); // it is still the third
        QVERIFY2(reaches(4050, 4, AlarmPriority::Low), qPrintable(stage.theatre.story()));
        QTRY_VERIFY2_WITH_TIMEOUT(acknowledge(), qPrintable(stage.theatre.story()), patience);
        QVERIFY2(reaches(5050, 5, AlarmPriority::Medium), qPrintable(stage.theatre.story()));
        QTRY_VERIFY2_WITH_TIMEOUT(acknowledge(), qPrintable(stage.theatre.story()), patience);
        QVERIFY2(reaches(6050, 6, AlarmPriority::Medium), qPrintable(stage.theatre.story()));
    }

    /// 19: the robot was started with a topology, or a message set, of its own.
    void aRobotOfAnotherSystemIsAnAlarm_data()
    {
        QTest::addColumn<bool>("topology");
        QTest::newRow("topology") << true;
        QTest::newRow("message set") << false;
    }

    void aRobotOfAnotherSystemIsAnAlarm()
    {
        QFETCH(bool, topology);
        Theatre theatre(puppetWishes());
        PuppetXray xray(theatre.files.settingsOf("xray"));
        auto settings = theatre.files.settingsOf("robot");
        topology ? giveAnotherTopology(theatre, settings) : giveAnotherSet(theatre, settings);
        PuppetRobot robot(settings);
        QVERIFY(QTest::qWaitForWindowActive(&theatre.window()));
        theatre.strike(Qt::Key_F2);
        QVERIFY(theatre.click(QStringLiteral("Open all")));
        const auto differs = [&theatre] { return isPresent(theatre, C::SystemDiffers, AlarmPriority::Medium); };
        QTRY_VERIFY2_WITH_TIMEOUT(differs(), qPrintable(theatre.story()), patience);
        QCOMPARE(theatre.link("robot"), LinkState::Closed);
        theatre.strike(Qt::Key_F1);
        theatre.hold(Qt::Key_R);
        QVERIFY(!theatre.reaches(PermitPhase::Arming, Theatre::twiceArmHold));
        QCOMPARE(robot.armRequests(), 0);
        theatre.releaseAll();
    }

private:
    std::unique_ptr<Stage> m_stage;
};

QTEST_MAIN(AlarmCausesTest)
#include "alarm_causes_test.moc"
