// From a line of the log to the picture of its moment, and back: what is shown, marked and said, with the chain behind it.
#include "app/picture_desk.hpp"
#include "imaging/live_image_view.hpp"
#include "imaging/reference_image_view.hpp"
#include "sample_frames.hpp"
#include "widgets/cockpit_window.hpp"
#include "widgets/log_lines.hpp"
#include "widgets/log_review.hpp"
#include "widgets/log_view.hpp"
#include "widgets/sheet_button.hpp"
#include "widgets/theme.hpp"

#include <QKeyEvent>
#include <QLabel>
#include <QRegularExpression>
#include <QSet>
#include <QSignalSpy>
#include <QtTest>

using namespace console;

namespace {

/// Four pictures, and between them lines: `first` after the first picture, `third` after the third. Before all of them: `early`.
struct Stage {
    Stage() : desk(Options(), models), window(models)
    {
        models.picture.setLinkUp(true);
        models.picture.expect(15, std::chrono::steady_clock::now());
        desk.build(window);
        window.setLogView(log);
        desk.joinLog(*log);
        models.alarms.restoreLog({{500, AlarmPriority::High, QStringLiteral("raised: then")}});
        window.resize(1920, 1080);
        window.show();
        live = window.findChild<LiveImageView*>();
        beside = log->findChild<ReferenceImageView*>();
        lines = log->findChild<LogLines*>();
    }

    bool begin()
    {
        models.log.append(LogKind::Note, QStringLiteral("early"), 1000);
        for (quint32 number = 1; number <= 4; ++number) {
            if (!send(number))
                return false;
            if (number == 1 || number == 3) // the wall clock was set back in between
                models.log.append(LogKind::Link, number == 1 ? QStringLiteral("first") : QStringLiteral("third"), 9000 - number);
        }
        if (!QTest::qWaitForWindowActive(&window))
            return false;
        QTest::keyClick(&window, Qt::Key_F4);
        return log->isVisible();
    }

    bool send(quint32 number)
    {
        const auto frame = samples::frame(number, {256, 256}, 12, PixelEncoding::Raw);
        frame->arrival = std::chrono::steady_clock::now();
        desk.pipeline().showFrame(frame);
        const quint64 before = models.picture.paintedCount();
        return QTest::qWaitFor([&] { return models.picture.paintedCount() > before; });
    }

    QModelIndex line(const QString& text) const
    {
        for (int row = 0; row < lines->model()->rowCount(); ++row)
            if (const auto index = lines->model()->index(row, 0); index.data().toString().endsWith(text))
                return index;
        return {};
    }

    QPoint placeOf(const QString& text) const { return lines->visualRect(line(text)).center(); }
    void choose(const QString& text) const { QTest::mouseClick(lines->viewport(), Qt::LeftButton, {}, placeOf(text)); }

    SheetButton* button(const QString& name) const
    {
        for (SheetButton* candidate : log->findChildren<SheetButton*>())
            if (candidate->accessibleName() == name)
                return candidate;
        return nullptr;
    }
    SheetButton* review() const { return button(QStringLiteral("Review the picture of the chosen line's moment")); }

    bool says(const QString& words) const
    {
        for (const QLabel* label : log->findChildren<QLabel*>())
            if (label->isVisible() && label->text().contains(words))
                return true;
        return false;
    }

    quint32 reviewed() const { return beside->isVisible() && beside->picture() ? beside->picture()->about.frame : 0; }
    QString marked() const
    {
        return lines->marked().isValid() ? lines->marked().data().toString().section(QLatin1Char(' '), -1) : QString();
    }

    /// Of the letters' brightest ink, where only the mark can be.
    int inkBefore(const QString& text) const
    {
        const QRect row = lines->visualRect(line(text));
        const QImage image = lines->viewport()->grab(QRect(row.left() + 6, row.top(), row.height() / 3, row.height())).toImage();
        int found = 0;
        for (int y = 0; y < image.height(); ++y)
            for (int x = 0; x < image.width(); ++x)
                found += image.pixelColor(x, y) == theme::colour::bright ? 1 : 0;
        return found;
    }

    ConsoleModels models;
    PictureDesk desk;
    CockpitWindow window;
    LogView* log = new LogView(models.log, models.alarmLog);
    LiveImageView* live = nullptr;
    ReferenceImageView* beside = nullptr;
    LogLines* lines = nullptr;
};

} // namespace

