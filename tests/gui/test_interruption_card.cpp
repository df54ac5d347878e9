// "While you were away": when it comes, where it lies, and what acknowledges it.
#include "cockpit_stage.hpp"
#include "widgets/diagnosis_sheet.hpp"
#include "widgets/hold_button.hpp"
#include "widgets/interruption_card.hpp"
#include "widgets/sheet_button.hpp"

#include <QSignalSpy>

using namespace console;
using namespace console::test;
using namespace std::chrono_literals;

namespace {

/// Lost and re-opened; the window's wish to acknowledge is carried out.
struct Returned : CockpitStage {
    QSignalSpy asked{&window, &CockpitWindow::interruptionReadRequested};

    explicit Returned(const QSize& size = {1920, 1080}) : CockpitStage(size)
    {
        QObject::connect(&window, &CockpitWindow::interruptionReadRequested, &window,
                         [this] { cockpit.models.interruption.acknowledge(std::chrono::steady_clock::now()); });
        cockpit.openAll();
        cockpit.loseRobot();
    }

    InterruptionCard* card() const { return window.findChild<InterruptionCard*>(); }
    SheetButton* button() const { return card()->findChild<SheetButton*>(); }
    const InterruptionAccount& account() const { return cockpit.models.interruption; }
};

} // namespace

class TestInterruptionCard : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void initTestCase() { theme::apply(*qApp); }

    void comesAfterTheReopeningAndGoesWhenRead()
    {
        Returned stage;
        QVERIFY(stage.ready());
        stage.refresh();
        QVERIFY(!stage.card()->isVisible());
        stage.cockpit.reopenAll();
        stage.refresh();
        QVERIFY(stage.card()->isVisible());
        const QString said = stage.card()->accessibleDescription();
        for (const char* words : {"Interrupted for", "Vascular robot link", "moved 2.3\u00A0mm", "1.2\u00A0mL used", "3.2 s of beam",
                                  "48 taken, 42 of them", "drives enabled: 4 of 4 before, 0 now"})
            QVERIFY2(said.contains(QString::fromUtf8(words)), qPrintable(said));
        QTest::mouseClick(stage.button(), Qt::LeftButton);
        QVERIFY(stage.account().settled());
        QTRY_VERIFY(!stage.card()->isVisible());
        QVERIFY(stage.window.handHasKeys());
    }

    void permitNamesItAndWaits()
    {
        Returned stage;
        QVERIFY(stage.ready());
        stage.cockpit.reopenAll();
        QVERIFY2(stage.cockpit.models.permit.unmetText(9).contains(QStringLiteral("Read \"While you were away\"")),
                 qPrintable(stage.cockpit.models.permit.unmetText(9)));
        QCOMPARE(stage.cockpit.models.permit.phase(), PermitPhase::Verifying);
        stage.refresh();
        QSignalSpy held(&stage.window, &CockpitWindow::armHoldChanged);
        auto* arm = stage.named<HoldButton>(QStringLiteral("Arm: hold for one and a half seconds"));
        QVERIFY(arm != nullptr && !arm->isEnabled());
        QTest::mousePress(arm, Qt::LeftButton);
        QCOMPARE(held.count(), 0);
    }

    void clickThatReopenedDoesNotRead()
    {
        Returned stage;
        QVERIFY(stage.ready());
        stage.cockpit.models.interruption.end(std::chrono::steady_clock::now() + 1h); // just now, and for as long as the test takes
        stage.refresh();
        QVERIFY(stage.card()->isVisible());
        QVERIFY(!stage.button()->isEnabled());
        for (int i = 0; i < 3; ++i)
            QTest::mouseClick(stage.button(), Qt::LeftButton);
        QTest::mouseDClick(stage.button(), Qt::LeftButton);
        QCOMPARE(stage.asked.count(), 0);
        QVERIFY(!stage.account().settled());
    }

    void enterNeverReads()
    {
        Returned stage;
        QVERIFY(stage.ready());
        stage.cockpit.reopenAll();
        stage.refresh();
        stage.button()->setFocus();
        QVERIFY(stage.button()->hasFocus());
        for (const Qt::Key key : {Qt::Key_Return, Qt::Key_Enter})
            for (const bool repeat : {false, true}) {
                QKeyEvent press(QEvent::KeyPress, key, Qt::NoModifier, QString(), repeat);
                QCoreApplication::sendEvent(stage.button(), &press);
                QTest::keyRelease(stage.button(), key);
            }
        QKeyEvent held(QEvent::KeyPress, Qt::Key_Space, Qt::NoModifier, QStringLiteral(" "), true);
        QCoreApplication::sendEvent(stage.button(), &held);
        QTest::keyRelease(stage.button(), Qt::Key_Space);
        QCOMPARE(stage.asked.count(), 0);
    }

    void tabAndSpaceReadIt()
    {
        Returned stage;
        QVERIFY(stage.ready());
        stage.cockpit.reopenAll();
        stage.refresh();
        stage.window.setFocus();
        QTest::keyClick(&stage.window, Qt::Key_Tab);
        QCOMPARE(QApplication::focusWidget(), static_cast<QWidget*>(stage.button()));
        QVERIFY(!stage.window.handHasKeys());
        QTest::keyClick(stage.button(), Qt::Key_Space);
        QVERIFY(stage.account().settled());
        QVERIFY(stage.window.handHasKeys());
    }

    void takesTheKeysFromNobody()
    {
        Returned stage;
        QVERIFY(stage.ready());
        stage.cockpit.reopenAll();
        stage.refresh();
        QVERIFY(stage.card()->isVisible());
        QVERIFY(!stage.card()->isAncestorOf(QApplication::focusWidget()));
    }

    void liesOverReferenceAndSceneOnly_data()
    {
        QTest::addColumn<QSize>("screen");
        QTest::newRow("reference") << QSize(2560, 1440);
        QTest::newRow("full HD") << QSize(1920, 1080);
        QTest::newRow("small") << QSize(1366, 768);
    }

    void liesOverReferenceAndSceneOnly()
    {
        QFETCH(QSize, screen);
        Returned stage(screen);
        QVERIFY(stage.ready());
        stage.cockpit.reopenAll();
        stage.refresh();
        QCOMPARE(stage.seen(stage.card()), stage.window.regionGeometry(Region::Reference));
        QCOMPARE(stage.seen(stage.live), stage.window.regionGeometry(Region::Live));
        const QRect button = stage.seen(stage.button());
        QVERIFY(stage.seen(stage.card()).contains(button));
        QCOMPARE(button.size(), stage.button()->size());
    }

    void aFurtherLossHidesItUntilThatIsOver()
    {
        Returned stage;
        QVERIFY(stage.ready());
        stage.cockpit.reopenAll();
        stage.refresh();
        stage.cockpit.loseXray(9);
        stage.refresh();
        QVERIFY(!stage.card()->isVisible());
        QVERIFY(stage.window.findChild<DiagnosisSheet*>()->isVisible());
        stage.cockpit.reopenAll();
        stage.refresh();
        QVERIFY(stage.card()->isVisible());
        QVERIFY2(stage.card()->accessibleDescription().contains(QStringLiteral("2 losses")),
                 qPrintable(stage.card()->accessibleDescription()));
    }

    void anotherViewDoesNotCoverIt()
    {
        Returned stage;
        QVERIFY(stage.ready());
        stage.cockpit.reopenAll();
        stage.refresh();
        stage.window.showView(View::Topology);
        QCOMPARE(stage.seen(stage.card()), stage.window.regionGeometry(Region::Reference));
    }
};

QTEST_MAIN(TestInterruptionCard)
#include "test_interruption_card.moc"
