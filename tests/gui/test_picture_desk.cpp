// Tests of the picture panes in the cockpit's window, with the chain behind them: live, hold, review, saving, and whose keys are whose.
#include "imaging/scene_view.hpp"
#include "picture_desk_stage.hpp"
#include "widgets/review_controls.hpp"
#include "widgets/theme.hpp"

#include <QSignalSpy>
#include <QSlider>

using namespace console;

using Desk = console::test::PictureDeskStage;

class TestPictureDesk : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void initTestCase() { theme::apply(*qApp); }

    void referenceNeverCoversLive()
    {
        Desk desk;
        QVERIFY(desk.live && desk.reference);
        const auto placeOf = [&desk](const QWidget* view) { return QRect(view->mapTo(&desk.window, QPoint()), view->size()); };
        QVERIFY(desk.window.regionGeometry(Region::Live).contains(placeOf(desk.live)));
        QVERIFY(desk.window.regionGeometry(Region::Reference).contains(placeOf(desk.reference)));
        QVERIFY(!placeOf(desk.live).intersects(placeOf(desk.reference)));
        for (const SmallButton* button : desk.window.findChildren<SmallButton*>())
            QVERIFY(!placeOf(button).intersects(placeOf(desk.live)));
    }

    void holdsWhenThePedalGoesUp()
    {
        Desk desk;
        QVERIFY(desk.send(1));
        QVERIFY(desk.send(2));
        QVERIFY(!desk.reference->picture());
        desk.models.picture.expect(0, std::chrono::steady_clock::now());
        QTRY_VERIFY(desk.reference->picture());
        QCOMPARE(desk.reference->picture()->role, PictureRole::Hold);
        QCOMPARE(desk.reference->picture()->about.frame, 2U);
        QCOMPARE(desk.live->picture()->role, PictureRole::Live);
    }

    void holdsTheMeanWhereThatIsWanted()
    {
        Desk desk;
        QVERIFY(desk.holdMeanOfThree());
        QVERIFY(desk.reference->accessibleDescription().startsWith(QStringLiteral("LAST IMAGE HOLD \u00B7 MEAN OF 3")));
        QCOMPARE(desk.live->picture()->meanOf, 1);
        QCOMPARE(desk.live->picture()->role, PictureRole::Live);
        QCOMPARE(desk.models.picture.paintedCount(), quint64(3));
    }

    /// As while the cockpit's window is minimised.
    void holdsThoughTheLivePaneIsNotPainted()
    {
        Desk desk;
        desk.window.hide();
        for (quint32 number = 1; number <= 2; ++number) {
            desk.desk.pipeline().showFrame(samples::frame(number, Desk::frameSize, 12, PixelEncoding::Raw));
            QTRY_COMPARE(desk.desk.pipeline().counts().shown, quint64(number));
        }
        desk.models.picture.expect(0, std::chrono::steady_clock::now());
        QTRY_VERIFY(desk.reference->picture());
        QCOMPARE(desk.reference->picture()->role, PictureRole::Hold);
        QCOMPARE(desk.reference->picture()->about.frame, 2U);
        QCOMPARE(desk.models.picture.paintedCount(), quint64(0));
    }

    /// The same, with the reference pane on a further screen in sight.
    void aRoadmapSaysWhatThePictureIsThoughTheLivePaneIsNotPainted()
    {
        Desk desk;
        desk.moveTable(0);
        QVERIFY(desk.sendContrast(1));
        QVERIFY2(desk.makeRoadmap(), qPrintable(desk.reference->told()));
        const std::unique_ptr<ReferenceImageView> copy(desk.desk.makeReferenceCopy());
        QVERIFY(copy->picture() && copy->picture()->role == PictureRole::Roadmap);
        desk.window.hide();
        const auto copySays = [&copy](const char* words) { return copy->accessibleDescription().startsWith(QString::fromLatin1(words)); };
        QTRY_VERIFY2(copySays("ROADMAP  SIMULATED  FROZEN"), qPrintable(copy->accessibleDescription()));
        desk.models.picture.expect(0, std::chrono::steady_clock::now());
        QTRY_VERIFY2(copySays("ROADMAP  SIMULATED  LAST IMAGE HOLD"), qPrintable(copy->accessibleDescription()));
        QCOMPARE(copy->picture()->role, PictureRole::Roadmap); // the hold takes no roadmap's place
    }

    void reviewsBesideTheLivePicture()
    {
        Desk desk;
        for (quint32 number = 1; number <= 4; ++number)
            QVERIFY(desk.send(number));
        desk.click(QStringLiteral("Review"));
        QTRY_VERIFY(desk.reference->picture());
        desk.click(QStringLiteral("Oldest picture"));
        QTRY_COMPARE(desk.reference->picture()->about.frame, 1U);
        QCOMPARE(desk.reference->picture()->role, PictureRole::Review);
        // The live picture goes on meanwhile, and only it is counted.
        QVERIFY(desk.send(5));
        QCOMPARE(desk.live->picture()->about.frame, 5U);
        QCOMPARE(desk.models.picture.paintedCount(), quint64(5));
        QCOMPARE(desk.models.picture.newest()->frame, 5U);
        QCOMPARE(desk.reference->picture()->about.frame, 1U);
        // A hold that comes while a review is open does not push it away; asked for, it does.
        desk.models.picture.expect(0, std::chrono::steady_clock::now());
        QTRY_VERIFY(desk.live->accessibleDescription().startsWith(QStringLiteral("Last image hold")));
        QCoreApplication::processEvents();
        QCOMPARE(desk.reference->picture()->role, PictureRole::Review);
        desk.click(QStringLiteral("Last image hold"));
        QCOMPARE(desk.reference->picture()->role, PictureRole::Hold);
        QCOMPARE(desk.reference->picture()->about.frame, 5U);
    }

    void aCatheterIsOfThePictureThatAPersonMeasures()
    {
        Desk desk;
        QVERIFY(desk.send(1));
        desk.models.picture.expect(0, std::chrono::steady_clock::now());
        QTRY_VERIFY(desk.reference->picture());
        desk.click(QStringLiteral("Measure"));
        const auto measureOn = [](PictureCanvas& pane) {
            for (const int way : {0, 40})
                QTest::mouseClick(&pane, Qt::LeftButton, {}, pane.pictureRect().center() + QPoint(way, 0));
        };
        for (PictureCanvas* pane : {static_cast<PictureCanvas*>(desk.reference), static_cast<PictureCanvas*>(desk.live)}) {
            measureOn(*pane);
            desk.click(QStringLiteral("Width of a catheter"));
            QCOMPARE(pane->measurement().text(), QStringLiteral("1.3 mm (4 F catheter)"));
            QCOMPARE(desk.live->measurement().isCatheter(), pane == desk.live);
        }
        QVERIFY(desk.reference->measurement().isCatheter());
    }

    void reviewAloneShowsNoLivePicture()
    {
        Desk desk;
        QVERIFY(desk.send(1));
        desk.models.picture.setLinkUp(false);
        desk.click(QStringLiteral("Review"));
        QTRY_VERIFY(desk.reference->picture());
        for (int i = 0; i < 3; ++i) {
            desk.click(QStringLiteral("One picture back"));
            desk.click(QStringLiteral("One picture on"));
        }
        QCoreApplication::processEvents();
        desk.reference->grab();
        QCOMPARE(desk.models.picture.paintedCount(), quint64(1));
        QCOMPARE(desk.models.picture.reading(std::chrono::steady_clock::now()).condition, PictureCondition::Frozen);
    }

    void savesPicturesAndSaysSo()
    {
        Desk desk;
        desk.click(QStringLiteral("Save picture"));
        QCOMPARE(desk.live->told(), QStringLiteral("there is no picture to save yet"));
        QVERIFY(desk.send(1));
        desk.live->grab();
        const QRegion before = desk.live->overlayRegion();
        desk.click(QStringLiteral("Save picture"));
        const QDir saved(desk.folder.filePath(QStringLiteral("saved")));
        QTRY_COMPARE(saved.entryList({QStringLiteral("*_live_*.png")}, QDir::Files).size(), 1);
        QTRY_COMPARE(saved.entryList({QStringLiteral("*_live_*.dcm")}, QDir::Files).size(), 1);
        QTRY_VERIFY(desk.live->told().startsWith(QStringLiteral("picture saved: ")));
        desk.live->grab();
        QVERIFY(!(desk.live->overlayRegion() - before).isEmpty()); // where the eye is
        QVERIFY(QRegion(desk.live->rect()).contains(desk.live->overlayRegion().boundingRect()));
        QVERIFY(desk.reference->told().isEmpty());
    }

    void aFrozenPictureIsSavedAsOneWithWhatWasMeasuredOnIt()
    {
        Desk desk;
        QVERIFY(desk.send(1));
        desk.models.picture.setLinkUp(false);
        desk.desk.display().nextMeasureMode();
        for (const double share : {0.3, 0.6})
            QTest::mouseClick(desk.live, Qt::LeftButton, {}, (QPointF(desk.live->rect().bottomRight()) * share).toPoint());
        QVERIFY(!desk.live->measurement().text().isEmpty());
        desk.click(QStringLiteral("Save picture"));
        const QDir saved(desk.folder.filePath(QStringLiteral("saved")));
        QTRY_COMPARE(saved.entryList({QStringLiteral("*_live_*.png")}, QDir::Files).size(), 1); // written after the DICOM file
        QFile file(saved.filePath(saved.entryList({QStringLiteral("*_live_*.dcm")}, QDir::Files).first()));
        QVERIFY(file.open(QIODevice::ReadOnly));
        const QByteArray bytes = file.readAll();
        for (const QByteArray& words : {QByteArray("SNAPSHOT  FROZEN  SIMULATED"), desk.live->measurement().text().toUtf8(),
                                        QByteArray("Anna Invented"), QByteArray("PID-4711")})
            QVERIFY2(bytes.contains(words), words.constData());
    }

    void saysWhyNothingCouldBeSaved()
    {
        Desk desk;
        QVERIFY(desk.send(1));
        QFile inTheWay(desk.folder.filePath(QStringLiteral("saved")));
        QVERIFY(inTheWay.open(QIODevice::WriteOnly));
        desk.click(QStringLiteral("Save picture"));
        QTRY_VERIFY(desk.live->told().contains(QStringLiteral("cannot be made")));
    }

    void answersButtonsThatCannotDoAnything()
    {
        Desk desk;
        desk.click(QStringLiteral("Review"));
        QCOMPARE(desk.reference->told(), QStringLiteral("there is nothing to review yet"));
        QVERIFY(!desk.makeRoadmap());
        QVERIFY(desk.reference->told().startsWith(QStringLiteral("no roadmap: ")));
        desk.click(QStringLiteral("Last image hold"));
        QCOMPARE(desk.reference->told(), QStringLiteral("no run has ended yet: there is no last image"));
        desk.click(QStringLiteral("Save reference picture"));
        QCOMPARE(desk.reference->told(), QStringLiteral("there is no picture to save yet"));
        QVERIFY(desk.live->told().isEmpty());
        QTRY_VERIFY_WITH_TIMEOUT(desk.reference->told().isEmpty(), 8000); // it does not stay
    }

    void aRoadmapThatWasRemovedIsMadeAnewAlsoWhenTheClockWasSetBack()
    {
        Desk desk;
        const auto& roadmap = desk.models.roadmap;
        desk.moveTable(0);
        QVERIFY(desk.sendContrast(1));
        QVERIFY2(desk.makeRoadmap(), qPrintable(desk.reference->told()));
        desk.moveTable(10);
        QVERIFY(roadmap.isWanted() && !roadmap.isValid());
        QVERIFY(!desk.makeRoadmap());
        QCOMPARE(desk.reference->told(), QStringLiteral("no roadmap: it was removed, and no contrast was given since"));
        QVERIFY(desk.sendContrast(2, std::chrono::minutes(5)));
        QVERIFY2(desk.makeRoadmap(), qPrintable(desk.reference->told()));
    }

    /// It takes its time, in which the thread that hears hands does not wait.
    void aRoadmapIsMadeBesideTheWindowsThread()
    {
        Desk desk;
        desk.moveTable(0);
        QVERIFY(desk.sendContrast(1));
        desk.click(QStringLiteral("Roadmap"));
        QVERIFY(!desk.models.roadmap.isWanted());
        desk.models.picture.expect(0, std::chrono::steady_clock::now()); // the run's last picture does not take its place
        QTRY_VERIFY(desk.models.roadmap.isValid());
        QCOMPARE(desk.reference->picture()->role, PictureRole::Roadmap);
    }

    void aRunThatEndsWhileNoRoadmapCanBeMadeIsHeld()
    {
        Desk desk;
        QVERIFY(desk.send(1));
        desk.click(QStringLiteral("Roadmap"));
        desk.models.picture.expect(0, std::chrono::steady_clock::now());
        QTRY_VERIFY(desk.reference->told().startsWith(QStringLiteral("no roadmap: ")));
        QTRY_VERIFY(desk.reference->picture());
        QCOMPARE(desk.reference->picture()->role, PictureRole::Hold);
    }

    /// Also when its answer is there already, and not yet heard: the pauses are for that.
    void whatIsWantedInTheMeantimeStands()
    {
        constexpr int answered = 300; // ms
        Desk desk;
        desk.moveTable(0);
        QVERIFY(desk.sendContrast(1));
        desk.click(QStringLiteral("Roadmap"));
        QTest::qSleep(answered);
        desk.click(QStringLiteral("Review"));
        QTRY_VERIFY(desk.reference->picture());
        QCOMPARE(desk.reference->picture()->role, PictureRole::Review);
        QVERIFY(desk.makeRoadmap());
        QCOMPARE(desk.models.log.lines().size(), std::size_t(1));
        // It is removed while it is being made anew: what was taken until then serves no more.
        desk.click(QStringLiteral("Roadmap"));
        QTest::qSleep(answered);
        desk.moveTable(10);
        QVERIFY(!desk.makeRoadmap());
        QCOMPARE(desk.reference->told(), QStringLiteral("no roadmap: it was removed, and no contrast was given since"));
    }

    void nothingThatWasMeasuredStandsOverAnotherPlace()
    {
        Desk desk;
        desk.moveTable(0);
        QVERIFY(desk.send(1));
        desk.desk.display().nextMeasureMode();
        for (const double share : {0.3, 0.6})
            QTest::mouseClick(desk.live, Qt::LeftButton, {}, (QPointF(desk.live->rect().bottomRight()) * share).toPoint());
        QVERIFY(desk.send(2));
        QVERIFY(!desk.live->measurement().points().empty());
        desk.moveTable(10);
        QVERIFY(desk.send(3));
        QVERIFY(desk.live->measurement().points().empty());
    }

    void aCopyOnAnotherScreenBeginsAsThePaneIs()
    {
        Desk desk;
        desk.desk.display().nextMeasureMode();
        auto* strength = desk.window.findChild<ReviewControls*>()->findChild<QSlider*>();
        strength->setValue(15);
        const std::unique_ptr<ReferenceImageView> copy(desk.desk.makeReferenceCopy());
        QCOMPARE(copy->opacity(), 0.15);
        QCOMPARE(copy->measurement().mode(), MeasureMode::Distance);
    }

    void sceneLeavesTheHandItsOwn()
    {
        Desk desk;
        auto* scene = new SceneView;
        desk.window.setSceneView(scene);
        QVERIFY(QTest::qWaitForWindowActive(&desk.window));
        QSignalSpy hand(&desk.window, &CockpitWindow::handKeyPressed);
        QSignalSpy focus(&desk.window, &CockpitWindow::handFocusChanged);
        QTest::mouseClick(scene, Qt::LeftButton, {}, scene->rect().center());
        QCOMPARE(focus.count(), 0);
        const OrbitCamera camera = scene->camera();
        QTest::keyClick(QApplication::focusWidget(), Qt::Key_Up); // moves the wire, and not the camera
        QCOMPARE(hand.count(), 1);
        scene->setFocus(Qt::TabFocusReason);
        QTest::keyClick(scene, Qt::Key_Left);
        QCOMPARE(hand.count(), 2);
        QCOMPARE(scene->camera(), camera);
        QTest::keyClick(scene, Qt::Key_4);
        QCOMPARE(hand.count(), 2);
        QVERIFY(scene->camera() != camera);
    }

    /// The scale is the hand's also where a slider would take a large step; the buttons beside it are the keyboard's way.
    void pageKeysLeaveTheVesselsStrength()
    {
        Desk desk;
        QVERIFY(QTest::qWaitForWindowActive(&desk.window));
        QSignalSpy hand(&desk.window, &CockpitWindow::handKeyPressed);
        auto* controls = desk.window.findChild<ReviewControls*>();
        controls->showRoadmap(true);
        auto* strength = controls->findChild<QSlider*>();
        const int before = strength->value();
        strength->setFocus(Qt::TabFocusReason);
        QCOMPARE(QApplication::focusWidget(), static_cast<QWidget*>(strength));
        QTest::keyClick(strength, Qt::Key_PageDown);
        QCOMPARE(hand.count(), 1);
        QCOMPARE(hand.back().front().toInt(), int(Qt::Key_PageDown));
        QCOMPARE(strength->value(), before);
        desk.button(QStringLiteral("Stronger vessels of the roadmap"))->setFocus(Qt::TabFocusReason);
        QTest::keyClick(QApplication::focusWidget(), Qt::Key_Space);
        QCOMPARE(desk.reference->opacity(), 0.7);
        QCOMPARE(hand.count(), 1);
    }

    void picturesKeysLeaveTheHandItsOwn()
    {
        Desk desk;
        QVERIFY(QTest::qWaitForWindowActive(&desk.window));
        QVERIFY(desk.send(1));
        QSignalSpy hand(&desk.window, &CockpitWindow::handKeyPressed);
        QSignalSpy focus(&desk.window, &CockpitWindow::handFocusChanged);
        desk.click(QStringLiteral("Invert"));
        QTest::mouseClick(desk.live, Qt::LeftButton, {}, desk.live->rect().center());
        QCOMPARE(focus.count(), 0);
        desk.live->setFocus(Qt::TabFocusReason);
        QTest::keyClick(desk.live, Qt::Key_N);
        QTest::keyClick(desk.live, Qt::Key_Plus);
        QCOMPARE(hand.count(), 0);
        QTest::keyClick(desk.live, Qt::Key_D);
        QCOMPARE(hand.count(), 1);
        QTest::keyClick(desk.live, Qt::Key_Space);
        QCOMPARE(hand.count(), 1);
    }

    void readsMeasurementOfTheDisplay()
    {
        const QTemporaryDir folder;
        QFile file(folder.filePath(QStringLiteral("display.txt")));
        QVERIFY(file.open(QIODevice::WriteOnly));
        file.write("ambient 0.2\n0 0.4\n128 60\n255 350\n");
        file.close();
        QString error;
        Desk calibrated(file.fileName());
        QVERIFY2(calibrated.desk.prepare(&error), qPrintable(error));
        QVERIFY(calibrated.send(1));
        QVERIFY(calibrated.live->picture()->isCalibrated);
        Desk none(folder.filePath(QStringLiteral("missing.txt")));
        QVERIFY(!none.desk.prepare(&error));
        QVERIFY(error.contains(QStringLiteral("missing.txt")));
    }
};

QTEST_MAIN(TestPictureDesk)
#include "test_picture_desk.moc"
