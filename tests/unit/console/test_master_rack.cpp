// Masters that come and go, and which of them counts.
#include "input/master_rack.hpp"
#include "input/recorded_master.hpp"
#include "model/motion_permit.hpp"
#include "plugged_master.hpp"

#include <QSignalSpy>
#include <QTest>

#include <random>

using namespace console;
using namespace console::test;
using namespace std::chrono_literals;

namespace {

/// A rack with a keyboard and a master that can be plugged in, polled a hundred times a second.
struct Rack {
    KeyboardMaster keyboard;
    PluggedMaster pad{MasterKind::GamePad};
    MasterRack rack{keyboard};
    Instant now = Instant{} + 1h;

    Rack()
    {
        rack.add(pad);
        rack.setListening(true);
    }

    void turn(Duration time = 10ms)
    {
        now += time;
        rack.poll(now);
    }

    MasterReading read() { return rack.read(now); }
    MasterLife life() { return pad.life(now); }

    void takePad()
    {
        pad.plug(true);
        turn();
        QVERIFY(rack.choose(MasterKind::GamePad, PermitPhase::Standby, now));
        turn();
        QVERIFY(read().alive);
    }

    void hold()
    {
        pad.controls.deadMan = true;
        turn();
        pad.controls.motion.guidewireVelocity = 10;
        pad.controls.axesAtRest = false;
        turn();
        QVERIFY(read().deadMan && !read().motion.isZero());
    }
};

/// A pad at random, and beside it what it must have done for its dead-man to count, which is not read from the rack.
struct RandomPad {
    Rack stage;
    std::mt19937 random{3};
    bool plugged = false;
    bool seenLetGo = false;  ///< since it came, was chosen, was heard again, or was late
    bool seenAtRest = false; ///< since then, or since the last engage

    bool one(unsigned in) { return random() % in == 0; }
    bool used() const { return stage.rack.inUse().kind() == MasterKind::GamePad; }
    void anew() { seenLetGo = seenAtRest = false; }

    void hand()
    {
        auto& controls = stage.pad.controls;
        if (one(8))
            controls.deadMan = one(2);
        if (one(40))
            controls.arm = !controls.arm;
        if (one(8)) {
            controls.axesAtRest = one(2);
            controls.motion.guidewireVelocity = controls.axesAtRest ? 0 : 10;
        }
    }

    void world()
    {
        if (one(40)) {
            const bool in = !one(3);
            if (in != plugged)
                anew();
            plugged = in;
            stage.pad.plug(in);
        }
        if (one(50)) {
            stage.rack.setListening(!stage.rack.listening());
            anew();
        }
        const auto kind = one(4) ? MasterKind::Keyboard : MasterKind::GamePad;
        if (one(30) && stage.rack.inUse().kind() != kind && stage.rack.choose(kind, PermitPhase::Hold, stage.now))
            anew();
        if (one(30)) {
            stage.rack.rezero(stage.now);
            seenAtRest = seenAtRest && !used();
        }
    }

    void time()
    {
        const bool late = one(60);
        if (late)
            anew();
        stage.turn(late ? 2 * ConnectedMaster::lateLimit : 10ms);
        if (!plugged || !stage.rack.listening())
            return;
        seenAtRest = seenAtRest || stage.pad.controls.axesAtRest;
        seenLetGo = seenLetGo || stage.pad.controls.letGo();
    }

    bool mayCount() const { return used() && plugged && stage.rack.listening() && seenLetGo; }
};

} // namespace

