// A console whose keys and mouse come over a remote desktop: what it shows is shown, and nothing that is pressed there moves the robot or
// turns the beam on. Tried through its own window, and seen at the robot and at the X-ray system.
//
// That input which becomes remote ends motion is tried by system.never_possible.
#include "environment_value.hpp"
#include "never_possible_stage.hpp"
#include "widgets/theme.hpp"

#include <QApplication>

using namespace console;
using console::test::logTells;
using console::test::puppetWishes;
using console::test::Theatre;
using Stage = console::test::NeverStage;

namespace {

constexpr int patience = Theatre::patience;

Theatre::Wishes remoteWishes()
{
    auto wishes = puppetWishes();
    wishes.remoteInput = QStringLiteral("XRDP");
    return wishes;
}

GuardLine handLine(const Stage& stage) { return stage.theatre.models().permit.checklist().at(std::size_t(Guard::HandAlive)); }

/// Waits until all conditions are met but the hand's: the beam is somebody else's, beside the patient.
bool lacksTheHandAlone(Stage& stage)
{
    stage.xray.setBeam(true);
    stage.theatre.acknowledgeAlarms();
    stage.theatre.testAlarms();
    const auto& permit = stage.theatre.models().permit;
    return QTest::qWaitFor([&] { return permit.unmetCount() == 1 && !handLine(stage).met; }, patience);
}

bool hasScreen = false; ///< as Qt tells: without one no input comes from anywhere, and this test runs without one

/// What a console finds that is started in a session of a remote desktop.
class RemoteSession {
public:
    RemoteSession() { hasScreen = true; }
    ~RemoteSession() { hasScreen = false; }
    Q_DISABLE_COPY_MOVE(RemoteSession)

private:
    liena::test::EnvironmentValue m_mark{"XRDP_SESSION", QStringLiteral("1")};
};

} // namespace

// Stands before Qt's own.
QString QGuiApplication::platformName() { return hasScreen ? QStringLiteral("xcb") : QStringLiteral("offscreen"); }

class NeverRemoteTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void initTestCase() { theme::apply(*qobject_cast<QApplication*>(QCoreApplication::instance())); }

    void init()
    {
        m_stage = std::make_unique<Stage>(remoteWishes());
        QVERIFY2(m_stage->open(), qPrintable(m_stage->theatre.story()));
    }

    void cleanup() { m_stage.reset(); }

    // Rule 7.

    void aPedalOverRemoteDesktopTurnsNoBeamOn_data() { byKeyAndMouse(); }

    void aPedalOverRemoteDesktopTurnsNoBeamOn()
    {
        QFETCH(bool, mouse);
        Stage& stage = *m_stage;
        auto& theatre = stage.theatre;
        auto* pedal = stage.pedal();
        QVERIFY(pedal != nullptr);
        const auto press = [&] { mouse ? QTest::mousePress(pedal, Qt::LeftButton) : theatre.hold(Qt::Key_F); };
        const auto letGo = [&] { mouse ? QTest::mouseRelease(pedal, Qt::LeftButton) : theatre.release(Qt::Key_F); };
        press();
        QVERIFY2(logTells(theatre, QStringLiteral("the X-ray pedal counts at the console itself only, and this is remote input (XRDP)")),
                 qPrintable(theatre.story()));
        QVERIFY2(stage.staysUnarmed(150), qPrintable(theatre.story()));
        QCOMPARE(stage.xray.pedalsHeard(), 0);
        QVERIFY(!theatre.models().xray.pedalDown() && !theatre.models().xray.beamOn());
        QCOMPARE(theatre.models().picture.paintedCount(), quint64{0});
        letGo();

        theatre.cockpit->setInputOrigin({}); // at the console itself the same press counts
        press();
        QTRY_VERIFY2_WITH_TIMEOUT(stage.xray.pedalsHeard() > 0 && theatre.models().xray.beamOn(), qPrintable(theatre.story()), patience);
        letGo();
    }

    void nobodyArmsOverRemoteDesktop_data() { byKeyAndMouse(); }

    void nobodyArmsOverRemoteDesktop()
    {
        QFETCH(bool, mouse);
        Stage& stage = *m_stage;
        auto& theatre = stage.theatre;
        QVERIFY2(lacksTheHandAlone(stage), qPrintable(theatre.story()));
        QCOMPARE(handLine(stage).text, QStringLiteral("Remote input: XRDP"));
        auto* arm = stage.arm();
        QVERIFY(arm != nullptr);
        mouse ? QTest::mousePress(arm, Qt::LeftButton) : theatre.hold(Qt::Key_R);
        QVERIFY2(stage.staysUnarmed(320), qPrintable(theatre.story()));
        QCOMPARE(stage.robot.armRequests(), 0);
        if (mouse)
            QTest::mouseRelease(arm, Qt::LeftButton);

        // Nor does the dead-man do anything, with ARM still held or not.
        theatre.hold(Qt::Key_D);
        theatre.hold(Qt::Key_Up);
        QVERIFY2(stage.staysUnarmed(100), qPrintable(theatre.story()));
        QCOMPARE(stage.robot.movements() + stage.robot.engagedAtRest(), 0);
        theatre.releaseAll();

        theatre.cockpit->setInputOrigin({}); // at the console itself the same hand has it
        stage.xray.setBeam(false);
        QVERIFY2(theatre.armAndMove(), qPrintable(theatre.story()));
        theatre.releaseAll();
    }

    /// Nobody tells it here: it sees by itself what it is started in.
    void aConsoleThatIsStartedInARemoteSessionKnowsIt()
    {
        m_stage.reset();
        {
            const RemoteSession session;
            m_stage = std::make_unique<Stage>(puppetWishes());
        }
        Stage& stage = *m_stage;
        auto& theatre = stage.theatre;
        QVERIFY2(stage.open(), qPrintable(theatre.story()));
        QVERIFY2(lacksTheHandAlone(stage), qPrintable(theatre.story()));
        QCOMPARE(handLine(stage).text, QStringLiteral("Remote input: XRDP"));
        theatre.hold(Qt::Key_R);
        QVERIFY2(stage.staysUnarmed(320), qPrintable(theatre.story()));
        QCOMPARE(stage.robot.armRequests(), 0);
        theatre.releaseAll();
    }

private:
    static void byKeyAndMouse()
    {
        QTest::addColumn<bool>("mouse");
        QTest::newRow("key") << false;
        QTest::newRow("mouse") << true;
    }

    std::unique_ptr<Stage> m_stage;
};

QTEST_MAIN(NeverRemoteTest)
#include "never_remote_test.moc"
