// Ctrl+,: what is shown and changed, when it may not be, and what brightness never touches.
#include "app/picture_desk.hpp"
#include "app/preference_desk.hpp"
#include "cockpit_stage.hpp"
#include "imaging/live_image_view.hpp"
#include "invented_picture.hpp"
#include "widgets/choice_row.hpp"
#include "widgets/preferences_view.hpp"
#include "widgets/row_area.hpp"
#include "widgets/sheet_button.hpp"
#include "widgets/trends_pane.hpp"

#include <QLabel>
#include <QLineEdit>
#include <QScrollBar>
#include <QSignalSpy>
#include <QTemporaryDir>

using namespace console;
using namespace console::test;

namespace {

struct Prepared : CockpitStage {
    QTemporaryDir folder;
    Options options;
    PictureDesk pictures;
    PreferenceDesk desk;
    PreferencesView* view;

    explicit Prepared(const QSize& size = {1920, 1080}, const QString& onTheCommandLine = {})
        : CockpitStage(size),
          options(at(folder, onTheCommandLine)),
          pictures(options, cockpit.models),
          desk(options, cockpit.models, pictures)
    {
        pictures.build(window);
        desk.build(window);
        view = window.findChild<PreferencesView*>();
    }

    ~Prepared() { theme::setBrightness(*qApp, Brightness::Usual); }

    static Options at(const QTemporaryDir& folder, const QString& pictures)
    {
        Options options;
        options.preferences = folder.filePath(QStringLiteral("preferences.ini"));
        options.pictures = pictures;
        return options;
    }

    bool open()
    {
        if (!ready())
            return false;
        QTest::keyClick(&window, Qt::Key_Comma, Qt::ControlModifier);
        return view->isVisible();
    }

    SheetButton* button(const QString& name) const
    {
        for (SheetButton* candidate : view->findChildren<SheetButton*>())
            if (candidate->accessibleName() == name)
                return candidate;
        return nullptr;
    }

    QLineEdit* line(const QString& name) const
    {
        for (QLineEdit* candidate : view->findChildren<QLineEdit*>())
            if (candidate->accessibleName() == name)
                return candidate;
        return nullptr;
    }

    void choose(const QString& name) const
    {
        auto* chosen = button(name);
        QVERIFY2(chosen != nullptr, qPrintable(name));
        chosen->setFocus();
        QTest::keyClick(chosen, Qt::Key_Return);
    }

    Preferences kept() const { return PreferenceStore(options.preferences).read().preferences; }

    bool says(const QString& words) const
    {
        for (const QLabel* label : view->findChildren<QLabel*>())
            if (label->isVisible() && label->text().contains(words))
                return true;
        return false;
    }
};

} // namespace

