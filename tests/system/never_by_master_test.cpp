// What a master besides the keyboard must never do through the whole console, seen at the robot: jump into motion with what it was pushed
// to before, or push the robot with the force that it gives back.
//
// The same of the keyboard is tried by system.never_by_hand, a pad that is pulled out by system.cockpit.
#include "gui/shown_texts.hpp"
#include "input/hand_mapping.hpp"
#include "never_possible_stage.hpp"
#include "unit/console/virtual_pad.hpp"
#include "widgets/hand_block.hpp"
#include "widgets/master_row.hpp"

#include <QDeadlineTimer>

#include <cmath>

using namespace console;
using console::test::rampAt;
using console::test::textsPaintedBy;
using console::test::Theatre;
using console::test::VirtualPad;
using Stage = console::test::NeverStage;

namespace {

constexpr int patience = Theatre::patience;
constexpr double asked = HandSpeeds{}.guidewireVelocity; ///< mm/s, by a key or a stick that is pushed all the way

Theatre::Wishes hapticWishes()
{
    auto wishes = console::test::puppetWishes();
    wishes.master = MasterKind::HapticSimulated;
    return wishes;
}

/// All that the motion bar paints of the hand, without the spaces between.
QString paintedOfHand(Stage& stage)
{
    auto* block = stage.theatre.window().findChild<HandBlock*>();
    QString all;
    if (block != nullptr && block->isVisible())
        for (const auto& shown : textsPaintedBy(*block))
            all += shown.text;
    return all.simplified().remove(QLatin1Char(' '));
}

/// By a click on its chip; whether it counts then.
bool use(Stage& stage, MasterKind kind)
{
    MasterChip* found = nullptr;
    const auto find = [&] {
        for (auto* chip : stage.theatre.window().findChildren<MasterChip*>())
            if (chip->isVisible() && chip->isEnabled() && chip->status().kind == kind)
                found = chip;
        return found != nullptr;
    };
    if (!QTest::qWaitFor(find, patience))
        return false;
    QTest::mouseClick(found, Qt::LeftButton);
    const auto counts = [&stage, kind] {
        const auto* master = stage.theatre.models().hand.masterInUse();
        return master != nullptr && master->kind == kind && master->life == MasterLife::Alive;
    };
    return QTest::qWaitFor(counts, patience);
}

/// Arms, and ends with the robot moving at all that is asked: the soft start is over. A busy computer paints too late, and motion ends.
bool movesWholly(Stage& stage)
{
    const auto whole = [&stage] {
        const auto heard = stage.robot.newestMovements();
        return !heard.empty() && heard.back().velocity > 0.99 * asked;
    };
    const QDeadlineTimer deadline(3 * patience);
    while (!deadline.hasExpired())
        if (stage.theatre.armAndMove() && stage.whileItMayMove(whole))
            return true;
    return false;
}

} // namespace

class NeverByMasterTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void initTestCase()
    {
        m_stage = console::test::openStage(hapticWishes());
        QVERIFY(m_stage);
    }

    void cleanupTestCase() { m_stage.reset(); }

    void theForceOfTheRobotSlowsTheHandAndNeverPushesIt()
    {
        QVERIFY2(m_stage->tryWhileItMoves([this](bool& over) { feelTheRobot(over); }), qPrintable(m_stage->theatre.story()));
        m_stage->theatre.releaseAll();
    }

    // Rule 3.

    void aStickThatIsPushedBeforeTheTriggerMovesNothingUntilItWasAtRest()
    {
        VirtualPad pad;
        QVERIFY(pad.sound());
        QVERIFY2(use(*m_stage, MasterKind::GamePad), qPrintable(m_stage->theatre.story()));
        QVERIFY2(m_stage->tryWhileItMoves([&](bool& over) { pushBeforeTheTrigger(pad, over); }), qPrintable(m_stage->theatre.story()));
        m_stage->theatre.releaseAll();
    }

