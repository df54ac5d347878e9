// Several screens: what is on them, what becomes of it when one vanishes, and who has the keys. On invented screens.
#include "app/language.hpp"
#include "imaging/live_image_view.hpp"
#include "imaging/reference_image_view.hpp"
#include "invented_picture.hpp"
#include "model/present_readings.hpp"
#include "pseudo_language.hpp"
#include "screens_stage.hpp"
#include "shown_texts.hpp"
#include "widgets/checklist_view.hpp"
#include "widgets/log_lines.hpp"
#include "widgets/plots_view.hpp"
#include "widgets/side_window.hpp"

#include <QLineEdit>
#include <QPushButton>
#include <QSignalSpy>
#include <QWindow>

using namespace console;
using namespace console::test;

using Theatre = ScreensStage;

class TestScreens : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void initTestCase()
    {
        theme::apply(*qApp);
        QCOMPARE(QGuiApplication::screens().size(), 3);
    }

    void liveIsInSightAndNeverSmallerThanAnother_data()
    {
        QTest::addColumn<QSize>("window");
        for (const QSize& size :
             {QSize(2560, 1440), QSize(1920, 1080), QSize(1366, 768), QSize(1280, 1024), QSize(3440, 1440), QSize(1080, 1920)})
            QTest::newRow(qPrintable(QStringLiteral("%1x%2").arg(size.width()).arg(size.height()))) << size;
    }

    void liveIsInSightAndNeverSmallerThanAnother()
    {
        QFETCH(QSize, window);
        const std::array always{Region::Status, Region::Alarm, Region::Links, Region::Live, Region::Motion};
        const std::array all{Region::Status, Region::Alarm, Region::Links, Region::Live,   Region::Reference,
                             Region::Scene,  Region::Robot, Region::Dose,  Region::Trends, Region::Motion};
        for (const auto arrangement : {Arrangement::Usual, Arrangement::ReferenceBeside, Arrangement::SceneBeside}) {
            const auto at = [&](Region region) { return regionRect(region, window, arrangement); };
            QCOMPARE(at(Region::Live).width(), at(Region::Live).height());
            for (const Region other : {Region::Reference, Region::Scene}) {
                QVERIFY(at(other).width() <= at(Region::Live).width());
                QVERIFY(arrangement == Arrangement::Usual || at(other).height() <= at(Region::Live).height());
            }
            for (std::size_t i = 0; i < all.size(); ++i) {
                QVERIFY(QRect(QPoint(), window).contains(at(all[i])) && !at(all[i]).isEmpty());
                for (std::size_t j = i + 1; j < all.size(); ++j)
                    QVERIFY2(!at(all[i]).intersects(at(all[j])),
                             qPrintable(QStringLiteral("%1 %2 %3").arg(i).arg(j).arg(int(arrangement))));
            }
            for (const Region over : {Region::Sheet, Region::Overlay})
                for (const Region region : always)
                    QVERIFY(!at(over).intersects(at(region)));
        }
        const auto least = [](const QRect& rect) { return std::min(rect.width(), rect.height()); };
        QVERIFY(least(regionRect(Region::Reference, window, Arrangement::ReferenceBeside)) > least(regionRect(Region::Reference, window)));
    }

    void oneKeyChangesPlacesAndTheSameKeyTakesItBack()
    {
        Theatre stage;
        QVERIFY(stage.readyWithKeys());
        auto* live = stage.window.findChild<LiveImageView*>();
        auto* reference = stage.window.findChild<ReferenceImageView*>();
        const QRect usual = stage.seen(live);
        QTest::keyClick(&stage.window, Qt::Key_F10);
        QTRY_VERIFY(stage.window.regionGeometry(Region::Live).contains(stage.seen(live)));
        QTRY_VERIFY(stage.window.regionGeometry(Region::Reference).contains(stage.seen(reference)));
        QVERIFY(stage.seen(reference).left() < stage.seen(live).left());
        QVERIFY(stage.seen(reference).height() <= stage.seen(live).height());
        QVERIFY(stage.window.handHasKeys());
        QTest::keyClick(&stage.window, Qt::Key_F11);
        QVERIFY(stage.window.arrangement() == Arrangement::SceneBeside);
        QTest::keyClick(&stage.window, Qt::Key_F11);
        QTRY_COMPARE(stage.seen(live), usual);
    }

    void nothingOfThePicturesIsCutOffInANarrowPlace_data()
    {
        QTest::addColumn<QSize>("screen");
        for (const QSize& size : {QSize(2560, 1440), QSize(1920, 1080), QSize(1366, 768)})
            QTest::newRow(qPrintable(QString::number(size.height()))) << size;
    }

    void nothingOfThePicturesIsCutOffInANarrowPlace()
    {
        QFETCH(QSize, screen);
        Theatre stage(screen);
        QVERIFY(stage.readyWithKeys());
        for (const auto arrangement : {Arrangement::Usual, Arrangement::ReferenceBeside, Arrangement::SceneBeside}) {
            stage.window.setArrangement(arrangement);
            auto* live = stage.window.findChild<LiveImageView*>();
            const QRect place = stage.window.regionGeometry(Region::Live);
            const auto cutOff = [&] {
                for (const auto* button : live->parentWidget()->findChildren<QPushButton*>()) {
                    const QRect at(button->mapTo(&stage.window, QPoint()), button->size());
                    if (!place.contains(at) || at.width() < button->minimumSizeHint().width())
                        return button->accessibleName();
                }
                return QString();
            };
            QTRY_COMPARE(cutOff(), QString());
            QCOMPARE(live->parentWidget()->geometry(), place);
            // What is painted, without the controls beneath.
            const auto* reference = stage.window.findChild<ReferenceImageView*>();
            for (const QSize& other : {reference->size(), stage.window.regionGeometry(Region::Scene).size()})
                QVERIFY2(std::min(other.width(), other.height()) <= std::min(live->width(), live->height()),
                         qPrintable(QStringLiteral("%1 %2").arg(other.height()).arg(live->height())));
        }
    }

    void aViewBesideLeavesTheLivePicture()
    {
        Theatre stage;
        QVERIFY(stage.readyWithKeys());
        QTest::keyClick(&stage.window, Qt::Key_F10);
        QTest::keyClick(&stage.window, Qt::Key_F2);
        QVERIFY(stage.topology->isVisible());
        for (const Region region : {Region::Live, Region::Alarm, Region::Motion})
            QVERIFY(!stage.seen(stage.topology).intersects(stage.window.regionGeometry(region)));
    }

    void furtherScreensShowWhatWasChosenAndTakeNoKeys()
    {
        Theatre stage;
        QVERIFY(stage.readyWithKeys());
        Q_EMIT stage.view->secondChosen(QStringLiteral("second"));
        Q_EMIT stage.view->thirdChosen(QStringLiteral("third"));
        QVERIFY(stage.desk->second() && stage.desk->third());
        QTRY_VERIFY(stage.desk->second()->isVisible() && stage.desk->third()->isVisible());
        QCOMPARE(stage.desk->second()->screen()->name(), QStringLiteral("second"));
        QCOMPARE(stage.desk->third()->screen()->name(), QStringLiteral("third"));
        const QPoint alarms = stage.window.mapToGlobal(stage.window.regionGeometry(Region::Alarm).center()); // which nothing may hide
        for (const SideWindow* side : {stage.desk->second(), stage.desk->third()})
            QVERIFY(!side->geometry().contains(alarms));
        QVERIFY(stage.desk->second()->findChild<TopologyCanvas*>() != nullptr);
        auto* copy = stage.desk->third()->findChild<ReferenceImageView*>();
        QVERIFY(copy != nullptr);
        const QSize live = stage.window.regionGeometry(Region::Live).size();
        QTRY_VERIFY(copy->width() <= live.width() && copy->height() <= live.height());
        QVERIFY(!copy->size().isEmpty());
    }

    void onlyThePrimaryScreenWasMeasured()
    {
        Theatre stage;
        QVERIFY(stage.readyWithKeys());
        DisplayPicture picture;
        picture.isCalibrated = true;
        for (const auto* pane : stage.window.findChildren<PictureCanvas*>())
            QVERIFY(pane->asSeenHere(picture).isCalibrated);
        Q_EMIT stage.view->thirdChosen(QStringLiteral("third"));
        auto* copy = stage.desk->third()->findChild<ReferenceImageView*>();
        QTRY_COMPARE(copy->screen()->name(), QStringLiteral("third"));
        QVERIFY(!copy->asSeenHere(picture).isCalibrated);
    }

    void theSecondScreenShowsTopologyConditionsPlotsAndLogWhole()
    {
        Theatre stage;
        QVERIFY(stage.readyWithKeys());
        stage.cockpit.openAll();
        Q_EMIT stage.view->secondChosen(QStringLiteral("second"));
        auto* side = stage.desk->second();
        QTRY_VERIFY(side->isVisible());
        const auto* conditions = side->findChild<ChecklistPane*>();
        QVERIFY(conditions && side->findChild<TopologyCanvas*>() && side->findChild<PlotsView*>() && side->findChild<LogLines*>());
        QSet<QString> told;
        for (const QWidget* row : conditions->findChildren<QWidget*>())
            told.insert(row->accessibleName());
        for (const GuardLine& line : stage.cockpit.models.permit.checklist())
            QVERIFY2(told.contains(line.text), qPrintable(line.text));
        for (const QWidget* widget : side->findChildren<QWidget*>())
            QVERIFY2(widget->focusPolicy() == Qt::NoFocus || widget->focusProxy() || !widget->isVisible() ||
                         !widget->accessibleName().isEmpty(),
                     widget->metaObject()->className());
    }

    void aFurtherScreenInFocusTakesTheKeysFromTheHandAndStillStops()
    {
        Theatre stage;
        QVERIFY(stage.readyWithKeys());
        Q_EMIT stage.view->secondChosen(QStringLiteral("second"));
        auto* side = stage.desk->second();
        side->activateWindow();
        QVERIFY(QTest::qWaitForWindowActive(side));
        side->setFocus();
        QVERIFY(!stage.window.handHasKeys());
        QSignalSpy pressed(&stage.window, &CockpitWindow::handKeyPressed);
        QSignalSpy stop(&stage.window, &CockpitWindow::emergencyStopRequested);
        QSignalSpy hold(&stage.window, &CockpitWindow::panicHoldRequested);
        QTest::keyClick(side, Qt::Key_D);
        QTest::keyClick(side, Qt::Key_F12);
        QTest::keyClick(side, Qt::Key_Escape);
        QCOMPARE(pressed.count(), 0);
        QCOMPARE(hold.count(), 1);
        QCOMPARE(stop.count(), 1);
        QVERIFY(side->isVisible());
        QTest::keyClick(side, Qt::Key_F1);
        QTRY_VERIFY(stage.window.isActiveWindow());
    }

    void aVanishedScreenFoldsAtOnceAndTheHandKeepsItsKeysIfItWasElsewhere()
    {
        Theatre stage;
        QVERIFY(stage.readyWithKeys());
        Q_EMIT stage.view->secondChosen(QStringLiteral("second"));
        Q_EMIT stage.view->thirdChosen(QStringLiteral("third"));
        stage.window.activateWindow();
        stage.window.setFocus();
        QTRY_VERIFY(stage.window.handHasKeys());
        QSignalSpy hand(&stage.window, &CockpitWindow::handFocusChanged);
        Q_EMIT qGuiApp->screenRemoved(screenNamed("second"));
        QVERIFY(!stage.desk->second()); // in the same turn of the event loop
        QVERIFY(stage.desk->third());
        QVERIFY(stage.saidInTheLog(QStringLiteral("second is gone")));
        QCOMPARE(hand.count(), 0);
        QVERIFY(stage.window.handHasKeys());
    }

    void theCockpitsScreenVanishesAndTheHandLosesItsKeysUntilAPersonTakesThem_data()
    {
        QTest::addColumn<bool>("byMouse");
        QTest::newRow("a click") << true;
        QTest::newRow("F1") << false;
    }

    void theCockpitsScreenVanishesAndTheHandLosesItsKeysUntilAPersonTakesThem()
    {
        QFETCH(bool, byMouse);
        Theatre stage;
        QVERIFY(stage.readyWithKeys());
        QCOMPARE(stage.desk->present().cockpit, QStringLiteral("first"));
        Q_EMIT stage.view->secondChosen(QStringLiteral("second"));
        Q_EMIT stage.view->thirdChosen(QStringLiteral("third"));
        stage.window.activateWindow();
        stage.window.setFocus();
        QTRY_VERIFY(stage.window.handHasKeys());
        QSignalSpy hand(&stage.window, &CockpitWindow::handFocusChanged);
        Q_EMIT qGuiApp->screenRemoved(screenNamed("first"));
        QCOMPARE(hand.count(), 1);
        QCOMPARE(hand.first().first().toBool(), false);
        QCOMPARE(stage.desk->present().cockpit, QStringLiteral("second"));
        QVERIFY(!stage.desk->second()); // the cockpit needs the room
        QVERIFY(stage.desk->third());
        QTRY_COMPARE(stage.window.screen()->name(), QStringLiteral("second"));
        QVERIFY(stage.window.isVisible());
        stage.window.activateWindow();
        stage.window.setFocus();
        QTRY_VERIFY(stage.window.isActiveWindow());
        QVERIFY(!stage.window.handHasKeys()); // activity and focus alone do not give them back
        QSignalSpy pressed(&stage.window, &CockpitWindow::handKeyPressed);
        QTest::keyClick(&stage.window, Qt::Key_D);
        QCOMPARE(pressed.count(), 0);
        const auto keysMissing = [&stage] {
            const auto readings = guardReadings(stage.cockpit.models, robotId, stage.window.handHasKeys(), stage.cockpit.now);
            return checkGuards(readings).at(std::size_t(Guard::WindowActive)).text;
        };
        QVERIFY2(keysMissing().contains(QStringLiteral("click into the cockpit")), qPrintable(keysMissing()));
        if (byMouse)
            QTest::mouseClick(&stage.window, Qt::LeftButton, {}, stage.window.regionGeometry(Region::Status).center());
        else
            QTest::keyClick(&stage.window, Qt::Key_F1);
        QTRY_VERIFY(stage.window.handHasKeys());
        QVERIFY(!stage.cockpit.models.screenGone);
    }

    void layoutsAreSavedRestoredByOneKeyAndDeleted()
    {
        Theatre stage;
        QVERIFY(stage.readyWithKeys());
        Q_EMIT stage.view->secondChosen(QStringLiteral("second"));
        stage.window.setArrangement(Arrangement::ReferenceBeside);
        stage.window.showView(View::Screens);
        auto* name = stage.named<QLineEdit>(QStringLiteral("Name for the present layout"));
        QVERIFY(name != nullptr);
        name->setFocus();
        QTest::keyClicks(name, QStringLiteral("Two \"screens\""));
        QTest::keyClick(name, Qt::Key_Return);
        QCOMPARE(stage.desk->book().layouts().size(), std::size_t(1));
        Q_EMIT stage.view->secondChosen(QString());
        stage.window.setArrangement(Arrangement::Usual);
        QVERIFY(!stage.desk->second());
        QTest::keyClick(QApplication::focusWidget(), Qt::Key_1, Qt::ControlModifier);
        QVERIFY(stage.desk->second());
        QVERIFY(stage.window.arrangement() == Arrangement::ReferenceBeside);
        auto* remove = stage.named<QPushButton>(QStringLiteral("Delete the layout Two \"screens\""));
        QVERIFY(remove != nullptr);
        QTest::mouseClick(remove, Qt::LeftButton);
        QVERIFY(stage.desk->book().layouts().empty());
        stage.window.showView(View::Cockpit);
        QTest::keyClick(QApplication::focusWidget(), Qt::Key_1, Qt::ControlModifier);
        QVERIFY(stage.saidInTheLog(QStringLiteral("There is no layout 1")));
        QVERIFY(stage.window.view() == View::Screens); // it is said where it is read
    }

    void armedScreensStayAndPicturesMayChangePlaces()
    {
        Theatre stage;
        QVERIFY(stage.readyWithKeys());
        stage.cockpit.openAll();
        stage.cockpit.arm();
        Q_EMIT stage.view->secondChosen(QStringLiteral("second"));
        QVERIFY(!stage.desk->second());
        QVERIFY(stage.saidInTheLog(QStringLiteral("stay as they are")));
        QTest::keyClick(&stage.window, Qt::Key_9, Qt::ControlModifier); // there is none, and no view takes the keys for it
        QVERIFY(stage.window.view() == View::Cockpit);
        QTest::keyClick(&stage.window, Qt::Key_F10);
        QVERIFY(stage.window.arrangement() == Arrangement::ReferenceBeside);
        QVERIFY(stage.cockpit.models.permit.phase() == PermitPhase::Armed);
    }

    // Last: from its Chinese rows on the program speaks Chinese.
    void furtherScreensAreWholeInEveryLanguage_data()
    {
        QTest::addColumn<QString>("language");
        QTest::addColumn<bool>("lost");
        for (const char* language : {"en", "pseudo", "zh_CN"})
            for (const bool lost : {false, true})
                QTest::addRow("%s, %s", language, lost ? "links lost" : "all open") << QString::fromLatin1(language) << lost;
    }

    void furtherScreensAreWholeInEveryLanguage()
    {
        QFETCH(QString, language);
        QFETCH(bool, lost);
        PseudoLanguage pseudo;
        if (language == QLatin1String("pseudo"))
            QVERIFY(QApplication::installTranslator(&pseudo));
        else
            QCOMPARE(speak(language), QString());
        for (const bool swapped : {false, true}) {
            Theatre stage;
            QVERIFY(stage.readyWithKeys());
            stage.cockpit.openAll();
            if (lost) {
                stage.cockpit.arm(), stage.cockpit.loseXray(), stage.cockpit.loseRobot();
                stage.cockpit.logEvents();
            }
            Q_EMIT stage.view->secondChosen(swapped ? QStringLiteral("third") : QStringLiteral("second"));
            Q_EMIT stage.view->thirdChosen(swapped ? QStringLiteral("second") : QStringLiteral("third"));
            QVERIFY(stage.desk->second() && stage.desk->third());
            QTRY_VERIFY(stage.desk->second()->isVisible() && stage.desk->third()->isVisible());
            auto* reference = stage.desk->third()->findChild<ReferenceImageView*>();
            QVERIFY(reference != nullptr);
            for (SideWindow* side : {stage.desk->second(), stage.desk->third()}) {
                QStringList wrong;
                QTRY_VERIFY2((wrong = unreadableTexts(*side)).isEmpty(), qPrintable(wrong.join(QLatin1Char('\n'))));
            }
            reference->showPicture(inventedPicture(*stage.cockpit.models.picture.newest(), PictureRole::Review));
            reference->setPlace(
                QCoreApplication::translate("console::CineReview", "%1 of %2, %3 s before the newest").arg(612).arg(900).arg(19.2));
            QStringList wrong;
            QTRY_VERIFY2((wrong = unreadableTexts(*stage.desk->third())).isEmpty(), qPrintable(wrong.join(QLatin1Char('\n'))));
        }
    }
};

QTEST_MAIN(TestScreens)
#include "test_screens.moc"
