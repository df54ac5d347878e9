// The live topology: plan, choosing with mouse and keys, progress of Open all, and what is honestly not known.
#include "editor/link_row.hpp"
#include "editor/topology_canvas.hpp"
#include "editor/topology_items.hpp"
#include "editor/topology_layout.hpp"
#include "editor/topology_view.hpp"
#include "invented_cockpit.hpp"
#include "widgets/sheet_button.hpp"
#include "widgets/theme.hpp"

#include <QGraphicsScene>
#include <QLabel>
#include <QSignalSpy>
#include <QTest>

using namespace console;
using namespace console::test;
namespace colour = console::theme::colour;

namespace {

struct Shown {
    InventedCockpit cockpit;
    TopologyView view{cockpit.models.sessions};

    Shown()
    {
        view.resize(1100, 900);
        view.show();
    }

    LinkRow* row(quint32 peer) const
    {
        for (LinkRow* candidate : view.findChildren<LinkRow*>())
            if (candidate->peer() == peer)
                return candidate;
        return nullptr;
    }

    bool says(const QString& words) const
    {
        for (const QLabel* label : view.findChildren<QLabel*>())
            if (label->isVisible() && label->text().contains(words))
                return true;
        return false;
    }
};

int redPixels(QWidget& widget)
{
    const QImage picture = widget.grab().toImage();
    int count = 0;
    for (int y = 0; y < picture.height(); ++y)
        for (int x = 0; x < picture.width(); ++x)
            count += picture.pixelColor(x, y).rgb() == QColor(colour::high).rgb() ? 1 : 0;
    return count;
}

} // namespace