private:
    /// With its key still down a hand that is held up stands for a moment, and goes on when it pushes harder.
    void feelTheRobot(bool& over)
    {
        Stage& stage = *m_stage;
        const auto force = [&stage] { return stage.theatre.models().hand.reading().forceToHand.value_or(99); };
        const auto movesMore = [&stage] {
            const int before = stage.robot.movements();
            return stage.whileItMayMove([&] { return stage.robot.movements() > before + 50; });
        };
        stage.robot.setForce(0);
        QVERIFY2(movesWholly(stage), qPrintable(stage.theatre.story()));
        const int rested = stage.robot.engagedAtRest();
        if (!movesMore())
            return;
        QCOMPARE(stage.robot.engagedAtRest(), rested); // without a force it does not stand
        QCOMPARE(force(), 0.0);
        QTRY_VERIFY2(paintedOfHand(stage).contains(QStringLiteral("FORCETOHANDnone")), qPrintable(paintedOfHand(stage)));

        stage.robot.setForce(1.5);
        const auto isHeldUp = [&] {
            return stage.robot.engagedAtRest() > rested + 20 && std::abs(force() - 1.5) < 0.01 &&
                   paintedOfHand(stage).contains(QStringLiteral("FORCETOHANDresistance1.50"));
        };
        if (!stage.whileItMayMove(isHeldUp) || !movesMore())
            return;

        stage.robot.setForce(-1.5); // the same the other way: what pulls the wire pulls no robot along
        if (!stage.whileItMayMove([&] { return std::abs(force() + 1.5) < 0.01; }) || !movesMore())
            return;
        QCOMPARE(stage.phase(), PermitPhase::Engaged);
        QVERIFY2(stage.robot.fastest() <= asked + 1e-3, qPrintable(QString::number(stage.robot.fastest())));

        stage.theatre.strike(Qt::Key_F12); // and who moves nothing feels nothing, though the robot still does
        QTRY_COMPARE_WITH_TIMEOUT(force(), 0.0, patience);
        stage.robot.setForce(0);
        over = true;
    }

    void pushBeforeTheTrigger(VirtualPad& pad, bool& over)
    {
        Stage& stage = *m_stage;
        const auto push = [&pad](double part) { pad.stick(SDL_CONTROLLER_AXIS_LEFTY, -part); };
        const auto stands = [&stage](int since) { return stage.robot.engagedAtRest() > since + 50; };
        pad.trigger(0);
        push(0);
        QVERIFY2(stage.theatre.arm(), qPrintable(stage.theatre.story()));
        int moved = stage.robot.movements();
        int rested = stage.robot.engagedAtRest();
        push(1);
        QVERIFY(stage.settles()); // it is heard, and is nothing yet
        pad.trigger(1);
        const bool lasted = stage.whileItMayMove([&] { return stands(rested); });
        QCOMPARE(stage.robot.movements(), moved);
        if (!lasted)
            return;
        push(0.5); // nor does less of it count as rest
        QVERIFY(stage.settles());
        QCOMPARE(stage.robot.movements(), moved);
        push(0);
        QVERIFY(stage.settles());
        push(1);
        if (!stage.whileItMayMove([&] { return stage.robot.movements() > moved; }))
            return;
        const auto first = stage.robot.newestMovements().front();
        constexpr std::chrono::milliseconds underway(100); // what the first command that the robot heard may have been late
        QVERIFY2(first.velocity <= asked * rampAt(first.engagedFor + underway) + 1e-3, qPrintable(QString::number(first.velocity)));

        // The same at each further press.
        pad.trigger(0);
        if (!stage.whileItMayMove([&] { return stage.phase() == PermitPhase::Armed; }))
            return;
        QVERIFY(stage.settles());
        moved = stage.robot.movements();
        rested = stage.robot.engagedAtRest();
        pad.trigger(1);
        over = stage.whileItMayMove([&] { return stands(rested); });
        QCOMPARE(stage.robot.movements(), moved);
    }

    std::unique_ptr<Stage> m_stage;
};

QTEST_MAIN(NeverByMasterTest)
#include "never_by_master_test.moc"
