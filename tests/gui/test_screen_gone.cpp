// The cockpit's screen has vanished: whatever of it a person clicks, that click gives the hand its keys back.
#include "imaging/live_image_view.hpp"
#include "imaging/reference_image_view.hpp"
#include "imaging/scene_view.hpp"
#include "screens_stage.hpp"
#include "widgets/hold_button.hpp"
#include "widgets/link_card.hpp"
#include "widgets/side_window.hpp"
#include "widgets/stop_button.hpp"

#include <QPushButton>
#include <QSignalSpy>
#include <QWheelEvent>

#include <functional>

using namespace console;
using namespace console::test;

namespace {

struct Stage : ScreensStage {
    Stage() { window.setSceneView(new SceneView); }

    /// As when the cable of the cockpit's screen is pulled out.
    bool loseScreen()
    {
        if (!readyWithKeys())
            return false;
        Q_EMIT qGuiApp->screenRemoved(screenNamed("first"));
        window.activateWindow();
        window.setFocus();
        return QTest::qWaitFor([this] { return window.isActiveWindow() && QApplication::focusWidget() == &window; }) &&
               cockpit.models.screenGone && !window.handHasKeys();
    }
};

struct Place {
    const char* name;
    std::function<QWidget*(const Stage&)> find;
};

template <typename Widget>
QWidget* first(const Stage& stage)
{
    return stage.window.findChild<Widget*>();
}

const std::vector<Place>& places()
{
    static const std::vector<Place> all{
        {"the live picture", first<LiveImageView>},
        {"the reference", first<ReferenceImageView>},
        {"the scene", first<SceneView>},
        {"a button of the pictures", [](const Stage& stage) -> QWidget* { return stage.named<QPushButton>(QStringLiteral("Invert")); }},
        {"a link's button", [](const Stage& stage) -> QWidget* { return stage.window.findChild<LinkCard*>()->findChild<QPushButton*>(); }},
        {"an alarm's button",
         [](const Stage& stage) -> QWidget* {
             return stage.named<QPushButton>(QStringLiteral("Mark this moment in both logs as an incident"));
         }},
        {"the trends' button",
         [](const Stage& stage) -> QWidget* { return stage.named<QPushButton>(QStringLiteral("Span of the trends")); }},
        {"ARM, which is not ready",
         [](const Stage& stage) -> QWidget* { return stage.named<HoldButton>(QStringLiteral("Arm: hold for one and a half seconds")); }},
        {"the emergency stop", first<StopButton>},
    };
    return all;
}

} // namespace

class TestScreenGone : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void initTestCase()
    {
        theme::apply(*qApp);
        QCOMPARE(QGuiApplication::screens().size(), 3);
    }

    void anyClickIntoTheCockpitCounts_data()
    {
        QTest::addColumn<int>("place");
        for (std::size_t i = 0; i < places().size(); ++i)
            QTest::newRow(places()[i].name) << int(i);
    }

    void anyClickIntoTheCockpitCounts()
    {
        QFETCH(int, place);
        Stage stage;
        QVERIFY(stage.loseScreen());
        stage.refresh();
        QWidget* clicked = places().at(std::size_t(place)).find(stage);
        QVERIFY(clicked != nullptr && clicked->isVisible());
        QSignalSpy hand(&stage.window, &CockpitWindow::handFocusChanged);
        QTest::mousePress(clicked, Qt::LeftButton);
        QVERIFY(!stage.cockpit.models.screenGone);
        QCOMPARE(hand.count(), 1);
        QCOMPARE(hand.first().first().toBool(), true);
        QTest::mouseRelease(clicked, Qt::LeftButton);
    }

    /// The keys are the hand's where the cockpit itself has the focus, as ever.
    void aClickIntoAViewCountsAndTheViewKeepsTheKeys()
    {
        Stage stage;
        QVERIFY(stage.loseScreen());
        stage.window.showView(View::Topology);
        QVERIFY(stage.cockpit.models.screenGone);
        QTest::mouseClick(stage.topology->canvas()->viewport(), Qt::LeftButton, {}, QPoint(2, 2));
        QVERIFY(!stage.cockpit.models.screenGone);
        QVERIFY(!stage.window.handHasKeys());
        QTest::mouseClick(stage.window.findChild<LiveImageView*>(), Qt::LeftButton);
        QVERIFY(stage.window.handHasKeys());
    }

    void aClickIntoAnotherWindowDoesNotCount()
    {
        Stage stage;
        QVERIFY(stage.loseScreen());
        SideWindow other(QStringLiteral("Other"));
        auto* button = new QPushButton(&other);
        other.show();
        QTest::mouseClick(button, Qt::LeftButton);
        QTest::mouseClick(&other, Qt::LeftButton);
        QVERIFY(stage.cockpit.models.screenGone);
        QVERIFY(!stage.window.handHasKeys());
    }

    void noOtherKeyAndNoWheelCounts()
    {
        Stage stage;
        QVERIFY(stage.loseScreen());
        QSignalSpy pressed(&stage.window, &CockpitWindow::handKeyPressed);
        for (const Qt::Key key : {Qt::Key_D, Qt::Key_Up, Qt::Key_Space, Qt::Key_Return})
            QTest::keyClick(&stage.window, key);
        auto* live = stage.window.findChild<LiveImageView*>();
        const QPoint spot = live->rect().center();
        QWheelEvent turn(spot, live->mapToGlobal(spot), {}, {0, 120}, Qt::NoButton, Qt::NoModifier, Qt::NoScrollPhase, false);
        QCoreApplication::sendEvent(live, &turn);
        QTest::mouseMove(live, spot);
        QVERIFY(stage.cockpit.models.screenGone);
        QCOMPARE(pressed.count(), 0);
    }
};

QTEST_MAIN(TestScreenGone)
#include "test_screen_gone.moc"
