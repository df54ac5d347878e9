// The sheet of a link that is interrupted: there at once, without the keys, and the incident's when the link does not heal.
#include "cockpit_stage.hpp"
#include "flapping_link.hpp"
#include "model/present_readings.hpp"
#include "widgets/diagnosis_sheet.hpp"
#include "widgets/sheet_button.hpp"

#include <QLabel>
#include <QSignalSpy>

using namespace console;
using namespace console::test;
using namespace std::chrono_literals;

namespace {

struct Interrupted : CockpitStage {
    SessionIntake intake{cockpit.models};
    FlappingLink robot{intake};
    Instant now = std::chrono::steady_clock::now();

    Interrupted() { cockpit.openAll(); }

    DiagnosisSheet* sheet() const { return window.findChild<DiagnosisSheet*>(); }

    void paint()
    {
        window.refresh(now);
        QCoreApplication::processEvents();
    }

    SheetButton* button(const QString& text) const
    {
        for (SheetButton* candidate : window.findChildren<SheetButton*>())
            if (candidate->isVisible() && candidate->text() == text)
                return candidate;
        return nullptr;
    }

    bool says(const QString& words) const
    {
        for (const QLabel* label : sheet()->findChildren<QLabel*>())
            if (label->isVisible() && label->text().contains(words))
                return true;
        return false;
    }
};

} // namespace

class TestInterruptionSheet : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void initTestCase() { theme::apply(*qApp); }

    void comesAtOnceAndLeavesTheKeysToTheHand()
    {
        Interrupted stage;
        QVERIFY(stage.ready());
        QVERIFY(stage.window.handHasKeys());
        stage.robot.interrupt(stage.now);
        QVERIFY(stage.sheet()->isVisible());
        QVERIFY(stage.says(QStringLiteral("Vascular robot link interrupted"))); // with the first paint, not a later one
        QVERIFY(stage.says(QStringLiteral("Not confirmed yet")));
        QVERIFY(stage.window.handHasKeys());
        QVERIFY(stage.button(QStringLiteral("Re-open channel")) == nullptr);
        QVERIFY(stage.button(QStringLiteral("Run checks")) == nullptr);
        QVERIFY(!guardReadings(stage.cockpit.models, robotId, true, stage.now).incident);
    }

    void becomesTheIncidentsWithoutComingOutAgain()
    {
        Interrupted stage;
        QVERIFY(stage.ready());
        stage.robot.interrupt(stage.now);
        QCOMPARE(stage.sheet()->pos(), QPoint(0, 0));
        stage.robot.decide(stage.now += 500ms);
        QCOMPARE(stage.sheet()->pos(), QPoint(0, 0));
        QVERIFY(stage.says(QStringLiteral("Vascular robot link lost")));
        QCOMPARE(QApplication::focusWidget(), stage.button(QStringLiteral("Run checks")));
        QVERIFY(!stage.window.handHasKeys());
        QVERIFY(stage.button(QStringLiteral("Re-open channel")) != nullptr);
        QVERIFY(!stage.says(QStringLiteral("time in 2 min")));
        QVERIFY(guardReadings(stage.cockpit.models, robotId, true, stage.now).incident);
    }

    void goesSomeSecondsAfterItHealed()
    {
        Interrupted stage;
        QVERIFY(stage.ready());
        stage.robot.interrupt(stage.now);
        stage.robot.heal(stage.now += 300ms);
        stage.paint();
        QVERIFY(stage.says(QStringLiteral("Vascular robot link was interrupted")));
        QVERIFY(stage.says(QStringLiteral("for 300 ms")));
        stage.now += IncidentModel::healedShown - 1ms;
        stage.paint();
        QVERIFY(stage.sheet()->isVisible());
        stage.now += 1ms;
        stage.paint();
        QVERIFY(!stage.sheet()->isVisible());
        QVERIFY(stage.window.handHasKeys());
    }

    void canBeClosedOnceItHealed()
    {
        Interrupted stage;
        QVERIFY(stage.ready());
        stage.robot.interrupt(stage.now);
        stage.robot.heal(stage.now += 300ms);
        stage.paint();
        QVERIFY(stage.button(QStringLiteral("Close")) != nullptr);
        QTest::mouseClick(stage.button(QStringLiteral("Close")), Qt::LeftButton);
        QVERIFY(!stage.sheet()->isVisible());
        QVERIFY(stage.window.handHasKeys());
        QVERIFY(stage.cockpit.models.incidents.interruptions().empty());
    }

    void whatIsFoldedStaysFoldedThroughFlaps()
    {
        Interrupted stage;
        QVERIFY(stage.ready());
        stage.robot.interrupt(stage.now);
        stage.paint();
        QTest::mouseClick(stage.button(QStringLiteral("Fold")), Qt::LeftButton);
        QVERIFY(!stage.sheet()->isVisible());
        for (int i = 0; i < 5; ++i) {
            stage.robot.heal(stage.now += 200ms);
            stage.robot.interrupt(stage.now += 200ms);
            stage.paint();
            QVERIFY(!stage.sheet()->isVisible());
        }
        stage.robot.decide(stage.now += 500ms); // this one must be seen
        QVERIFY(stage.sheet()->isVisible());
        QVERIFY(stage.says(QStringLiteral("6th time in 2 min")));
    }

    void goesWithALinkThatIsClosed()
    {
        Interrupted stage;
        QVERIFY(stage.ready());
        stage.robot.interrupt(stage.now);
        stage.robot.close(stage.now += 100ms);
        QVERIFY(!stage.sheet()->isVisible());
    }

    /// A decided loss is shown over one that may heal, and back when it ended.
    void anIncidentComesFirst()
    {
        Interrupted stage;
        QVERIFY(stage.ready());
        FlappingLink xray(stage.intake, xrayId);
        stage.robot.interrupt(stage.now);
        xray.lose(stage.now += 10ms);
        QVERIFY(stage.says(QStringLiteral("link lost")));
        QVERIFY(!stage.says(QStringLiteral("Vascular robot link")));
    }

    /// The question whether to give a link up is never answered for another one.
    void theQuestionToGiveUpStaysWithItsLink()
    {
        Interrupted stage;
        QVERIFY(stage.ready());
        FlappingLink xray(stage.intake, xrayId);
        xray.lose(stage.now);
        stage.paint();
        QTest::mouseClick(stage.button(QStringLiteral("Give up link\u2026")), Qt::LeftButton);
        QVERIFY(stage.button(QStringLiteral("Give up link")) != nullptr);
        stage.robot.lose(stage.now += 100ms); // more urgent: its sheet takes the place
        stage.paint();
        QVERIFY(stage.says(QStringLiteral("Vascular robot link lost")));
        QVERIFY(stage.button(QStringLiteral("Give up link")) == nullptr);
        QVERIFY(stage.button(QStringLiteral("Run checks")) != nullptr);
    }
};

QTEST_MAIN(TestInterruptionSheet)
#include "test_interruption_sheet.moc"