class TestLogReview : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void initTestCase() { theme::apply(*qApp); }

    void aLineLeadsToThePictureOfItsMoment_data()
    {
        QTest::addColumn<QString>("how");
        for (const char* how : {"button", "button by Enter", "Enter", "double click"})
            QTest::newRow(how) << QString::fromLatin1(how);
    }

    void aLineLeadsToThePictureOfItsMoment()
    {
        QFETCH(QString, how);
        Stage stage;
        QVERIFY(stage.begin());
        QCOMPARE(stage.reviewed(), 0U);
        QVERIFY(!stage.lines->marked().isValid());
        stage.choose(QStringLiteral("first"));
        QVERIFY(stage.review()->isVisible() && stage.review()->isEnabled());
        if (how == QLatin1String("button"))
            QTest::mouseClick(stage.review(), Qt::LeftButton);
        else if (how == QLatin1String("button by Enter")) {
            stage.review()->setFocus(Qt::TabFocusReason);
            QTest::keyClick(stage.review(), Qt::Key_Return);
        } else if (how == QLatin1String("Enter"))
            QTest::keyClick(stage.lines, Qt::Key_Return);
        else
            QTest::mouseDClick(stage.lines->viewport(), Qt::LeftButton, {}, stage.placeOf(QStringLiteral("first")));
        QTRY_COMPARE(stage.reviewed(), 1U);
        QCOMPARE(stage.beside->picture()->role, PictureRole::Review);
        QCOMPARE(stage.marked(), QStringLiteral("first"));
        // The live picture is where it was, and is what counts.
        QCOMPARE(stage.live->picture()->about.frame, 4U);
        QCOMPARE(stage.live->picture()->role, PictureRole::Live);
        QCOMPARE(stage.models.picture.newest()->frame, 4U);
        QCOMPARE(stage.models.picture.paintedCount(), quint64(4));
        const QRect log(stage.log->mapTo(&stage.window, QPoint()), stage.log->size());
        QVERIFY(!log.intersects(stage.window.regionGeometry(Region::Live)));
        QVERIFY(!stage.window.handHasKeys());
    }

    void theMarkFollowsTheReviewAndGoesWithIt()
    {
        Stage stage;
        QVERIFY(stage.begin());
        stage.choose(QStringLiteral("first"));
        QCOMPARE(stage.inkBefore(QStringLiteral("first")), 0);
        QTest::keyClick(stage.lines, Qt::Key_Return);
        QTRY_COMPARE(stage.reviewed(), 1U);
        QVERIFY(stage.inkBefore(QStringLiteral("first")) > 4);
        auto* on = stage.button(QStringLiteral("One picture on"));
        QVERIFY(on->isVisible());
        for (const quint32 number : {2U, 3U}) {
            QTest::mouseClick(on, Qt::LeftButton);
            QTRY_COMPARE(stage.reviewed(), number);
            QCOMPARE(stage.marked(), number == 2 ? QStringLiteral("first") : QStringLiteral("third"));
        }
        on->setFocus(Qt::TabFocusReason);
        QTest::keyClick(on, Qt::Key_Return);
        QTRY_COMPARE(stage.reviewed(), 4U);
        QCOMPARE(stage.marked(), QStringLiteral("third"));
        QCOMPARE(stage.inkBefore(QStringLiteral("first")), 0);
        QVERIFY(stage.inkBefore(QStringLiteral("third")) > 4);
        stage.models.log.append(LogKind::Note, QStringLiteral("later"), 9000); // no picture came since: it is at the last one
        QCOMPARE(stage.marked(), QStringLiteral("later"));
        // Given up in the pane: no review, no mark, and the keys stay with the log.
        on->setFocus(Qt::TabFocusReason);
        for (auto* hold : stage.window.findChildren<QAbstractButton*>())
            if (hold->accessibleName() == QStringLiteral("Last image hold"))
                hold->click();
        QVERIFY(!stage.beside->isVisible() && !on->isVisible());
        QVERIFY(!stage.lines->marked().isValid());
        QCOMPARE(stage.inkBefore(QStringLiteral("later")), 0);
        QCOMPARE(QApplication::focusWidget(), static_cast<QWidget*>(stage.lines));
    }

    /// Opened while the pedal is down, it is the newest no more when the next one comes.
    /// Its text takes several lines below, and that room from the list.
    void theMarkedLineIsReadWhereTheLogOpensInAReview()
    {
        Stage stage;
        QVERIFY(stage.begin());
        const QString whole = QStringLiteral("word ").repeated(80) + QStringLiteral("reviewed");
        stage.models.log.append(LogKind::Note, whole, 9000);
        for (int i = 0; i < 200; ++i)
            stage.models.log.append(LogKind::Note, QStringLiteral("later"), 9000);
        stage.lines->setCurrentIndex(QModelIndex());
        QTest::keyClick(&stage.window, Qt::Key_F1);
        QVERIFY(!stage.lines->isVisible());
        stage.lines->mark(stage.line(QStringLiteral("reviewed")));
        QTest::keyClick(&stage.window, Qt::Key_F4);
        QTRY_VERIFY(stage.says(QStringLiteral("reviewed")));
        QCOMPARE(QModelIndex(stage.lines->marked()), stage.lines->currentIndex());
        QTRY_VERIFY(stage.lines->viewport()->rect().contains(stage.lines->visualRect(stage.lines->marked())));
    }

    void theMarkOfTheNewestPictureStaysBeforeTheNext()
    {
        Stage stage;
        QVERIFY(stage.begin());
        stage.choose(QStringLiteral("third"));
        QTest::keyClick(stage.lines, Qt::Key_Return);
        QTRY_COMPARE(stage.reviewed(), 3U);
        QTest::mouseClick(stage.button(QStringLiteral("One picture on")), Qt::LeftButton);
        QTRY_COMPARE(stage.reviewed(), 4U);
        QVERIFY(stage.send(5));
        stage.models.log.append(LogKind::Note, QStringLiteral("later"), 9000);
        QCOMPARE(stage.marked(), QStringLiteral("third"));
        QCOMPARE(stage.reviewed(), 4U);
    }

    void aFilmThatRunsIsStoppedByAnotherLine()
    {
        Stage stage;
        QVERIFY(stage.begin());
        stage.choose(QStringLiteral("first"));
        QTest::keyClick(stage.lines, Qt::Key_Return);
        auto* play = stage.button(QStringLiteral("Play"));
        QTest::mouseClick(play, Qt::LeftButton);
        QCOMPARE(play->text(), QStringLiteral("Stop"));
        stage.choose(QStringLiteral("third"));
        QTest::keyClick(stage.lines, Qt::Key_Return);
        QCOMPARE(play->text(), QStringLiteral("Play"));
        QTRY_COMPARE(stage.reviewed(), 3U);
    }

    void aLineWithoutAPictureSaysWhy()
    {
        Stage stage;
        QVERIFY(stage.begin());
        stage.choose(QStringLiteral("first"));
        stage.review()->setFocus(Qt::TabFocusReason);
        stage.lines->setCurrentIndex(stage.line(QStringLiteral("early")));
        QVERIFY(!stage.review()->isEnabled());
        QCOMPARE(QApplication::focusWidget(), static_cast<QWidget*>(stage.lines)); // and not the hand's, nor the next button's
        QVERIFY(stage.says(QStringLiteral("No picture came at this moment")));
        QVERIFY(!stage.review()->accessibleDescription().isEmpty());
        QTest::keyClick(stage.lines, Qt::Key_Return);
        QCOMPARE(stage.reviewed(), 0U);
        // One that an earlier run wrote.
        stage.log->showLog(LogView::Log::Alarms);
        stage.choose(QStringLiteral("then"));
        QVERIFY(!stage.review()->isEnabled());
        QVERIFY(stage.says(QStringLiteral("No picture of this moment is kept")));
    }

    /// A minute, or as much as fits into the memory.
    void aLineWhosePictureIsGoneSaysHowMuchIsKept()
    {
        Stage stage;
        const auto old = samples::frame(50, {256, 256}, 12, PixelEncoding::Raw);
        old->arrival = std::chrono::steady_clock::now() - std::chrono::milliseconds(5500);
        stage.desk.pipeline().showFrame(old);
        QTRY_COMPARE(stage.models.picture.paintedCount(), quint64(1));
        QVERIFY(stage.begin());
        stage.log->showLog(LogView::Log::Alarms);
        stage.choose(QStringLiteral("then"));
        const QRegularExpression words(QStringLiteral("^No picture of this moment is kept: the last (\\d+) s of pictures are\\.$"));
        const int kept = words.match(stage.review()->accessibleDescription()).captured(1).toInt();
        QVERIFY2(kept >= 5 && kept <= 60, qPrintable(stage.review()->accessibleDescription()));
        LogReview alone;
        alone.showLine(MomentPicture::Gone, std::chrono::milliseconds(37'900));
        const auto* note = alone.findChild<QLabel*>();
        QCOMPARE(note->text(), QStringLiteral("No picture of this moment is kept: the last 37 s of pictures are."));
        alone.showLine(MomentPicture::Gone, Duration::zero());
        QCOMPARE(note->text(), QStringLiteral("No picture of this moment is kept."));
    }

    /// A repeated Enter has one wish, and Enter never goes on to the hand.
    void enterIsNoneOfTheHands()
    {
        Stage stage;
        QVERIFY(stage.begin());
        stage.choose(QStringLiteral("first"));
        QSignalSpy pressed(&stage.window, &CockpitWindow::handKeyPressed);
        QSignalSpy asked(stage.log, &LogView::reviewRequested);
        QTest::keyClick(stage.lines, Qt::Key_Return);
        QKeyEvent again(QEvent::KeyPress, Qt::Key_Return, Qt::NoModifier, QString(), true);
        QApplication::sendEvent(stage.lines, &again);
        QCOMPARE(asked.count(), 1);
        QCOMPARE(pressed.count(), 0);
    }

    void itsButtonsAreReachedByTab()
    {
        Stage stage;
        QVERIFY(stage.begin());
        stage.choose(QStringLiteral("first"));
        QTest::keyClick(stage.lines, Qt::Key_Return);
        QTRY_COMPARE(stage.reviewed(), 1U);
        QSet<QWidget*> reached;
        for (int i = 0; i < 200; ++i) { // the panes have many
            reached.insert(QApplication::focusWidget());
            QTest::keyClick(QApplication::focusWidget(), Qt::Key_Tab);
        }
        QVERIFY(reached.contains(stage.review()));
        for (const char* name : {"One picture back", "Play", "One picture on"})
            QVERIFY2(reached.contains(stage.button(QString::fromLatin1(name))), name);
    }
};

QTEST_MAIN(TestLogReview)
#include "test_log_review.moc"
