// What must never be possible while something is not as it must be: an arming. It is tried through the console's own window, with pictures
// that are none to move by, and a robot and an X-ray system that lie.
#include "imaging/reference_image_view.hpp"
#include "never_possible_attempts.hpp"
#include "widgets/review_controls.hpp"

#include <QScopeGuard>

using namespace console;
using namespace console::test;
using Stage = console::test::NeverStage;

namespace {

constexpr int patience = Theatre::patience;

void pressThePedal(Stage& stage) { stage.theatre.hold(Qt::Key_F); }

const ReferenceImageView& referenceView(Stage& stage) { return *stage.theatre.window().findChild<ReferenceImageView*>(); }

/// From the oldest that is kept: beside the live picture new ones come, of a time before.
void playOldPictures(Stage& stage)
{
    auto& theatre = stage.theatre;
    const auto* controls = theatre.window().findChild<ReviewControls*>();
    (void)theatre.click(QStringLiteral("Review"), controls);
    const auto& view = referenceView(stage);
    const auto isReview = [&view] { return view.picture() && view.picture()->role == PictureRole::Review; };
    (void)QTest::qWaitFor(isReview, patience);
    const auto newest = view.picture() ? view.picture()->about.frame : 0;
    (void)theatre.click(QStringLiteral("Play"), controls);
    (void)QTest::qWaitFor([&] { return isReview() && view.picture()->about.frame != newest; }, patience);
}

void endReview(Stage& stage) { (void)stage.theatre.click(QStringLiteral("Hold"), stage.theatre.window().findChild<ReviewControls*>()); }

/// With each of these ARM is held for twice its time, and the robot hears nothing of it.
const std::vector<Attempt>& obstacles()
{
    static const std::vector<Attempt> all{
        {"picture freezes", show<Pictures::None>, show<Pictures::Good>},
        {"picture repeats itself", show<Pictures::Repeated>, show<Pictures::Good>},
        {"picture is a recording", show<Pictures::Recorded>, show<Pictures::Good>},
        {"picture is old", show<Pictures::Old>, show<Pictures::Good>},
        {"last image hold", letGoOfThePedal, pressThePedal},
        {"film of old pictures, and the pedal is up",
         [](Stage& stage) {
             letGoOfThePedal(stage);
             playOldPictures(stage);
         },
         endReview},
        {"film of old pictures, and the live one freezes",
         [](Stage& stage) {
             playOldPictures(stage);
             stage.xray.show(Pictures::None);
         },
         [](Stage& stage) {
             stage.xray.show(Pictures::Good);
             endReview(stage);
         }},
        {"robot's reports end", silence, speak},
        {"robot is armed by another",
         [](Stage& stage) {
             stage.robot.claim(RobotClaim{Said::Armed, 0, false});
         },
         beTrue},
        {"robot does not hold",
         [](Stage& stage) {
             stage.robot.claim(RobotClaim{Said::Ready, 0, false});
         },
         beTrue},
        {"force", [](Stage& stage) { stage.robot.setForce(0.5); }, [](Stage& stage) { stage.robot.setForce(0); }},
        {"remote desktop", beRemote, beHere},
        {"dead-man down", [](Stage& stage) { stage.theatre.hold(Qt::Key_D); }, [](Stage& stage) { stage.theatre.release(Qt::Key_D); }},
    };
    return all;
}

} // namespace

class NeverArmedTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void initTestCase()
    {
        m_stage = console::test::openStage();
        QVERIFY(m_stage);
    }

    void cleanupTestCase() { m_stage.reset(); }

    // Rules 4, 6 and 12.

    void nobodyArmsWith_data() { addRows(obstacles()); }

    void nobodyArmsWith()
    {
        QFETCH(int, number);
        const auto& attempt = obstacles().at(std::size_t(number));
        Stage& stage = *m_stage;
        QVERIFY2(stage.theatre.makeReady(), qPrintable(stage.theatre.story()));
        const int asked = stage.robot.armRequests();
        attempt.make(stage);
        QTRY_VERIFY2_WITH_TIMEOUT(stage.phase() != PermitPhase::Ready, qPrintable(stage.theatre.story()), patience);
        stage.theatre.hold(Qt::Key_R);
        QVERIFY2(stage.staysUnarmed(320), qPrintable(stage.theatre.story()));
        stage.theatre.release(Qt::Key_R);
        QCOMPARE(stage.robot.armRequests(), asked);
        attempt.undo(stage);
        stage.theatre.releaseAll();
    }

    /// What is shown of a time before, as a still or as a film, stands for no live picture; and beside a live one it bars nothing.
    void aStillAndAFilmOfOldPicturesStandForNoLiveOne()
    {
        Stage& stage = *m_stage;
        auto& theatre = stage.theatre;
        const auto& models = theatre.models();
        QVERIFY2(theatre.makeReady(), qPrintable(theatre.story()));
        letGoOfThePedal(stage);
        QCOMPARE(conditionOf(stage), PictureCondition::Held);
        const auto live = [&models] { return models.permit.checklist().at(std::size_t(Guard::PictureLive)); };
        QTRY_COMPARE_WITH_TIMEOUT(live().text, QStringLiteral("Picture: LAST IMAGE HOLD"), patience);
        // All but this one.
        QTRY_VERIFY2_WITH_TIMEOUT(models.permit.unmetCount() == 1 && !live().met, qPrintable(theatre.story()), patience);
        QVERIFY(stage.settles()); // whatever of the run was still on its way is painted
        const auto painted = models.picture.paintedCount();
        playOldPictures(stage);
        QVERIFY2(referenceView(stage).picture()->role == PictureRole::Review, qPrintable(theatre.story()));
        const int asked = stage.robot.armRequests();
        theatre.hold(Qt::Key_R);
        QVERIFY2(stage.staysUnarmed(320), qPrintable(theatre.story()));
        theatre.release(Qt::Key_R);
        QCOMPARE(stage.robot.armRequests(), asked);
        QCOMPARE(models.picture.paintedCount(), painted);
        QCOMPARE(conditionOf(stage), PictureCondition::Held);
        QVERIFY2(theatre.arm(), qPrintable(theatre.story())); // with the pedal down again, and the review open all the time
        QCOMPARE(referenceView(stage).picture()->role, PictureRole::Review);
        endReview(stage);
        theatre.releaseAll();
    }

    /// Its alarm, acknowledged or not, is none that bars an arming.
    void nobodyArmsOrMovesBesideAnArmInFault()
    {
        const auto back = qScopeGuard([this] { m_stage->comeToTheFront(); });
        auto wishes = puppetWishes();
        wishes.arm = true;
        Stage stage(wishes);
        liena::test::PuppetArm arm(stage.theatre.files.settingsOf("arm"));
        QVERIFY(stage.open());
        const auto& permit = stage.theatre.models().permit;
        QVERIFY2(stage.theatre.armAndMove(), qPrintable(stage.theatre.story()));
        arm.setFault(true);
        QTRY_VERIFY2_WITH_TIMEOUT(!stage.mayMove(), qPrintable(stage.theatre.story()), patience);
        QVERIFY2(permit.holdReasons().contains(QStringLiteral("Robotic arm: fault")), qPrintable(stage.theatre.story()));
        stage.theatre.releaseAll();
        QVERIFY2(stage.theatre.reaches(PermitPhase::Standby), qPrintable(stage.theatre.story()));
        QTRY_VERIFY_WITH_TIMEOUT(stage.theatre.models().alarms.unacknowledgedHigh(), patience);
        stage.theatre.acknowledgeAlarms();
        stage.theatre.testAlarms();
        QVERIFY2(stage.theatre.models().selfTest.passed(), qPrintable(stage.theatre.story()));
        stage.theatre.hold(Qt::Key_F);
        // All but this one.
        QTRY_VERIFY2_WITH_TIMEOUT(permit.unmetCount() == 1, qPrintable(stage.theatre.story()), patience);
        QVERIFY(!permit.checklist().at(std::size_t(Guard::DrivesHealthy)).met);
        const int asked = stage.robot.armRequests();
        stage.theatre.hold(Qt::Key_R);
        QVERIFY2(stage.staysUnarmed(320), qPrintable(stage.theatre.story()));
        QCOMPARE(stage.robot.armRequests(), asked);
        stage.theatre.releaseAll();
        arm.setFault(false);
        QVERIFY2(stage.theatre.armAndMove(), qPrintable(stage.theatre.story())); // and it was that alone
        stage.theatre.releaseAll();
    }

    void aPermitThatWasSpentArmsNoMore()
    {
        Stage& stage = *m_stage;
        QVERIFY2(stage.theatre.armAndMove(), qPrintable(stage.theatre.story()));
        // The robot goes on naming the permit of the armed time, and says that it is ready again.
        const auto spent = stage.robot.permit();
        stage.theatre.strike(Qt::Key_F12);
        QTRY_VERIFY_WITH_TIMEOUT(stage.robot.permit() != spent, patience);
        const auto back = static_cast<std::uint32_t>(spent - stage.robot.permit());
        stage.robot.claim(RobotClaim{Said::Ready, back, true});
        stage.theatre.releaseAll();
        stage.theatre.acknowledgeAlarms();
        stage.theatre.testAlarms();
        QVERIFY2(stage.theatre.models().selfTest.passed(), qPrintable(stage.theatre.story())); // it is not for want of that
        stage.theatre.hold(Qt::Key_F);
        const int asked = stage.robot.armRequests();
        stage.theatre.hold(Qt::Key_R);
        QVERIFY2(stage.staysUnarmed(320), qPrintable(stage.theatre.story()));
        QCOMPARE(stage.robot.armRequests(), asked);
        stage.robot.claim(std::nullopt);
        stage.theatre.releaseAll();
    }

    /// What was accepted was accepted for one arming, and for the force that was looked at.
    void anAcceptedForceArmsOnce()
    {
        Stage& stage = *m_stage;
        const auto force = [&stage] { return stage.theatre.models().permit.checklist().at(std::size_t(Guard::ForceNearZero)); };
        const auto meets = [&force](bool met) { return QTest::qWaitFor([&] { return force().met == met; }, patience); };
        QVERIFY2(stage.theatre.makeReady(), qPrintable(stage.theatre.story()));
        stage.robot.setForce(0.43);
        QVERIFY(meets(false));
        const auto button = [&stage] { return stage.theatre.button(QStringLiteral("Accept 0.43")); };
        const auto accept = [&] { // a press at once is not taken: nobody can have read it yet
            return QTest::qWaitFor(
                [&] {
                    if (auto* there = button(); there != nullptr)
                        QTest::mouseClick(there, Qt::LeftButton);
                    return force().met;
                },
                patience);
        };
        QVERIFY2(accept(), qPrintable(stage.theatre.story()));
        stage.robot.setForce(0.6); // another one
        QVERIFY(meets(false));
        stage.robot.setForce(0.43);
        QVERIFY(meets(true));
        auto hand = stage.theatre.keyboardHand();
        hand.letGo = [&] { // as often as a condition fails on the way
            if (button() != nullptr)
                (void)accept();
        };
        QVERIFY2(stage.theatre.armAndMove(hand), qPrintable(stage.theatre.story()));
        stage.theatre.strike(Qt::Key_F12);
        QTRY_VERIFY_WITH_TIMEOUT(!stage.mayMove(), patience);
        stage.theatre.releaseAll();
        QVERIFY2(meets(false), qPrintable(stage.theatre.story()));
        const int asked = stage.robot.armRequests();
        stage.theatre.acknowledgeAlarms();
        stage.theatre.testAlarms();
        stage.theatre.hold(Qt::Key_F);
        stage.theatre.hold(Qt::Key_R);
        QVERIFY2(stage.staysUnarmed(320), qPrintable(stage.theatre.story()));
        QCOMPARE(stage.robot.armRequests(), asked);
        stage.theatre.releaseAll();
        stage.robot.setForce(0);
    }

    /// A command is as old as the robot's heartbeat that it echoes: with one each 50 ms and a max-age of 50 ms no line is short enough.
    void nobodyArmsOverALineThatTheRobotsMaxAgeDoesNotCarry()
    {
        const auto back = qScopeGuard([this] { m_stage->comeToTheFront(); }); // another window is in front for a while
        auto slow = puppetWishes();
        slow.system.timing = R"(heartbeat="50ms" suspect="500ms" lost="800ms" reconnect="2s")";
        PuppetTheatre stage(slow);
        Theatre& theatre = stage.theatre;
        QVERIFY(theatre.openAll());
        theatre.acknowledgeAlarms();
        theatre.testAlarms();
        theatre.hold(Qt::Key_F);
        const auto& permit = theatre.models().permit;
        // All but this one.
        QTRY_VERIFY2_WITH_TIMEOUT(permit.unmetCount() == 1, qPrintable(theatre.story()), patience);
        const auto line = permit.checklist().at(std::size_t(Guard::CommandsQuick));
        QVERIFY2(!line.met && line.text.contains(QStringLiteral("up to 0 ms")), qPrintable(line.text));
        theatre.hold(Qt::Key_R);
        QVERIFY(!theatre.reaches(PermitPhase::Arming, Theatre::twiceArmHold));
        QCOMPARE(stage.robot.armRequests(), 0);
        theatre.releaseAll();
    }

private:
    std::unique_ptr<Stage> m_stage;
};

QTEST_MAIN(NeverArmedTest)
#include "never_armed_test.moc"
