// The cockpit under a finger: what is dragged scrolls and is not pressed, and what is touched is.
#include "cockpit_stage.hpp"
#include "gallery_scene.hpp"
#include "touching_hand.hpp"
#include "widgets/links_rail.hpp"
#include "widgets/log_lines.hpp"
#include "widgets/preferences_view.hpp"

#include <QAbstractButton>
#include <QGraphicsView>
#include <QLineEdit>
#include <QScrollArea>
#include <QScrollBar>
#include <QSignalSpy>
#include <QStyleOptionSlider>

using namespace console;
using namespace console::test;

namespace {

/// As large as most screens are at least, where the most scrolls.
constexpr QSize smallScreen(1366, 768);

struct LogStage : CockpitStage {
    LogLines* lines = log->findChild<LogLines*>();
    Hand hand{window};
    QSignalSpy chosen{lines, &LogLines::chosen};

    explicit LogStage(int count)
    {
        for (int line = 0; line < count; ++line)
            cockpit.models.log.append(LogKind::Note, QStringLiteral("line %1").arg(line), 1000 + line);
    }

    bool open()
    {
        if (!ready())
            return false;
        window.showView(View::Log);
        bar().setValue(0);
        return lines->isVisible();
    }

    QScrollBar& bar() const { return *lines->verticalScrollBar(); }
    int lineHeight() const { return lines->sizeHintForRow(0); }
    QPoint placeOf(int line) const { return hand.at(*lines->viewport(), lines->visualRect(lines->model()->index(line, 0)).center()); }
};

/// The rail alone, lower than its cards.
struct RailStage {
    InventedCockpit cockpit;
    LinksRail rail{cockpit.models.sessions};
    Hand hand{rail};
    QSignalSpy opened{&rail, &LinksRail::openRequested};

    RailStage()
    {
        theme::applyScale(&rail, 0.75);
        rail.resize(225, 400);
        rail.show();
        rail.refresh(cockpit.now);
    }

    bool ready() { return QTest::qWaitForWindowActive(&rail) && bar().maximum() > 100; }

    QScrollBar& bar() { return *rail.findChild<QScrollArea*>()->verticalScrollBar(); }

    QAbstractButton* firstOpen()
    {
        for (auto* button : rail.findChild<QScrollArea*>()->findChildren<QAbstractButton*>())
            if (button->accessibleName().startsWith(QStringLiteral("Open the link")))
                return button;
        return nullptr;
    }
};

/// What a finger has to hit of a bar.
QSize handleOf(const QScrollBar& bar)
{
    QStyleOptionSlider option;
    option.initFrom(&bar);
    option.orientation = bar.orientation();
    option.maximum = bar.maximum();
    option.pageStep = bar.pageStep();
    option.sliderPosition = option.sliderValue = bar.value();
    return bar.style()->subControlRect(QStyle::CC_ScrollBar, &option, QStyle::SC_ScrollBarSlider, &bar).size();
}

/// Where there is more to see than there is room.
std::vector<QAbstractScrollArea*> scrolling(QWidget& window)
{
    std::vector<QAbstractScrollArea*> found;
    for (auto* area : window.findChildren<QAbstractScrollArea*>())
        if (area->isVisible() && qobject_cast<QGraphicsView*>(area) == nullptr && area->verticalScrollBar()->maximum() > 0)
            found.push_back(area);
    return found;
}

} // namespace