class TestPreferencesView : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void initTestCase() { theme::apply(*qApp); }

    /// A field that somebody types into lets them through, and no part of them is the hand's.
    void itsKeysWorkInAFieldAndAreNoneOfTheHands()
    {
        Prepared stage;
        QVERIFY(stage.ready());
        QSignalSpy pressed(&stage.window, &CockpitWindow::handKeyPressed);
        const auto strike = [](Qt::KeyboardModifiers modifiers) {
            for (const auto type : {QTest::Press, QTest::Release})
                QTest::sendKeyEvent(type, QApplication::focusWidget(), Qt::Key_Comma, QStringLiteral(","), modifiers);
        };
        QTest::keyClick(&stage.window, Qt::Key_F4);
        auto* words = stage.named<QLineEdit>(QStringLiteral("Only lines with these words"));
        QVERIFY(words != nullptr);
        words->setFocus();
        strike(Qt::NoModifier);
        QCOMPARE(stage.window.view(), View::Log);
        strike(Qt::ControlModifier);
        QVERIFY(stage.view->isVisible());
        QCOMPARE(words->text(), QStringLiteral(","));
        strike(Qt::ControlModifier);
        QCOMPARE(stage.window.view(), View::Cockpit);
        QTest::keyClick(&stage.window, Qt::Key_F6); // that of the conditions now
        QVERIFY(!stage.view->isVisible());
        QCOMPARE(pressed.count(), 0);
    }

    void aChoiceIsInForceAndKeptAtOnce()
    {
        Prepared stage;
        QVERIFY(stage.open());
        stage.choose(QStringLiteral("Audio pause: 120 s"));
        stage.choose(QStringLiteral("Trends: 10 min"));
        stage.choose(QStringLiteral("Noise reduction: 40 %"));
        stage.choose(QStringLiteral("Edges by: multi-scale"));
        stage.choose(QStringLiteral("Brightness: dim"));
        stage.choose(QStringLiteral("X-ray pulses: 30 /s"));
        QCOMPARE(stage.desk.preferences().holdPictures, 1);
        stage.choose(QStringLiteral("Last image hold: mean of 4"));
        QCOMPARE(stage.desk.preferences().holdPictures, 4);
        QVERIFY(stage.window.findChild<TrendsPane*>()->span() == TrendSpan::TenMinutes);
        QCOMPARE(stage.pictures.display().settings().noiseReduction, 40);
        QCOMPARE(stage.pictures.display().settings().edgeMethod, EdgeMethod::MultiScale);
        QVERIFY(theme::brightness() == Brightness::Dim);
        QCOMPARE(stage.cockpit.models.xray.requestedRate(), 30.0);
        stage.cockpit.models.alarms.pauseAudio(stage.cockpit.now);
        QVERIFY(stage.cockpit.models.alarms.audioPauseLeft(stage.cockpit.now + std::chrono::seconds(119)));
        QCOMPARE(stage.kept(), stage.desk.preferences());
        QCOMPARE(stage.kept().audioPause, std::chrono::seconds(120));
    }

    /// Wherever the list stands, each line of it is there in its whole height or not at all.
    void noLineIsCutByTheEdgeOfTheList()
    {
        Prepared stage;
        QVERIFY(stage.open());
        auto* list = stage.view->findChild<RowArea*>();
        QVERIFY(list != nullptr);
        QTRY_VERIFY(list->verticalScrollBar()->maximum() > 100);
        const auto seen = [list](const QLabel* label, const QPoint& at) {
            return list->viewport()->childAt(label->mapTo(list->viewport(), at)) == label;
        };
        int whole = 0;
        for (int place = 0; place <= list->verticalScrollBar()->maximum(); place += 5) {
            list->verticalScrollBar()->setValue(place);
            for (const QLabel* label : list->widget()->findChildren<QLabel*>()) {
                const bool top = seen(label, {1, 1});
                QCOMPARE(seen(label, {1, label->height() - 2}), top);
                whole += top ? 1 : 0;
            }
        }
        QVERIFY(whole > 100);
    }

    void theRowInFocusIsWhole()
    {
        Prepared stage;
        QVERIFY(stage.open());
        auto* list = stage.view->findChild<RowArea*>();
        int looked = 0;
        for (int i = 0; i < 120; ++i) {
            QTest::keyClick(QApplication::focusWidget(), Qt::Key_Tab);
            QWidget* focus = QApplication::focusWidget();
            if (!list->widget()->isAncestorOf(focus))
                continue;
            ++looked;
            const QPoint at = focus->mapTo(list->viewport(), focus->rect().center());
            QVERIFY2(list->viewport()->childAt(at) == focus, qPrintable(focus->accessibleName()));
        }
        QVERIFY(looked > 20);
    }

    void aClickIsMarkedOnlyWhenItCounts()
    {
        Prepared stage;
        QVERIFY(stage.open());
        QVERIFY(stage.button(QStringLiteral("Audio pause: 60 s"))->isChecked());
        QTest::mouseClick(stage.button(QStringLiteral("Audio pause: 90 s")), Qt::LeftButton);
        QVERIFY(stage.button(QStringLiteral("Audio pause: 90 s"))->isChecked());
        QVERIFY(!stage.button(QStringLiteral("Audio pause: 60 s"))->isChecked());
    }

    void defaultsComeBack()
    {
        Prepared stage;
        QVERIFY(stage.open());
        stage.choose(QStringLiteral("Language: English"));
        stage.choose(QStringLiteral("Window: AUTO"));
        auto* line = stage.line(QStringLiteral("Patient side"));
        line->setFocus();
        QTest::keyClicks(line, QStringLiteral("tel. 4711"));
        QTest::keyClick(line, Qt::Key_Return);
        QVERIFY(stage.desk.preferences() != Preferences());
        QTest::mouseClick(stage.button(QStringLiteral("Restore the defaults of all entries")), Qt::LeftButton);
        Preferences expected;
        expected.patientSide = QStringLiteral("tel. 4711"); // it belongs to the site
        QCOMPARE(stage.desk.preferences(), expected);
        QCOMPARE(stage.kept(), expected);
    }

    void whatTheControlsChangedStaysWhenAnotherEntryChanges()
    {
        Prepared stage;
        QVERIFY(stage.open());
        stage.pictures.display().stepEdge(3);
        stage.choose(QStringLiteral("Noise reduction: 20 %"));
        QCOMPARE(stage.pictures.display().settings().edge, 30);
        QCOMPARE(stage.pictures.display().settings().noiseReduction, 20);
    }

    void armedItIsReadOnlyAndSaysWhy()
    {
        Prepared stage;
        QVERIFY(stage.ready());
        stage.cockpit.openAll();
        stage.cockpit.arm();
        QVERIFY(stage.cockpit.models.permit.phase() == PermitPhase::Armed);
        stage.window.showView(View::Preferences);
        QVERIFY(stage.says(QStringLiteral("Read only")));
        for (ChoiceRow* row : stage.view->findChildren<ChoiceRow*>())
            for (SheetButton* button : row->buttons())
                QVERIFY2(!button->isEnabled(), qPrintable(button->accessibleName()));
        QVERIFY(!stage.button(QStringLiteral("Restore the defaults of all entries"))->isEnabled());
        for (QLineEdit* line : stage.view->findChildren<QLineEdit*>())
            QVERIFY(line->isReadOnly());
        Preferences wanted;
        wanted.noiseReduction = 100;
        Q_EMIT stage.view->changed(wanted); // even if the view did not hold it back
        QCOMPARE(stage.desk.preferences(), Preferences());
        QCOMPARE(stage.pictures.display().settings().noiseReduction, 0);
    }

    void theHandHasNoKeysWhileItIsLookedAt()
    {
        Prepared stage;
        QVERIFY(stage.open());
        QVERIFY(!stage.window.handHasKeys());
        auto* edit = stage.line(QStringLiteral("Folder of pictures"));
        edit->setFocus();
        QSignalSpy pressed(&stage.window, &CockpitWindow::handKeyPressed);
        QSignalSpy stop(&stage.window, &CockpitWindow::emergencyStopRequested);
        QTest::keyClicks(edit, QStringLiteral("/tmp/rd"));
        QTest::keyClick(edit, Qt::Key_Return);
        QTest::keyClick(edit, Qt::Key_Escape);
        QCOMPARE(pressed.count(), 0);
        QCOMPARE(stop.count(), 1);
        QCOMPARE(stage.desk.preferences().pictureFolder, QStringLiteral("/tmp/rd"));
    }

    void thePromptKnowsHowToCallThePatientSide()
    {
        Prepared stage;
        QVERIFY(stage.open());
        auto* line = stage.line(QStringLiteral("Patient side"));
        QVERIFY(line != nullptr);
        line->setFocus();
        QTest::keyClicks(line, QStringLiteral("lab 2, tel. 4711"));
        QTest::keyClick(line, Qt::Key_Return);
        QCOMPARE(stage.cockpit.models.patientSide, QStringLiteral("lab 2, tel. 4711"));
        QCOMPARE(stage.kept().patientSide, QStringLiteral("lab 2, tel. 4711"));
    }

    void theCommandLineWinsForThisRun()
    {
        Prepared stage({1920, 1080}, QStringLiteral("/media/given"));
        QVERIFY(stage.open());
        QVERIFY(stage.says(QStringLiteral("/media/given")));
        QVERIFY(stage.kept().pictureFolder.isEmpty());
    }

    void aBrokenFileIsSaidInTheViewAndInTheLog()
    {
        QTemporaryDir folder;
        Options options;
        options.preferences = folder.filePath(QStringLiteral("p.ini"));
        QFile file(options.preferences);
        QVERIFY(file.open(QIODevice::WriteOnly));
        file.write("[General]\nbrightness=blinding\n");
        file.close();
        CockpitStage stage;
        PictureDesk pictures(options, stage.cockpit.models);
        PreferenceDesk desk(options, stage.cockpit.models, pictures);
        pictures.build(stage.window);
        desk.build(stage.window);
        QVERIFY(stage.ready());
        stage.window.showView(View::Preferences);
        bool said = false;
        for (const QLabel* label : stage.window.findChild<PreferencesView*>()->findChildren<QLabel*>())
            said = said || label->text().contains(QStringLiteral("blinding"));
        QVERIFY(said);
        QVERIFY(stage.cockpit.models.log.lines().back().text.contains(QStringLiteral("blinding")));
    }

    void brightnessNeverTouchesAPicture()
    {
        Prepared stage;
        QVERIFY(stage.ready());
        auto* live = stage.window.findChild<LiveImageView*>();
        auto* band = stage.named<QWidget>(QStringLiteral("Motion"));
        QVERIFY(live != nullptr && band != nullptr);
        live->setClock([at = stage.cockpit.now] { return at; });
        live->showPicture(inventedPicture({}, PictureRole::Live));
        const QImage picture = live->grab().toImage();
        const QRect area = live->pictureRect();
        QVERIFY(area.height() > 200);
        const int grey = qGray(picture.pixel(area.center() + QPoint(0, area.height() / 8)));
        QVERIFY2(std::abs(grey - 93) <= 3, qPrintable(QString::number(grey))); // 58 in one corner, 120 in the other: there it stands
        const QImage around = band->grab().toImage();
        for (const Brightness level : {Brightness::Dim, Brightness::Bright, Brightness::Usual}) {
            theme::setBrightness(*qApp, level);
            QCOMPARE(live->grab().toImage(), picture);
            QVERIFY((band->grab().toImage() == around) == (level == Brightness::Usual));
        }
    }

    void leavesImageAlarmsAndMotion_data()
    {
        QTest::addColumn<QSize>("screen");
        QTest::newRow("reference") << QSize(2560, 1440);
        QTest::newRow("full HD") << QSize(1920, 1080);
        QTest::newRow("small") << QSize(1366, 768);
    }

    void leavesImageAlarmsAndMotion()
    {
        QFETCH(QSize, screen);
        Prepared stage(screen);
        QVERIFY(stage.open());
        for (const Region region : {Region::Status, Region::Alarm, Region::Live, Region::Motion})
            QVERIFY(!stage.seen(stage.view).intersects(stage.window.regionGeometry(region)));
        for (const ChoiceRow* row : stage.view->findChildren<ChoiceRow*>())
            for (const SheetButton* button : row->buttons())
                QVERIFY2(row->rect().contains(button->geometry()), qPrintable(button->accessibleName()));
        for (QWidget* part : stage.view->findChildren<QWidget*>(Qt::FindDirectChildrenOnly))
            if (part->isVisible())
                QVERIFY2(stage.view->rect().contains(part->geometry()), qPrintable(part->accessibleName()));
    }

    void everythingIsReachedByTab()
    {
        Prepared stage;
        QVERIFY(stage.open());
        QSet<QWidget*> reached;
        for (int i = 0; i < 180; ++i) {
            QWidget* focus = QApplication::focusWidget();
            QVERIFY(focus);
            reached.insert(focus);
            QTest::keyClick(focus, Qt::Key_Tab);
        }
        for (SheetButton* button : stage.view->findChildren<SheetButton*>())
            QVERIFY2(reached.contains(button), qPrintable(button->accessibleName()));
        for (QLineEdit* line : stage.view->findChildren<QLineEdit*>())
            QVERIFY2(reached.contains(line), qPrintable(line->accessibleName()));
    }
};

QTEST_MAIN(TestPreferencesView)
#include "test_preferences_view.moc"
