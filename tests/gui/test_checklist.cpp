// The conditions of motion: what is missing is in sight, and all of them are one press or one key away.
#include "cockpit_stage.hpp"
#include "widgets/checklist_view.hpp"
#include "widgets/guard_list.hpp"

#include <QLabel>

using namespace console;
using namespace console::test;

namespace {

struct Checklist : CockpitStage {
    ChecklistView* view = new ChecklistView(cockpit.models.permit);

    explicit Checklist(const QSize& size = {1920, 1080}) : CockpitStage(size) { window.addView(View::Checklist, view); }

    GuardList* list() const { return window.findChild<GuardList*>(); }

    /// Of a condition in the view: its state as it is read out.
    QString stateOf(const QString& text) const
    {
        for (const QWidget* row : view->findChildren<QWidget*>())
            if (row->accessibleName() == text)
                return row->accessibleDescription();
        return {};
    }
};

} // namespace

class TestChecklist : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void initTestCase() { theme::apply(*qApp); }

    void whatIsMissingIsInSight_data()
    {
        QTest::addColumn<QSize>("screen");
        QTest::newRow("1440") << QSize(2560, 1440);
        QTest::newRow("1080") << QSize(1920, 1080);
    }

    /// Before any link is open most is missing.
    void whatIsMissingIsInSight()
    {
        QFETCH(QSize, screen);
        Checklist stage(screen);
        QVERIFY(stage.ready());
        stage.refresh();
        const int missing = stage.cockpit.models.permit.unmetCount();
        QVERIFY(missing >= 13);
        QTRY_VERIFY2(int(stage.list()->writtenOut()) >= missing,
                     qPrintable(QStringLiteral("%1 of %2").arg(stage.list()->writtenOut()).arg(missing)));
        if (screen.height() == theme::referenceHeight)
            QVERIFY(stage.list()->font().pixelSize() >= 16);
    }

    void aPressOrAKeyShowsAllOfThem_data()
    {
        QTest::addColumn<QString>("how");
        for (const char* how : {"press", "F6", "Space", "Enter"})
            QTest::newRow(how) << QString::fromLatin1(how);
    }

    void aPressOrAKeyShowsAllOfThem()
    {
        QFETCH(QString, how);
        Checklist stage;
        QVERIFY(stage.ready());
        stage.refresh();
        QVERIFY(!stage.view->isVisible());
        if (how == QLatin1String("press"))
            QTest::mouseClick(stage.list(), Qt::LeftButton);
        else if (how == QLatin1String("F6"))
            QTest::keyClick(&stage.window, Qt::Key_F6);
        else {
            stage.list()->setFocus(Qt::TabFocusReason);
            QTest::keyClick(stage.list(), how == QLatin1String("Space") ? Qt::Key_Space : Qt::Key_Return);
        }
        QVERIFY(stage.view->isVisible());
        for (const GuardLine& line : stage.cockpit.models.permit.checklist())
            QCOMPARE(stage.stateOf(line.text), line.met ? QStringLiteral("met") : QStringLiteral("missing"));
        QVERIFY(!QApplication::activeModalWidget() && !QApplication::activePopupWidget());
        for (const Region region : {Region::Live, Region::Motion, Region::Alarm})
            QVERIFY(!stage.seen(stage.view).intersects(stage.window.regionGeometry(region)));
        QVERIFY(!stage.window.handHasKeys());
        QTest::keyClick(QApplication::focusWidget(), Qt::Key_F1);
        QTRY_VERIFY(!stage.view->isVisible());
        QTRY_VERIFY(stage.window.handHasKeys());
    }

    /// It is kept for the editor.
    void f5BringsNothing()
    {
        Checklist stage;
        QVERIFY(stage.ready());
        stage.window.setFocus();
        QTRY_VERIFY(stage.window.handHasKeys());
        QTest::keyClick(&stage.window, Qt::Key_F5);
        QCOMPARE(stage.window.view(), View::Cockpit);
        QVERIFY(stage.window.handHasKeys());
    }

    void theViewFollowsAndSaysHowManyAreMissing()
    {
        Checklist stage;
        QVERIFY(stage.ready());
        stage.cockpit.openAll();
        const auto* summary = stage.view->findChild<QLabel*>();
        QCOMPARE(summary->text(), QStringLiteral("All 21 conditions are met"));
        auto readings = stage.cockpit.goodReadings();
        readings.alarmsTested = false;
        stage.cockpit.models.permit.check(readings, stage.cockpit.now);
        QCOMPARE(summary->text(), QStringLiteral("1 of 21 conditions is missing"));
        QCOMPARE(stage.stateOf(QStringLiteral("Alarm self-test is due (F8)")), QStringLiteral("missing"));
    }

    /// A robot that is armed is not ready to be armed: that is no condition any more, and not missing either.
    void whileArmedOnlyWhatMustStayTrueIsAskedFor()
    {
        Checklist stage;
        QVERIFY(stage.ready());
        stage.cockpit.openAll();
        stage.cockpit.arm();
        QCOMPARE(stage.cockpit.models.permit.phase(), PermitPhase::Armed);
        QCOMPARE(stage.stateOf(QStringLiteral("Robot reports armed")), QStringLiteral("not asked for while armed"));
        QCOMPARE(stage.view->findChild<QLabel*>()->text(), QStringLiteral("All 12 conditions are met"));
    }

    /// A view takes the keys from the hand, and so would hold.
    void aStrayTouchWhileArmedOrEngagedOpensNothing_data()
    {
        QTest::addColumn<bool>("engaged");
        QTest::newRow("armed") << false;
        QTest::newRow("engaged") << true;
    }

    void aStrayTouchWhileArmedOrEngagedOpensNothing()
    {
        QFETCH(bool, engaged);
        Checklist stage;
        QVERIFY(stage.ready());
        stage.cockpit.openAll();
        stage.cockpit.arm();
        if (engaged)
            stage.cockpit.engage();
        QCOMPARE(stage.cockpit.models.permit.phase(), engaged ? PermitPhase::Engaged : PermitPhase::Armed);
        QTest::mouseClick(stage.list(), Qt::LeftButton);
        QVERIFY(!stage.view->isVisible());
        QVERIFY(stage.window.handHasKeys());
    }

    void whatHasNoRoomIsCountedAndNeverWrittenSmaller()
    {
        InventedCockpit cockpit;
        GuardList list;
        list.setChecklist(cockpit.models.permit.checklist(), cockpit.models.permit.state());
        const int font = list.font().pixelSize();
        list.resize(330, 5 * QFontMetrics(list.font()).height());
        QCOMPARE(list.writtenOut(), std::size_t(4));
        QCOMPARE(list.font().pixelSize(), font);
    }
};

QTEST_MAIN(TestChecklist)
#include "test_checklist.moc"