class TestTouch : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void initTestCase() { theme::apply(*qApp); }

    void aFingerDragsTheLog()
    {
        LogStage stage(300);
        QVERIFY(stage.open());
        const QPoint from = stage.placeOf(12);
        stage.hand.drag(from, -10 * stage.lineHeight());
        const int up = stage.bar().value();
        QVERIFY2(up >= 8 && up <= 10, qPrintable(QString::number(up)));
        QVERIFY(!stage.lines->currentIndex().isValid() || stage.lines->currentIndex().row() != 12); // nothing was chosen on the way
        QVERIFY(stage.lines->selectionModel()->selectedIndexes().size() <= 1);
        stage.hand.drag(stage.placeOf(stage.bar().value() + 1), 5 * stage.lineHeight());
        QVERIFY2(stage.bar().value() < up && stage.bar().value() > 0, qPrintable(QString::number(stage.bar().value())));
        const int after = stage.bar().value();
        QTest::qWait(0);
        QCOMPARE(stage.bar().value(), after); // nothing glides
        QCOMPARE(stage.chosen.count(), 0);
    }

    void aTouchChoosesALineAndTwoItsMoment()
    {
        LogStage stage(300);
        QVERIFY(stage.open());
        stage.hand.touch(stage.placeOf(5));
        QCOMPARE(stage.lines->currentIndex().row(), 5);
        QCOMPARE(stage.chosen.count(), 0);
        stage.hand.touch(stage.placeOf(5));
        QCOMPARE(stage.chosen.count(), 1);
    }

    /// A drag of a few millimetres is the trembling of a hand.
    void aFingerThatTremblesOnlyTouches()
    {
        LogStage stage(300);
        QVERIFY(stage.open());
        const QPoint at = stage.placeOf(5);
        stage.hand.press(at);
        stage.hand.move(at + QPoint(3, 6));
        QVERIFY(!stage.lines->currentIndex().isValid() || stage.lines->currentIndex().row() != 5); // the finger is still there
        stage.hand.release(at + QPoint(3, 6));
        QCOMPARE(stage.lines->currentIndex().row(), 5);
        QCOMPARE(stage.bar().value(), 0);
    }

    void aDragThatBeginsOnAButtonScrollsAndDoesNotPressIt()
    {
        RailStage stage;
        QVERIFY(stage.ready());
        QAbstractButton* open = stage.firstOpen();
        QVERIFY(open != nullptr);
        const QPoint from = stage.hand.middle(*open);
        stage.hand.press(from);
        for (int step = 1; step <= 10; ++step) {
            stage.hand.move(from - QPoint(0, 8 * step));
            QVERIFY(!open->isDown());
        }
        stage.hand.release(from - QPoint(0, 80)); // the button came along: it is under the finger
        QVERIFY(open->rect().contains(open->mapFrom(&stage.rail, from - QPoint(0, 80))));
        QCOMPARE(stage.opened.count(), 0);
        QVERIFY2(stage.bar().value() > 40 && stage.bar().value() <= 80, qPrintable(QString::number(stage.bar().value())));
    }

    void aTouchOnAButtonInAScrollAreaPressesIt()
    {
        RailStage stage;
        QVERIFY(stage.ready());
        QAbstractButton* open = stage.firstOpen();
        QVERIFY(open != nullptr);
        stage.hand.touch(stage.hand.middle(*open));
        QCOMPARE(stage.opened.count(), 1);
        QCOMPARE(stage.bar().value(), 0);
    }

    void theMouseIsAsItWas()
    {
        RailStage stage;
        QVERIFY(stage.ready());
        QAbstractButton* open = stage.firstOpen();
        QTest::mousePress(open, Qt::LeftButton);
        QVERIFY(open->isDown());
        QTest::mouseMove(open, open->rect().center() - QPoint(0, 60));
        QTest::mouseRelease(open, Qt::LeftButton, {}, open->rect().center() - QPoint(0, 60));
        QCOMPARE(stage.opened.count(), 0);
        QCOMPARE(stage.bar().value(), 0);
        QTest::mouseClick(open, Qt::LeftButton);
        QCOMPARE(stage.opened.count(), 1);
    }

    /// The system took the finger for itself.
    void aTouchThatIsCancelledPressesNothing()
    {
        RailStage stage;
        QVERIFY(stage.ready());
        QAbstractButton* open = stage.firstOpen();
        stage.hand.press(stage.hand.middle(*open));
        QTest::mouseRelease(open, Qt::LeftButton); // so Qt says it
        QCOMPARE(stage.opened.count(), 0);
        stage.hand.drag(stage.hand.middle(*open), -80);
        QVERIFY(stage.bar().value() > 40);
        QCOMPARE(stage.opened.count(), 0);
    }

    void aDragMarksNoText()
    {
        CockpitStage stage(smallScreen);
        auto* view = new PreferencesView;
        stage.window.addView(View::Preferences, view);
        QVERIFY(stage.ready());
        stage.window.showView(View::Preferences);
        Hand hand{stage.window};
        auto* line = view->findChild<QLineEdit*>();
        QVERIFY(line != nullptr);
        line->setText(QStringLiteral("a text that could be marked"));
        auto* area = view->findChild<QScrollArea*>();
        area->ensureWidgetVisible(line);
        QVERIFY(area->verticalScrollBar()->maximum() > 0);
        const int before = area->verticalScrollBar()->value();
        const QPoint from = hand.at(*line, {12, line->height() / 2});
        const int way = before > 0 ? 200 : -200;
        hand.press(from);
        for (int step = 1; step <= 10; ++step)
            hand.move(from + QPoint(10 * step, way * step / 10));
        hand.release(from + QPoint(100, way));
        QVERIFY(area->verticalScrollBar()->value() != before);
        QCOMPARE(line->selectedText(), QString());
    }

    void everyAreaIsDraggedAndItsHandleIsHit_data()
    {
        QTest::addColumn<int>("state");
        int row = 0;
        for (const GalleryState& state : galleryStates())
            QTest::newRow(state.name) << row++;
    }

    void everyAreaIsDraggedAndItsHandleIsHit()
    {
        QFETCH(int, state);
        GalleryScene scene(smallScreen);
        QVERIFY(scene.bring(galleryStates().at(std::size_t(state)), 0));
        QTest::qWait(0);
        Hand hand{scene.window()};
        for (QAbstractScrollArea* area : scrolling(scene.window())) {
            QScrollBar& bar = *area->verticalScrollBar();
            bar.setValue(0);
            const QSize handle = handleOf(bar);
            QVERIFY2(std::min(handle.width(), handle.height()) >= theme::leastTouchSide,
                     qPrintable(QStringLiteral("%1: %2x%3").arg(area->accessibleName()).arg(handle.width()).arg(handle.height())));
            const int height = area->viewport()->height();
            hand.drag(hand.at(*area->viewport(), {area->viewport()->width() / 2, height - 3}), -std::max(height / 2, 40));
            QVERIFY2(bar.value() > 0, qPrintable(area->accessibleName()));
            ++m_dragged;
        }
    }

    void someAreasWereDragged() { QVERIFY2(m_dragged >= 4, qPrintable(QString::number(m_dragged))); }

private:
    int m_dragged = 0;
};

QTEST_MAIN(TestTouch)
#include "test_touch.moc"
