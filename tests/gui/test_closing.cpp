// The cockpit's window is closed: refused while somebody relies on it, which is said; and the ways back to it from a further screen.
#include "pseudo_language.hpp"
#include "screens_stage.hpp"
#include "shown_texts.hpp"
#include "widgets/closing_note.hpp"
#include "widgets/side_window.hpp"

#include <QApplication>
#include <QSignalSpy>

#include <functional>

using namespace console;
using namespace console::test;
using namespace std::chrono_literals;

namespace {

/// As if the pedal had been let go of, and its beam had ended.
void endBeam(InventedCockpit& cockpit)
{
    auto status = cockpit.models.xray.status().value;
    status.beamOn = false;
    cockpit.models.xray.receive(status, std::chrono::steady_clock::now());
    cockpit.models.xray.setPedal(false);
}

void beginArming(InventedCockpit& cockpit)
{
    PermitEvent pressed;
    pressed.kind = PermitEventKind::ArmPressed;
    cockpit.models.permit.apply(pressed, cockpit.now);
}

void raise(InventedCockpit& cockpit, AlarmPriority priority)
{
    cockpit.models.alarms.update(
        {{AlarmCondition::DriveFault, robotId, priority, true, QStringLiteral("Drive fault"), QStringLiteral("Call service.")}},
        cockpit.now, 0);
}

void acknowledgeAll(InventedCockpit& cockpit)
{
    std::vector<quint64> all;
    for (const Alarm& alarm : cockpit.models.alarms.alarms())
        all.push_back(alarm.id);
    for (const quint64 id : all)
        cockpit.models.alarms.acknowledge(id, 0);
}

struct State {
    const char* name;
    std::function<void(InventedCockpit&)> bring;
    const char* why; ///< what stands in the way; null: nothing
};

const std::vector<State>& states()
{
    static const std::vector<State> all{
        {"ARM is held", [](InventedCockpit& c) { c.openAll(), beginArming(c); }, "the permit is ARMING"},
        {"armed", [](InventedCockpit& c) { c.openAll(), c.arm(); }, "the permit is ARMED"},
        {"engaged", [](InventedCockpit& c) { c.openAll(), c.arm(), c.engage(); }, "the permit is ENGAGED"},
        {"in hold", [](InventedCockpit& c) { c.openAll(), c.arm(), c.engage(), c.freezePicture(); }, "the permit is HOLD"},
        {"contrast is given",
         [](InventedCockpit& c) {
             c.openAll(), endBeam(c);
             c.models.instrument.receiveInjection({4, 1.2, InjectionProgress::Running, {}}, c.now);
         },
         "contrast is being injected"},
        {"contrast was asked for",
         [](InventedCockpit& c) {
             c.openAll(), endBeam(c);
             c.models.injection.note(4, std::chrono::steady_clock::now());
         },
         "contrast is being injected"},
        {"the pedal is down", [](InventedCockpit& c) { c.openAll(), endBeam(c), c.models.xray.setPedal(true); }, "the X-ray pedal is down"},
        {"the beam is on",
         [](InventedCockpit& c) {
             c.openAll(), endBeam(c);
             auto status = c.models.xray.status().value;
             status.beamOn = true;
             c.models.xray.receive(status, std::chrono::steady_clock::now());
         },
         "X-ray is on"},
        {"a stop was asked for",
         [](InventedCockpit& c) { c.openAll(), endBeam(c), c.models.instrument.noteStopAsked(7, std::chrono::steady_clock::now()); },
         "an emergency stop is on its way"},
        {"a high alarm stands", [](InventedCockpit& c) { c.openAll(), endBeam(c), raise(c, AlarmPriority::High); },
         "a high alarm is not acknowledged"},
        {"a link is lost", [](InventedCockpit& c) { c.openAll(), c.loseRobot(), endBeam(c); }, "a high alarm is not acknowledged"},

        {"nothing is open", [](InventedCockpit&) {}, nullptr},
        {"all is open", [](InventedCockpit& c) { c.openAll(), endBeam(c); }, nullptr},
        {"a medium alarm stands", [](InventedCockpit& c) { c.openAll(), endBeam(c), raise(c, AlarmPriority::Medium); }, nullptr},
        {"a link is lost, and seen", [](InventedCockpit& c) { c.openAll(), c.loseRobot(), endBeam(c), acknowledgeAll(c); }, nullptr},
        {"contrast was asked for, and nobody answers",
         [](InventedCockpit& c) {
             c.openAll(), endBeam(c);
             c.models.injection.note(4, std::chrono::steady_clock::now() - 2s);
         },
         nullptr},
        {"a stop was asked for, and its alarm was seen",
         [](InventedCockpit& c) { c.models.instrument.noteStopAsked(7, std::chrono::steady_clock::now() - 2s); }, nullptr},
    };
    return all;
}

void addStates(bool refused)
{
    QTest::addColumn<int>("state");
    for (std::size_t i = 0; i < states().size(); ++i)
        if ((states()[i].why != nullptr) == refused)
            QTest::newRow(states()[i].name) << int(i);
}

ClosingNote* noteOf(const CockpitStage& stage) { return stage.window.findChild<ClosingNote*>(); }

} // namespace

