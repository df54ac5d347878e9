// A console whose keys and mouse come over a remote desktop: what it shows is shown, and nothing that is pressed there moves the robot or
// turns the beam on. Tried through its own window, and seen at the robot and at the X-ray system.
//
// That input which becomes remote ends motion is tried by system.never_possible.
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

} // namespace

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

    /// All conditions are met but this one: the beam is somebody else's, beside the patient.
    void nobodyArmsOverRemoteDesktop_data() { byKeyAndMouse(); }

    void nobodyArmsOverRemoteDesktop()
    {
        QFETCH(bool, mouse);
        Stage& stage = *m_stage;
        auto& theatre = stage.theatre;
        stage.xray.setBeam(true);
        theatre.acknowledgeAlarms();
        theatre.testAlarms();
        const auto& permit = theatre.models().permit;
        QTRY_VERIFY2_WITH_TIMEOUT(permit.unmetCount() == 1 && !handLine(stage).met, qPrintable(theatre.story()), patience);
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
