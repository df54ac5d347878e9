// The diagnosis prompt: when it comes, what Enter may do, where it lies, and that it never vanishes.
#include "cockpit_stage.hpp"
#include "widgets/alarm_band.hpp"
#include "widgets/diagnosis_sheet.hpp"
#include "widgets/roll_call.hpp"
#include "widgets/sheet_button.hpp"

#include <QDialog>
#include <QLabel>
#include <QSignalSpy>

using namespace console;
using namespace console::test;

namespace {

SheetButton* button(const CockpitStage& stage, const QString& text)
{
    for (SheetButton* candidate : stage.window.findChildren<SheetButton*>())
        if (candidate->isVisible() && candidate->text() == text)
            return candidate;
    return nullptr;
}

DiagnosisSheet* sheet(const CockpitStage& stage) { return stage.window.findChild<DiagnosisSheet*>(); }

bool says(const QWidget* widget, const QString& words)
{
    for (const QLabel* label : widget->findChildren<QLabel*>())
        if (label->isVisible() && label->text().contains(words))
            return true;
    return false;
}

} // namespace

class TestDiagnosisSheet : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void initTestCase() { theme::apply(*qApp); }

    void comesWithTheIncidentAndAsksForChecks()
    {
        CockpitStage stage;
        QVERIFY(stage.ready());
        stage.cockpit.openAll();
        QVERIFY(!sheet(stage)->isVisible());
        stage.cockpit.loseRobot();
        QVERIFY(sheet(stage)->isVisible());
        QCOMPARE(QApplication::focusWidget(), button(stage, QStringLiteral("Run checks")));
        QVERIFY(says(sheet(stage), QStringLiteral("Vascular robot link lost")));
        QVERIFY(says(sheet(stage), QStringLiteral("NOT CONFIRMED")));
    }

    void theRollCallSaysWhoHoldsAndWhoDoesNot()
    {
        CockpitStage stage;
        QVERIFY(stage.ready());
        stage.cockpit.openAll();
        stage.cockpit.loseRobot();
        stage.refresh();
        const auto* call = sheet(stage)->findChild<RollCall*>();
        QVERIFY(call != nullptr && call->isVisible());
        const QStringList expected{QStringLiteral("Surgeon's cockpit: holds, after 0\u00A0ms"),
                                   QStringLiteral("Vascular robot: not confirmed"), QStringLiteral("Robotic arm: holds, after 38\u00A0ms"),
                                   QStringLiteral("C-arm X-ray: holds, after 52\u00A0ms")};
        QCOMPARE(call->accessibleDescription().split(QStringLiteral("; ")), expected);
        stage.cockpit.models.incidents.end(0x5eed);
        stage.cockpit.loseXray(); // the robot has confirmed this one
        stage.refresh();
        const QString words = call->accessibleDescription();
        QVERIFY2(words.contains(QStringLiteral("Vascular robot: holds, after 41\u00A0ms")), qPrintable(words));
        QVERIFY2(!words.contains(QStringLiteral("not confirmed")), qPrintable(words));
        QTRY_VERIFY(call->height() >= call->sizeHint().height()); // each line has its room
    }

    void enterRunsChecksAndNeverReopens()
    {
        CockpitStage stage;
        QVERIFY(stage.ready());
        stage.cockpit.openAll();
        stage.cockpit.loseRobot();
        QSignalSpy probe(&stage.window, &CockpitWindow::probeRequested);
        QSignalSpy reopen(&stage.window, &CockpitWindow::reopenRequested);
        QTest::keyClick(QApplication::focusWidget(), Qt::Key_Return);
        QCOMPARE(probe.count(), 1);
        QCOMPARE(probe.first().first().toUInt(), robotId);
        SheetButton* open = button(stage, QStringLiteral("Re-open channel"));
        open->setFocus();
        for (const Qt::Key key : {Qt::Key_Return, Qt::Key_Enter})
            QTest::keyClick(open, key);
        QCOMPARE(reopen.count(), 0);
    }

    void reportIsAskedForAndWhatBecameOfItIsSaid()
    {
        CockpitStage stage;
        QVERIFY(stage.ready());
        stage.cockpit.openAll();
        stage.cockpit.models.patientSide = QStringLiteral("lab 2, tel. 4711");
        stage.cockpit.loseRobot();
        stage.refresh();
        QVERIFY(says(sheet(stage), QStringLiteral("lab 2, tel. 4711")));
        QSignalSpy report(&stage.window, &CockpitWindow::reportRequested);
        QTest::mouseClick(button(stage, QStringLiteral("Save report")), Qt::LeftButton);
        QTest::mouseClick(button(stage, QStringLiteral("Save report")), Qt::LeftButton);
        QCOMPARE(report.count(), 1); // a double click is one wish
        QVERIFY(report.first().first().toString().startsWith(QStringLiteral("Vascular robot link lost\n")));
        stage.window.showReportNote(QStringLiteral("Report saved: /somewhere"));
        QVERIFY(says(sheet(stage), QStringLiteral("/somewhere")));
    }

    void detailsAreShownWhenAskedForAndAreInTheReportAnyway()
    {
        CockpitStage stage;
        QVERIFY(stage.ready());
        stage.cockpit.openAll();
        stage.cockpit.loseRobot(0xf1a9);
        stage.refresh();
        const QString number = QStringLiteral("incident 000000000000f1a9");
        QVERIFY(!says(sheet(stage), number));
        auto* details = button(stage, QStringLiteral("Details"));
        details->setFocus(Qt::TabFocusReason);
        QTest::keyClick(details, Qt::Key_Return);
        QVERIFY(says(sheet(stage), number));
        QVERIFY(says(sheet(stage), QStringLiteral("Vascular robot: device 0x")));
        stage.refresh();
        const auto seen = [&stage, &number] {
            for (const QLabel* label : sheet(stage)->findChildren<QLabel*>())
                if (label->text().contains(number))
                    return !label->visibleRegion().isEmpty();
            return false;
        };
        QTRY_VERIFY(seen()); // the sheet scrolls to them
        QTest::mouseClick(details, Qt::LeftButton);
        QVERIFY(!says(sheet(stage), number));
        QSignalSpy report(&stage.window, &CockpitWindow::reportRequested);
        QTest::mouseClick(button(stage, QStringLiteral("Save report")), Qt::LeftButton);
        QVERIFY(report.first().first().toString().contains(number));
    }

    void theNumberOfThePatientSideIsShownLargeWhenTheyAreToBeCalled()
    {
        CockpitStage stage;
        QVERIFY(stage.ready());
        stage.cockpit.openAll();
        stage.cockpit.models.patientSide = QStringLiteral("lab 2, tel. 4711");
        stage.cockpit.loseRobot(7);
        stage.refresh();
        const auto height = [&stage] {
            for (const QLabel* label : sheet(stage)->findChildren<QLabel*>())
                if (label->isVisible() && label->text().contains(QStringLiteral("4711")))
                    return label->font().pixelSize();
            return 0;
        };
        const int usual = height();
        QVERIFY(usual > 0);
        QSignalSpy called(&stage.window, &CockpitWindow::patientSideCallRequested);
        const auto call = [&stage] { return button(stage, QStringLiteral("Call patient side")); };
        QTest::mouseClick(call(), Qt::LeftButton);
        QCOMPARE(called.count(), 1);
        QVERIFY2(height() > 1.7 * usual, qPrintable(QString::number(height())));
        QVERIFY(stage.window.findChildren<QDialog*>().isEmpty());
        QTest::mouseClick(call(), Qt::LeftButton);
        QCOMPARE(called.count(), 1); // a double click is one wish, and takes nothing away
        QVERIFY(height() > 1.7 * usual);
        stage.cockpit.models.incidents.end(7);
        stage.cockpit.loseRobot(8); // of another incident nobody was called
        stage.refresh();
        QCOMPARE(height(), usual);
        QCOMPARE(called.count(), 1);
    }

    void alarmsAreSilencedFromTheSheetAsByF9()
    {
        CockpitStage stage;
        QVERIFY(stage.ready());
        stage.cockpit.openAll();
        stage.cockpit.loseRobot();
        QSignalSpy paused(&stage.window, &CockpitWindow::audioPauseRequested);
        QTest::mouseClick(button(stage, QStringLiteral("Silence 60 s")), Qt::LeftButton);
        QCOMPARE(paused.count(), 1);
        stage.cockpit.models.alarms.pauseAudio(std::chrono::steady_clock::now(), 1, {});
        QTest::mouseClick(button(stage, QStringLiteral("Silence 60 s")), Qt::LeftButton);
        QCOMPARE(paused.count(), 1); // pressed once more, it does not let the alarms sound again
    }

    void clickReopens()
    {
        CockpitStage stage;
        QVERIFY(stage.ready());
        stage.cockpit.openAll();
        stage.cockpit.loseRobot();
        QSignalSpy reopen(&stage.window, &CockpitWindow::reopenRequested);
        QSignalSpy armed(&stage.window, &CockpitWindow::armHoldChanged);
        QTest::mouseClick(button(stage, QStringLiteral("Re-open channel")), Qt::LeftButton);
        QCOMPARE(reopen.count(), 1);
        QCOMPARE(reopen.first().first().toUInt(), robotId);
        QCOMPARE(armed.count(), 0);
    }

    void aReopeningThatRunsIsNotAskedForAgain()
    {
        CockpitStage stage;
        QVERIFY(stage.ready());
        stage.cockpit.openAll();
        stage.cockpit.loseRobot();
        button(stage, QStringLiteral("Re-open channel"))->setFocus();
        stage.cockpit.models.sessions.setLinkState(robotId, LinkState::Reopening, stage.cockpit.now);
        stage.refresh();
        SheetButton* running = button(stage, QStringLiteral("Re-opening\u2026"));
        QVERIFY(running != nullptr && !running->isEnabled());
        QCOMPARE(QApplication::focusWidget(), button(stage, QStringLiteral("Run checks")));
        QSignalSpy reopen(&stage.window, &CockpitWindow::reopenRequested);
        QTest::mouseClick(running, Qt::LeftButton);
        QCOMPARE(reopen.count(), 0);
        stage.cockpit.models.sessions.setLinkState(robotId, LinkState::StandBy, stage.cockpit.now);
        stage.refresh();
        QVERIFY(button(stage, QStringLiteral("Re-open channel"))->isEnabled());
    }

    /// There is nothing to check from here, and the keys are the sheet's all the same.
    void anIncidentBetweenOthersTakesTheKeysToo()
    {
        CockpitStage stage;
        QVERIFY(stage.ready());
        stage.cockpit.openAll();
        IncidentRecord others;
        others.id = 9;
        others.a = robotId;
        others.b = armId;
        others.since = stage.cockpit.now;
        stage.cockpit.models.incidents.raise(others, stage.cockpit.now);
        QVERIFY(button(stage, QStringLiteral("Run checks")) == nullptr);
        QCOMPARE(QApplication::focusWidget(), button(stage, QStringLiteral("Fold")));
        QVERIFY(!stage.window.handHasKeys());
    }

    void foldDoesNotTouchWhatIsBelow()
    {
        CockpitStage stage(QSize(2560, 1440));
        QVERIFY(stage.ready());
        stage.cockpit.openAll();
        stage.cockpit.loseRobot();
        stage.refresh();
        const auto place = [&stage](const char* text) {
            const auto* one = button(stage, QString::fromLatin1(text));
            return QRect(one->mapTo(&stage.window, QPoint()), one->size());
        };
        QTRY_VERIFY(place("Save report").top() - place("Fold").bottom() > 5);
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
        CockpitStage stage(screen);
        QVERIFY(stage.ready());
        stage.cockpit.openAll();
        stage.cockpit.loseRobot();
        const QRect allowed = stage.window.regionGeometry(Region::Sheet);
        for (int i = 0; i < 12; ++i) {
            QVERIFY(allowed.contains(stage.seen(sheet(stage))) || stage.seen(sheet(stage)).isEmpty());
            QTest::qWait(20);
        }
        QTRY_COMPARE(stage.seen(sheet(stage)), allowed);
        QCOMPARE(stage.seen(stage.live), stage.window.regionGeometry(Region::Live));
    }

    void foldsToAChipAndComesBack()
    {
        CockpitStage stage;
        QVERIFY(stage.ready());
        stage.cockpit.openAll();
        stage.cockpit.loseRobot();
        stage.refresh();
        QTest::mouseClick(button(stage, QStringLiteral("Fold")), Qt::LeftButton);
        QVERIFY(!sheet(stage)->isVisible());
        QCOMPARE(QApplication::focusWidget(), static_cast<QWidget*>(&stage.window));
        stage.refresh();
        const auto* band = stage.window.findChild<AlarmBand*>();
        QPushButton* chip = nullptr;
        for (QPushButton* candidate : band->findChildren<QPushButton*>())
            if (candidate->isVisible() && candidate->text().contains(QStringLiteral("link lost")))
                chip = candidate;
        QVERIFY(chip);
        QTest::mouseClick(chip, Qt::LeftButton);
        QVERIFY(sheet(stage)->isVisible());
    }

    void robotsLossComesBeforeOthers()
    {
        CockpitStage stage;
        QVERIFY(stage.ready());
        stage.cockpit.openAll();
        stage.cockpit.loseXray(1);
        stage.refresh();
        QCOMPARE(sheet(stage)->incident(), quint64(1));
        stage.cockpit.loseRobot(2);
        stage.refresh();
        QCOMPARE(sheet(stage)->incident(), quint64(2));
        QVERIFY(button(stage, QStringLiteral("Re-open all lost (2)")));
    }

    void staysUntilTheIncidentEnds()
    {
        CockpitStage stage;
        QVERIFY(stage.ready());
        stage.cockpit.openAll();
        stage.cockpit.loseRobot(5);
        stage.window.showView(View::Topology);
        stage.window.showView(View::Cockpit);
        stage.window.setFocus();
        QTest::mouseClick(stage.live, Qt::LeftButton);
        QVERIFY(sheet(stage)->isVisible());
        stage.cockpit.models.incidents.end(5);
        QVERIFY(!sheet(stage)->isVisible());
    }

    void givingUpAsksOnceMore()
    {
        CockpitStage stage;
        QVERIFY(stage.ready());
        stage.cockpit.openAll();
        stage.cockpit.loseRobot(5);
        stage.refresh();
        QSignalSpy dismiss(&stage.window, &CockpitWindow::dismissRequested);
        QTest::mouseClick(button(stage, QStringLiteral("Give up link\u2026")), Qt::LeftButton);
        QCOMPARE(dismiss.count(), 0);
        QTest::keyClick(QApplication::focusWidget(), Qt::Key_Return);
        QCOMPARE(dismiss.count(), 0);
        QTest::mouseClick(button(stage, QStringLiteral("Give up link\u2026")), Qt::LeftButton);
        QTest::mouseClick(button(stage, QStringLiteral("Give up link")), Qt::LeftButton);
        QCOMPARE(dismiss.count(), 1);
        QCOMPARE(dismiss.first().first().toULongLong(), quint64(5));
    }

    void flapsAreCounted()
    {
        CockpitStage stage;
        QVERIFY(stage.ready());
        stage.cockpit.openAll();
        for (quint64 id = 1; id <= 3; ++id) {
            stage.cockpit.loseRobot(id);
            if (id < 3)
                stage.cockpit.models.incidents.end(id);
        }
        stage.refresh();
        QVERIFY(says(sheet(stage), QStringLiteral("3rd time in 2 min")));
    }

    void timeRuns()
    {
        CockpitStage stage;
        QVERIFY(stage.ready());
        stage.cockpit.openAll();
        stage.cockpit.loseRobot();
        const Instant lost = stage.cockpit.now - std::chrono::seconds(12);
        stage.window.refresh(lost + std::chrono::seconds(20));
        QVERIFY(says(sheet(stage), QStringLiteral("0:20")));
        stage.window.refresh(lost + std::chrono::seconds(21));
        QVERIFY(says(sheet(stage), QStringLiteral("0:21")));
    }

    void markUpFromAPeerStaysText()
    {
        CockpitStage stage;
        QVERIFY(stage.ready());
        for (const QLabel* label : stage.window.findChildren<QLabel*>())
            QCOMPARE(label->textFormat(), Qt::PlainText);
    }
};

QTEST_MAIN(TestDiagnosisSheet)
#include "test_diagnosis_sheet.moc"