class TestTopologyView : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void initTestCase() { theme::apply(*qApp); }

    void planIsTheSameEveryTime()
    {
        const InventedCockpit a;
        const InventedCockpit b;
        const TopologyPlan first = planTopology(a.models.sessions);
        const TopologyPlan second = planTopology(b.models.sessions);
        QCOMPARE(first.devices.size(), second.devices.size());
        for (std::size_t i = 0; i < first.devices.size(); ++i)
            QCOMPARE(first.devices[i].box, second.devices[i].box);
    }

    void devicesStandInTheirSitesLaneAndApart()
    {
        const InventedCockpit cockpit;
        const TopologyPlan plan = planTopology(cockpit.models.sessions);
        QCOMPARE(plan.lanes.size(), std::size_t(2));
        QCOMPARE(plan.lanes.front().site, QStringLiteral("surgeon"));
        for (const PlacedDevice& place : plan.devices) {
            const QString site = cockpit.models.sessions.device(place.id)->site;
            for (const Lane& lane : plan.lanes)
                QCOMPARE(lane.area.contains(place.box), lane.site == site);
            for (const PlacedDevice& other : plan.devices)
                QVERIFY(other.id == place.id || !other.box.intersects(place.box));
        }
        QCOMPARE(plan.links.size(), std::size_t(5));
    }

    void emptyTopologyIsAnEmptyPlan()
    {
        const SessionModel nothing;
        const TopologyPlan plan = planTopology(nothing);
        QVERIFY(plan.devices.empty() && plan.links.empty());
    }

    void clickOnALinkLeadsToItsButton()
    {
        Shown shown;
        QVERIFY(QTest::qWaitForWindowActive(&shown.view));
        QSignalSpy chosen(shown.view.canvas(), &TopologyCanvas::linkChosen);
        QTest::mouseClick(shown.view.canvas()->viewport(), Qt::LeftButton, {}, shown.view.canvas()->placeOfLink(cockpitId, armId));
        QCOMPARE(chosen.count(), 1);
        QCOMPARE(QApplication::focusWidget(), shown.row(armId)->findChild<SheetButton*>());
    }

    void noLineIsDrawnThroughALabel()
    {
        Shown shown;
        QVERIFY(QTest::qWaitForWindowActive(&shown.view));
        const TopologyCanvas* canvas = shown.view.canvas();
        std::vector<LinkLabel*> labels;
        std::vector<LinkItem*> lines;
        for (QGraphicsItem* item : canvas->scene()->items()) {
            if (auto* label = dynamic_cast<LinkLabel*>(item))
                labels.push_back(label);
            else if (auto* line = dynamic_cast<LinkItem*>(item))
                lines.push_back(line);
        }
        QCOMPARE(labels.size(), std::size_t(5));
        QCOMPARE(lines.size(), labels.size());
        for (LinkItem* line : lines) {
            line->setCurrent(true); // which raises it
            for (const LinkLabel* label : labels)
                QVERIFY(label->zValue() > line->zValue());
            QCOMPARE(dynamic_cast<LinkLabel*>(canvas->itemAt(canvas->mapFromScene(line->labelBox().center()))) != nullptr, true);
        }
    }

    void tabAndEnterLeadToALinksButton()
    {
        Shown shown;
        QVERIFY(QTest::qWaitForWindowActive(&shown.view));
        TopologyCanvas* canvas = shown.view.canvas();
        canvas->setFocus(Qt::TabFocusReason);
        QCOMPARE(canvas->currentDevice().value_or(0), cockpitId);
        for (int i = 0; i < 10 && !canvas->currentLink(); ++i)
            QTest::keyClick(canvas, Qt::Key_Tab);
        QVERIFY(canvas->currentLink());
        QCOMPARE(canvas->currentLink()->second, robotId);
        QTest::keyClick(canvas, Qt::Key_Return);
        QCOMPARE(QApplication::focusWidget(), shown.row(robotId)->findChild<SheetButton*>());
    }

    void tabLeavesTheCanvasAtItsEnd()
    {
        Shown shown;
        QVERIFY(QTest::qWaitForWindowActive(&shown.view));
        shown.view.canvas()->setFocus(Qt::TabFocusReason);
        for (int i = 0; i < 12 && shown.view.canvas()->hasFocus(); ++i)
            QTest::keyClick(shown.view.canvas(), Qt::Key_Tab);
        QVERIFY(!shown.view.canvas()->hasFocus());
    }

    void othersLinksAreNotKnownHere()
    {
        Shown shown;
        QVERIFY(QTest::qWaitForWindowActive(&shown.view));
        QTest::mouseClick(shown.view.canvas()->viewport(), Qt::LeftButton, {}, shown.view.canvas()->placeOfLink(armId, robotId));
        QVERIFY(shown.says(QStringLiteral("not known here")));
        QVERIFY(!shown.row(0));
    }

    void rowsShowProgressAndReason()
    {
        Shown shown;
        QVERIFY(QTest::qWaitForWindowActive(&shown.view));
        SessionModel& sessions = shown.cockpit.models.sessions;
        sessions.setLinkState(robotId, LinkState::Open, shown.cockpit.now);
        sessions.noteOpened(robotId, std::chrono::milliseconds(182));
        sessions.setLinkState(armId, LinkState::Opening, shown.cockpit.now);
        sessions.noteOpenFailed(xrayId, QStringLiteral("the computer answers, its program is not running"));
        shown.view.refresh(shown.cockpit.now);
        QVERIFY(shown.says(QStringLiteral("took 182")));
        QVERIFY(shown.says(QStringLiteral("opening, for")));
        QVERIFY(shown.says(QStringLiteral("not opened: the computer answers, its program is not running")));
    }

    void rowAsksForWhatItsStateAllows_data()
    {
        QTest::addColumn<int>("state");
        QTest::newRow("closed") << int(LinkState::Closed);
        QTest::newRow("open") << int(LinkState::Open);
        QTest::newRow("stand-by") << int(LinkState::StandBy);
    }

    void rowAsksForWhatItsStateAllows()
    {
        QFETCH(int, state);
        Shown shown;
        QVERIFY(QTest::qWaitForWindowActive(&shown.view));
        shown.cockpit.models.sessions.setLinkState(robotId, LinkState(state), shown.cockpit.now);
        shown.view.refresh(shown.cockpit.now);
        QSignalSpy open(&shown.view, &TopologyView::openRequested);
        QSignalSpy close(&shown.view, &TopologyView::closeRequested);
        QSignalSpy reopen(&shown.view, &TopologyView::reopenRequested);
        auto* button = shown.row(robotId)->findChild<SheetButton*>();
        button->setFocus();
        QTest::keyClick(button, Qt::Key_Return);
        QCOMPARE(open.count() + close.count() + reopen.count(), 0);
        QTest::mouseClick(button, Qt::LeftButton);
        QCOMPARE(open.count(), LinkState(state) == LinkState::Closed ? 1 : 0);
        QCOMPARE(close.count(), LinkState(state) == LinkState::Open ? 1 : 0);
        QCOMPARE(reopen.count(), LinkState(state) == LinkState::StandBy ? 1 : 0);
    }

    void aDoubleClickIsOneWish_data() { rowAsksForWhatItsStateAllows_data(); }

    /// The link is in its new state before the second click, and the button offers the opposite.
    void aDoubleClickIsOneWish()
    {
        QFETCH(int, state);
        Shown shown;
        QVERIFY(QTest::qWaitForWindowActive(&shown.view));
        const auto enter = [&shown](LinkState entered) {
            shown.cockpit.models.sessions.setLinkState(robotId, entered, shown.cockpit.now);
            shown.view.refresh(shown.cockpit.now);
        };
        enter(LinkState(state));
        int wishes = 0;
        for (const auto wish : {&TopologyView::openRequested, &TopologyView::closeRequested, &TopologyView::reopenRequested})
            connect(&shown.view, wish, &shown.view, [&wishes] { ++wishes; });
        auto* button = shown.row(robotId)->findChild<SheetButton*>();
        const auto offered = button->text();
        QTest::mouseClick(button, Qt::LeftButton);
        enter(LinkState(state) == LinkState::Open ? LinkState::Closed : LinkState::Open);
        QVERIFY(button->isEnabled() && button->text() != offered);
        QTest::mouseClick(button, Qt::LeftButton);
        QCOMPARE(wishes, 1);
    }

    void lostLinkIsDrawnBroken()
    {
        Shown shown;
        QVERIFY(QTest::qWaitForWindowActive(&shown.view));
        shown.cockpit.openAll();
        shown.view.canvas()->refresh(shown.cockpit.now);
        QCOMPARE(redPixels(*shown.view.canvas()), 0);
        shown.cockpit.loseRobot();
        shown.view.canvas()->refresh(shown.cockpit.now);
        QVERIFY(redPixels(*shown.view.canvas()) > 100);
    }

    /// Not with the next look at the clock: the cards say it at once. A canvas that is not shown has no clock.
    void aLinkIsDrawnAsItIsAsSoonAsItIs()
    {
        InventedCockpit cockpit;
        cockpit.openAll();
        auto& sessions = cockpit.models.sessions;
        TopologyCanvas canvas(sessions, TopologyCanvas::Size::Mini);
        canvas.resize(1000, 800);
        QCOMPARE(redPixels(canvas), 0);
        sessions.setLinkState(robotId, LinkState::Reconnecting, cockpit.now);
        QVERIFY(redPixels(canvas) > 30);
        sessions.setLinkState(robotId, LinkState::Open, cockpit.now);
        QCOMPARE(redPixels(canvas), 0);
        sessions.setLinkIncident(armId, robotId, 7);
        QVERIFY(redPixels(canvas) > 10);
    }

    /// The figures that say whether both ways stand are read after it.
    void aLinkThatJustOpenedIsNotDrawnBroken()
    {
        using namespace std::chrono_literals;
        InventedCockpit cockpit;
        auto& sessions = cockpit.models.sessions;
        TopologyCanvas canvas(sessions, TopologyCanvas::Size::Mini);
        canvas.resize(1000, 800);
        LinkFigures figures;
        sessions.setLinkFigures(robotId, figures, cockpit.now);
        sessions.setLinkState(robotId, LinkState::Open, cockpit.now + 10ms);
        canvas.refresh(cockpit.now + 10ms);
        QCOMPARE(redPixels(canvas), 0);
        figures.toPeerConnected = true;
        sessions.setLinkFigures(robotId, figures, cockpit.now + 100ms); // the other way is broken, and that is known
        canvas.refresh(cockpit.now + 100ms);
        QVERIFY(redPixels(canvas) > 15);
    }

    void newTopologyReplacesTheOld()
    {
        Shown shown;
        QVERIFY(QTest::qWaitForWindowActive(&shown.view));
        SessionModel::Topology small;
        small.name = QStringLiteral("pair");
        DeviceNode self = *shown.cockpit.models.sessions.device(cockpitId);
        DeviceNode robot = *shown.cockpit.models.sessions.device(robotId);
        small.devices = {self, robot};
        small.links = {{cockpitId, robotId}};
        shown.cockpit.models.sessions.setTopology(small);
        QTRY_COMPARE(shown.view.findChildren<LinkRow*>().size(), 1);
        QVERIFY(shown.says(QStringLiteral("pair")));
    }
};

QTEST_MAIN(TestTopologyView)
#include "test_topology_view.moc"