class TestMasterRack : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void lifeFollowsCableWindowAndHand()
    {
        Rack stage;
        stage.turn();
        QCOMPARE(stage.life(), MasterLife::Gone);
        stage.pad.controls.deadMan = true;
        stage.pad.plug(true);
        stage.pad.controls.deadMan = true;
        stage.turn();
        QCOMPARE(stage.life(), MasterLife::Unreleased);
        stage.pad.controls = {};
        stage.turn();
        QCOMPARE(stage.life(), MasterLife::Alive);
        stage.rack.setListening(false);
        QCOMPARE(stage.life(), MasterLife::Unheard);
        stage.rack.setListening(true);
        QCOMPARE(stage.pad.life(stage.now + ConnectedMaster::lateLimit + 1ms), MasterLife::Silent);
        stage.pad.plug(false);
        QCOMPARE(stage.life(), MasterLife::Gone);
    }

    void aMasterThatIsPulledOutIsLostBeforeItIsLetGo()
    {
        Rack stage;
        stage.takePad();
        stage.hold();
        QStringList told;
        QObject::connect(&stage.rack, &MasterRack::lifeChanged, [&] { told << QLatin1String(stage.read().alive ? "alive" : "lost"); });
        QObject::connect(&stage.rack, &MasterRack::deadManChanged,
                         [&](bool pressed) { told << QLatin1String(pressed ? "pressed" : "let go"); });
        stage.pad.plug(false);
        QCOMPARE(told, QStringList({QStringLiteral("lost"), QStringLiteral("let go")}));
        const auto reading = stage.read();
        QVERIFY(!reading.alive && !reading.deadMan && reading.motion.isZero());
    }

    void aMasterThatComesBackHeldDoesNotCount()
    {
        Rack stage;
        stage.takePad();
        stage.hold();
        const auto held = stage.pad.controls;
        stage.pad.plug(false);
        stage.turn();
        stage.pad.plug(true);
        stage.pad.controls = held;
        for (int i = 0; i < 20; ++i) {
            stage.turn();
            QVERIFY(!stage.read().alive && !stage.read().deadMan && stage.read().motion.isZero());
        }
        stage.pad.controls = {};
        stage.turn();
        QVERIFY(stage.read().alive && !stage.read().deadMan);
    }

    void aLatePollEndsLifeUntilTheHandLetsGo()
    {
        Rack stage;
        stage.takePad();
        stage.hold();
        QSignalSpy life(&stage.rack, &MasterRack::lifeChanged);
        stage.turn(ConnectedMaster::lateLimit);
        QVERIFY(stage.read().alive);
        QCOMPARE(life.size(), 0);
        stage.turn(ConnectedMaster::lateLimit + 1ms);
        QCOMPARE(life.size(), 1);
        QVERIFY(!stage.read().alive && stage.read().motion.isZero());
        stage.turn();
        QVERIFY(!stage.read().alive); // still held
        stage.pad.controls = {};
        stage.turn();
        QVERIFY(stage.read().alive);
    }

    void aMasterThatIsNotPolledAnyMoreIsSilent()
    {
        Rack stage;
        stage.takePad();
        stage.hold();
        stage.now += ConnectedMaster::lateLimit + 1ms;
        QVERIFY(!stage.read().alive && !stage.read().deadMan && stage.read().motion.isZero());
        QCOMPARE(stage.rack.statuses(stage.now).front().life, MasterLife::Silent);
    }

    void withoutTheWindowNoHandCounts()
    {
        Rack stage;
        stage.takePad();
        stage.hold();
        QSignalSpy deadMan(&stage.rack, &MasterRack::deadManChanged);
        stage.rack.setListening(false);
        QVERIFY(!stage.read().alive && !stage.read().deadMan && stage.read().motion.isZero());
        QCOMPARE(deadMan.size(), 1);
        stage.turn();
        QVERIFY(!stage.read().deadMan);
        stage.rack.setListening(true);
        stage.turn();
        QVERIFY(!stage.read().alive && !stage.read().deadMan); // it was held all the time
    }

    void anotherMasterIsNeverChosenWhileArmed_data()
    {
        QTest::addColumn<int>("phase");
        QTest::addColumn<bool>("possible");
        for (const auto phase :
             {PermitPhase::Off, PermitPhase::Standby, PermitPhase::Ready, PermitPhase::Hold, PermitPhase::Incident, PermitPhase::Verifying})
            QTest::newRow(qPrintable(word(phase))) << int(phase) << true;
        for (const auto phase : {PermitPhase::Arming, PermitPhase::Armed, PermitPhase::Engaged})
            QTest::newRow(qPrintable(word(phase))) << int(phase) << false;
    }

    void anotherMasterIsNeverChosenWhileArmed()
    {
        QFETCH(int, phase);
        QFETCH(bool, possible);
        Rack stage;
        stage.pad.plug(true);
        stage.turn();
        QCOMPARE(stage.rack.choose(MasterKind::GamePad, PermitPhase(phase), stage.now), possible);
        QCOMPARE(stage.rack.inUse().kind(), possible ? MasterKind::GamePad : MasterKind::Keyboard);
    }

    void aMasterThatIsNotThereCannotBeChosen()
    {
        Rack stage;
        QVERIFY(!stage.rack.choose(MasterKind::GamePad, PermitPhase::Standby, stage.now));
        QVERIFY(!stage.rack.choose(MasterKind::SpaceMouse, PermitPhase::Standby, stage.now));
        QCOMPARE(stage.rack.inUse().kind(), MasterKind::Keyboard);
    }

    void theChosenOneCountsWhenItWasLetGo()
    {
        Rack stage;
        stage.pad.plug(true);
        stage.turn();
        stage.pad.controls.deadMan = true;
        stage.turn();
        stage.keyboard.press(Qt::Key_D);
        QSignalSpy deadMan(&stage.rack, &MasterRack::deadManChanged);
        QVERIFY(stage.rack.choose(MasterKind::GamePad, PermitPhase::Standby, stage.now));
        QCOMPARE(deadMan.size(), 1); // the keyboard's
        QCOMPARE(deadMan.first().first().toBool(), false);
        stage.turn();
        QVERIFY(!stage.read().alive && !stage.read().deadMan);
        stage.pad.controls = {};
        stage.turn();
        QVERIFY(stage.read().alive);
        stage.pad.controls.deadMan = true;
        stage.turn();
        QVERIFY(stage.read().deadMan);
        QCOMPARE(deadMan.size(), 2);
    }

    void onlyTheMasterInUseHasADeadMan()
    {
        Rack stage;
        stage.takePad();
        QSignalSpy deadMan(&stage.rack, &MasterRack::deadManChanged);
        stage.keyboard.press(Qt::Key_D);
        stage.keyboard.press(Qt::Key_Up);
        QCOMPARE(deadMan.size(), 0);
        QVERIFY(!stage.read().deadMan && stage.read().motion.isZero());
        QVERIFY(stage.rack.choose(MasterKind::Keyboard, PermitPhase::Standby, stage.now));
        stage.pad.controls.deadMan = true;
        stage.turn();
        QCOMPARE(deadMan.size(), 0);
        QVERIFY(!stage.read().deadMan);
    }

    void keyboardsPedalArmResetAndClutchCountBesideAnyMaster()
    {
        Rack stage;
        stage.takePad();
        stage.hold();
        QSignalSpy pedal(&stage.rack, &MasterRack::pedalChanged);
        QSignalSpy arm(&stage.rack, &MasterRack::armHeldChanged);
        QSignalSpy reset(&stage.rack, &MasterRack::resetHeldChanged);
        for (const int key : {Qt::Key_F, Qt::Key_R, Qt::Key_C, Qt::Key_U})
            stage.keyboard.press(key);
        QCOMPARE(pedal.size(), 1);
        QCOMPARE(arm.size(), 1);
        QCOMPARE(reset.size(), 1);
        QVERIFY(stage.read().clutch && stage.read().deadMan);
    }

    void aRecordingMovesOnlyUnderAPersonsDeadMan()
    {
        KeyboardMaster keyboard;
        RecordedMaster recording({{0, {0, 0, 0}, 1}, {1, {0, 0, 10}, 1}, {2, {0, 0, 20}, 0}});
        MasterRack rack(keyboard);
        rack.add(recording);
        rack.begin(MasterKind::Recorded);
        const Instant start = Instant{} + 1h;
        QVERIFY(!rack.read(start).alive); // nobody's keys are heard
        QCOMPARE(rack.statuses(start).front().life, MasterLife::Unheard);
        rack.setListening(true);
        rack.rezero(start);
        QVERIFY(rack.read(start + 100ms).alive && !rack.read(start + 100ms).deadMan);
        QSignalSpy deadMan(&rack, &MasterRack::deadManChanged);
        keyboard.press(Qt::Key_D);
        QCOMPARE(deadMan.size(), 1);
        rack.read(start + 200ms);
        QCOMPARE(rack.read(start + 300ms).motion.guidewireVelocity, 10.0);
        rack.read(start + 2s);
        QVERIFY(rack.read(start + 2s).motion.isZero()); // the recorded hand lets go
    }

    /// Pads that are plugged in and out, held, stuck, late and chosen at random: what counts was seen let go before.
    void nothingCountsThatWasNotLetGo()
    {
        RandomPad pad;
        int counted = 0;
        int moved = 0;
        for (int i = 0; i < 300'000; ++i) {
            pad.world();
            pad.hand();
            pad.time();
            const auto reading = pad.stage.read();
            const auto& controls = pad.stage.pad.controls;
            if (pad.used())
                QCOMPARE(reading.alive, pad.mayCount());
            QVERIFY(!reading.deadMan || (pad.mayCount() && controls.deadMan));
            QVERIFY(reading.motion.isZero() || (pad.mayCount() && pad.seenAtRest && !controls.axesAtRest));
            counted += reading.deadMan ? 1 : 0;
            moved += reading.deadMan && !reading.motion.isZero() ? 1 : 0;
        }
        QVERIFY2(counted > 1000 && moved > 300, qPrintable(QStringLiteral("%1, %2").arg(counted).arg(moved)));
    }

    void showsTheOneInUseFirstAndOnlyThoseThatAreThere()
    {
        Rack stage;
        stage.turn();
        QCOMPARE(stage.rack.statuses(stage.now).size(), std::size_t(1));
        stage.takePad();
        auto shown = stage.rack.statuses(stage.now);
        QCOMPARE(shown.size(), std::size_t(2));
        QVERIFY(shown[0].inUse && shown[0].kind == MasterKind::GamePad && !shown[1].inUse);
        stage.pad.plug(false);
        stage.turn();
        shown = stage.rack.statuses(stage.now);
        QCOMPARE(shown.size(), std::size_t(2)); // what is in use stays in sight when it is lost
        QCOMPARE(shown[0].life, MasterLife::Gone);
        const auto since = shown[0].since;
        stage.turn(1s);
        QCOMPARE(stage.rack.statuses(stage.now)[0].since, since);
        QVERIFY(stage.rack.choose(MasterKind::Keyboard, PermitPhase::Hold, stage.now));
        QCOMPARE(stage.rack.statuses(stage.now).size(), std::size_t(1));
    }

    void showsAMasterThatSaysWhyItIsNotThere()
    {
        Rack stage;
        stage.pad.remark = QStringLiteral("there, and not used: X (Bluetooth)");
        stage.turn();
        const auto shown = stage.rack.statuses(stage.now);
        QCOMPARE(shown.size(), std::size_t(2));
        QVERIFY(shown[0].inUse && shown[0].kind == MasterKind::Keyboard);
        QCOMPARE(shown[1].life, MasterLife::Gone);
        QCOMPARE(shown[1].note, stage.pad.remark);
        QVERIFY(!stage.rack.choose(MasterKind::GamePad, PermitPhase::Standby, stage.now));
        stage.pad.remark.clear();
        QCOMPARE(stage.rack.statuses(stage.now).size(), std::size_t(1));
    }
};

QTEST_GUILESS_MAIN(TestMasterRack)
#include "test_master_rack.moc"