class TestClosing : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void initTestCase()
    {
        theme::apply(*qApp);
        QCOMPARE(QGuiApplication::screens().size(), 3);
    }

    void theCockpitStaysWhileSomebodyReliesOnIt_data() { addStates(true); }

    void theCockpitStaysWhileSomebodyReliesOnIt()
    {
        QFETCH(int, state);
        const State& wanted = states().at(std::size_t(state));
        CockpitStage stage;
        QVERIFY(stage.ready());
        QSignalSpy refused(&stage.window, &CockpitWindow::closingRefused);
        QSignalSpy closed(&stage.window, &CockpitWindow::closed);
        wanted.bring(stage.cockpit);
        const auto phase = stage.cockpit.models.permit.phase();
        const bool keys = stage.window.handHasKeys();
        QVERIFY(!stage.window.close());
        QVERIFY(stage.window.isVisible());
        QCOMPARE(closed.count(), 0);
        QCOMPARE(refused.count(), 1);
        const auto why = refused.first().first().toString();
        QVERIFY2(why.startsWith(QString::fromLatin1(wanted.why)), qPrintable(why));
        QVERIFY(noteOf(stage)->isVisible());
        QVERIFY2(noteOf(stage)->accessibleDescription().contains(why), qPrintable(noteOf(stage)->accessibleDescription()));
        QCOMPARE(stage.cockpit.models.permit.phase(), phase); // it changes nothing else
        QCOMPARE(stage.window.handHasKeys(), keys);
        QVERIFY(!QApplication::activeModalWidget() && !QApplication::activePopupWidget());
    }

    void itClosesWhereNobodyDoes_data() { addStates(false); }

    void itClosesWhereNobodyDoes()
    {
        QFETCH(int, state);
        CockpitStage stage;
        QVERIFY(stage.ready());
        QSignalSpy refused(&stage.window, &CockpitWindow::closingRefused);
        QSignalSpy closed(&stage.window, &CockpitWindow::closed);
        states().at(std::size_t(state)).bring(stage.cockpit);
        QVERIFY(stage.window.close());
        QVERIFY(!stage.window.isVisible());
        QCOMPARE(closed.count(), 1);
        QCOMPARE(refused.count(), 0);
    }

    void whatIsSaidFollowsWhatStandsInTheWayAndGoesWithIt()
    {
        CockpitStage stage;
        QVERIFY(stage.ready());
        stage.cockpit.openAll();
        raise(stage.cockpit, AlarmPriority::High);
        QVERIFY(!stage.window.close());
        const auto* note = noteOf(stage);
        QVERIFY(note->accessibleDescription().contains(QStringLiteral("pedal")));
        endBeam(stage.cockpit);
        stage.refresh();
        QVERIFY(note->isVisible() && note->accessibleDescription().contains(QStringLiteral("high alarm")));
        acknowledgeAll(stage.cockpit);
        stage.refresh();
        QVERIFY(!note->isVisible());
        raise(stage.cockpit, AlarmPriority::Medium);
        stage.refresh();
        QVERIFY(!note->isVisible()); // nobody has asked since
    }

    void whatIsSaidGoesAfterAWhile()
    {
        CockpitStage stage;
        QVERIFY(stage.ready());
        raise(stage.cockpit, AlarmPriority::High);
        QVERIFY(!stage.window.close());
        const auto asked = std::chrono::steady_clock::now();
        stage.window.refresh(asked + ClosingNote::shownFor - 5s);
        QVERIFY(noteOf(stage)->isVisible());
        stage.window.refresh(asked + ClosingNote::shownFor);
        QVERIFY(!noteOf(stage)->isVisible());
        stage.refresh();
        QVERIFY(!noteOf(stage)->isVisible());
    }

    void itCoversNothingThatOneActsBy()
    {
        for (const QSize& screen : {QSize(2560, 1440), QSize(1366, 768)}) {
            CockpitStage stage(screen);
            QVERIFY(stage.ready());
            stage.cockpit.openAll(), stage.cockpit.arm(), stage.cockpit.engage();
            QVERIFY(!stage.window.close());
            for (const auto arrangement : {Arrangement::Usual, Arrangement::ReferenceBeside, Arrangement::SceneBeside}) {
                stage.window.setArrangement(arrangement);
                const QRect place = stage.window.regionGeometry(Region::Note);
                QTRY_COMPARE(noteOf(stage)->geometry(), place);
                QCOMPARE(stage.seen(noteOf(stage)), place); // and nothing covers it
                for (const Region region :
                     {Region::Status, Region::Alarm, Region::Links, Region::Live, Region::Robot, Region::Motion, Region::Sheet})
                    QVERIFY(!place.intersects(stage.window.regionGeometry(region)));
            }
        }
    }

    void whatIsSaidIsWhole_data()
    {
        QTest::addColumn<int>("state");
        QTest::addColumn<QSize>("screen");
        for (std::size_t i = 0; i < states().size(); ++i)
            if (states()[i].why != nullptr)
                for (const QSize& screen : {QSize(2560, 1440), QSize(1920, 1080), QSize(1366, 768)})
                    QTest::addRow("%s at %d", states()[i].name, screen.height()) << int(i) << screen;
    }

    /// In a language that takes more room.
    void whatIsSaidIsWhole()
    {
        QFETCH(int, state);
        QFETCH(QSize, screen);
        PseudoLanguage pseudo;
        QVERIFY(QApplication::installTranslator(&pseudo));
        InventedCockpit cockpit;
        QWidget room;
        ClosingNote note(cockpit.models, &room);
        theme::applyScale(&room, theme::scaleFor(screen));
        room.show();
        states().at(std::size_t(state)).bring(cockpit);
        const auto asked = std::chrono::steady_clock::now();
        for (const auto arrangement : {Arrangement::Usual, Arrangement::ReferenceBeside}) {
            const QSize size = regionRect(Region::Note, screen, arrangement).size();
            room.resize(size);
            note.resize(size);
            note.ask(asked);
            QVERIFY(note.isVisible());
            QStringList wrong;
            QTRY_VERIFY2((wrong = unreadableTexts(note)).isEmpty(), qPrintable(wrong.join(QLatin1Char('\n'))));
            QCOMPARE(note.size(), size);
        }
    }

    void aFurtherScreensKeyBringsTheCockpitBack_data()
    {
        QTest::addColumn<bool>("hidden");
        QTest::newRow("minimised") << false;
        QTest::newRow("hidden") << true;
    }

    void aFurtherScreensKeyBringsTheCockpitBack()
    {
        QFETCH(bool, hidden);
        ScreensStage stage;
        QVERIFY(stage.readyWithKeys());
        Q_EMIT stage.view->secondChosen(QStringLiteral("second"));
        auto* side = stage.desk->second();
        QVERIFY(side != nullptr);
        if (hidden)
            stage.window.hide();
        else
            stage.window.showMinimized();
        side->activateWindow();
        QVERIFY(QTest::qWaitForWindowActive(side));
        QVERIFY(!stage.window.handHasKeys());
        QTest::keyClick(side, Qt::Key_F1);
        QVERIFY(stage.window.isVisible() && !stage.window.isMinimized());
        QTRY_VERIFY(stage.window.isActiveWindow());
        QTRY_VERIFY(stage.window.handHasKeys());
    }
};

QTEST_MAIN(TestClosing)
#include "test_closing.moc"
