// A million steps of keys, a pad, links, robot, picture and screen through the real masters, guards, permit and gate: whatever happens,
// motion leaves only while everything that it needs lies behind it. What it needs is kept by the walk itself, not read from the permit.
#include "input/hand_scale.hpp"
#include "input/keyboard_master.hpp"
#include "input/master_rack.hpp"
#include "model/motion_order.hpp"
#include "plugged_master.hpp"
#include "walked_world.hpp"

#include <QTest>

#include <map>
#include <random>

using namespace console;
using namespace console::test;
using namespace std::chrono_literals;

namespace {

constexpr auto turn = 10ms; // of the console's loop
constexpr std::array motionKeys{Qt::Key_Up, Qt::Key_Down, Qt::Key_Left, Qt::Key_Right, Qt::Key_I, Qt::Key_K, Qt::Key_J, Qt::Key_L};

class Walk {
public:
    explicit Walk(std::uint32_t seed) : m_random(seed)
    {
        m_rack.add(m_pad);
        m_pad.plug(true);
        m_rack.begin(seed % 2 == 0 ? MasterKind::GamePad : MasterKind::Keyboard);
        QObject::connect(&m_rack, &MasterRack::lifeChanged, [this] { feedGuards(); });
        QObject::connect(&m_rack, &MasterRack::deadManChanged, [this](bool down) {
            if (!down)
                m_needs.engagedAt.reset();
            else if (m_needs.armedAt)
                m_needs.engagedAt = m_world.now;
            feed(down ? PermitEventKind::DeadManPressed : PermitEventKind::DeadManReleased);
        });
        QObject::connect(&m_rack, &MasterRack::armHeldChanged, [this](bool down) {
            m_needs.heldInFull = !down && m_needs.wasHeld(m_world.now);
            m_needs.armSince = down ? std::optional(m_world.now) : std::nullopt;
            feed(down ? PermitEventKind::ArmPressed : PermitEventKind::ArmReleased);
        });
        m_rack.setListening(true);
    }

    /// Nothing, or what is wrong.
    QString step()
    {
        m_world.now += turn;
        if (m_world.pictureRuns)
            m_world.shown = m_world.now - 60ms;
        disturb();
        if (m_world.link == LinkState::Suspect && m_world.now - m_world.linkSince > GuardReadings().heartbeat && m_needs.armedAt)
            ends("suspect");
        operate();
        if (!m_frozen)
            m_rack.poll(m_world.now);
        if (!m_frozen && answers(2))
            report();
        look();
        return judge();
    }

    int moves = 0;                  ///< orders that moved something
    std::map<QString, int> endings; ///< what ended motion, and how often

private:
    using Kind = PermitEventKind;

    bool answers(unsigned in) { return m_random() % in == 0; }

    void feed(Kind kind)
    {
        PermitEvent event;
        event.kind = kind;
        event.armable = m_permit.armable;
        event.kept = m_permit.kept;
        feed(event);
    }

    void feed(const PermitEvent& event)
    {
        const auto next = console::step(m_permit, event, m_world.now);
        m_permit = next.state;
        if (next.actions.rezero)
            m_rack.rezero(m_world.now);
        if (next.actions.release && next.actions.permit == m_world.permit && !m_world.another) {
            m_world.robot = RobotState::Ready;
            ++m_world.permit;
        }
        if (next.actions.requestArm && next.actions.permit == m_world.permit && m_world.robot == RobotState::Ready && !answers(10)) {
            m_world.robot = RobotState::Armed;
            m_world.another = answers(10); // its request, under the same permit, came first
        }
        publish(m_world.now);
    }

    /// As the loop hands it to the network thread.
    void publish(Instant now)
    {
        const auto hand = m_rack.read(now);
        m_snapshot.stream = m_permit.stream();
        m_snapshot.permit = m_permit.permit;
        m_snapshot.engagement = m_permit.engagement;
        m_snapshot.engagedSince = m_permit.since;
        m_snapshot.motion = askedMotion(hand.motion, 1, hand.alive && hand.deadMan, hand.clutch);
        m_snapshot.guiTick = now;
        m_snapshot.shownCapture = m_world.shown;
        m_snapshot.pictureLimit = pictureLimit;
    }

    void ends(const char* why)
    {
        if (m_permit.stream() == MotionStream::Motion)
            ++endings[QString::fromLatin1(why)];
        m_needs.broken(why, m_world.now);
    }

    void setLink(LinkState state)
    {
        m_world.link = state;
        m_world.linkSince = m_world.now;
        if (!carriesMessages(state))
            ends("link");
        if (m_world.standsBy)
            feed(Kind::SystemStandsBy);
        else if (carriesMessages(state))
            feed(Kind::SessionOpen);
        else
            feed(state == LinkState::Reconnecting ? Kind::SessionInterrupted : Kind::SessionClosed);
    }

    /// Seldom enough that a person gets somewhere between two of them.
    void disturb()
    {
        const auto chance = m_random() % 6000;
        if (m_world.link != LinkState::Open || m_world.standsBy || !m_world.focus || !m_world.pictureRuns) {
            if (answers(30))
                heal();
        } else if (chance < 3) {
            setLink(std::array{LinkState::Closed, LinkState::Reconnecting, LinkState::Suspect}.at(chance));
        } else if (chance == 3) {
            ends("stand-by");
            m_world.standsBy = true;
            setLink(LinkState::StandBy);
        } else if (chance == 4) {
            ends("focus");
            m_world.focus = false;
            feed(Kind::PanicHold);
            m_rack.setListening(false);
        } else if (chance == 5) {
            ends("F12");
            feed(Kind::PanicHold);
        } else if (chance == 6) {
            m_world.pictureRuns = false; // it ends motion when it has grown old
        } else if (chance == 7) {
            ends("stall");
            m_world.now += 150ms;
            feed(Kind::Stalled);
        } else if (chance == 8) {
            ends("force");
            m_world.force = 3;
        } else if (chance == 9) {
            m_world.robot = std::array{RobotState::Hold, RobotState::Fault, RobotState::EmergencyStop}.at(m_random() % 3);
            m_world.another = false;
            ++m_world.permit;
        } else if (chance == 10) {
            // Frozen: the network thread goes on with what it was handed last.
            m_world.now += 101ms + std::chrono::milliseconds(m_random() % 500);
            ends("frozen screen");
            m_frozen = true;
        } else if (chance < 13) {
            disturbMaster(chance == 11);
        }
    }

    bool padInUse() const { return m_rack.inUse().kind() == MasterKind::GamePad; }

    /// A pad that is pulled out comes back as it went, held or not; another master is taken where that is allowed.
    void disturbMaster(bool cable)
    {
        if (!cable) {
            const auto other = padInUse() ? MasterKind::Keyboard : MasterKind::GamePad;
            if (m_rack.choose(other, m_permit.phase, m_world.now))
                ends("another master");
            return;
        }
        const auto held = m_pad.controls;
        if (padInUse())
            ends("master");
        m_pad.plug(false);
        m_pad.plug(true);
        m_pad.controls = held;
    }

    /// The keyboard's keys, or what does the same on the pad.
    void deadMan(bool down)
    {
        if (padInUse())
            m_pad.controls.deadMan = down;
        else
            down ? m_keyboard.press(Qt::Key_D) : m_keyboard.release(Qt::Key_D);
    }

    void move(bool start)
    {
        if (padInUse()) {
            m_pad.controls.axesAtRest = !start;
            m_pad.controls.motion.guidewireVelocity = start ? 7 : 0;
            return;
        }
        const auto key = motionKeys.at(m_random() % motionKeys.size());
        start ? m_keyboard.press(key) : m_keyboard.release(key);
    }

    void feedGuards()
    {
        if (m_frozen)
            return;
        const auto readings = readingsNow();
        PermitEvent event;
        event.kind = Kind::GuardsChecked;
        event.armable = metGuards(checkGuards(readings));
        event.kept = checkKept(readings);
        feed(event);
    }

    void heal()
    {
        m_world.standsBy = false;
        if (!m_world.pictureRuns)
            m_world.pictureSince = m_world.now;
        m_world.pictureRuns = true;
        if (!m_world.focus) {
            m_world.focus = true;
            m_rack.setListening(true);
        }
        if (m_world.link != LinkState::Open)
            setLink(LinkState::Open);
    }

    /// A person who mostly wants to move, and sometimes does anything.
    void operate()
    {
        if (m_frozen)
            return;
        if (m_world.force > 1 && m_world.now - m_needs.brokenAt > 100ms && answers(50)) // longer than between two full looks
            m_world.force = 0;
        if (m_world.robot != RobotState::Ready && m_world.robot != RobotState::Armed && answers(50))
            m_world.robot = RobotState::Ready;
        if (m_world.another && answers(50)) { // it gives the robot back
            m_world.another = false;
            m_world.robot = RobotState::Ready;
            ++m_world.permit;
        }
        if (answers(100)) {
            const std::array keys{Qt::Key_D, Qt::Key_R, Qt::Key_C, Qt::Key_Space, Qt::Key_Return, Qt::Key_Up, Qt::Key_L};
            const auto key = keys.at(m_random() % keys.size());
            answers(2) ? m_keyboard.press(key, answers(2)) : m_keyboard.release(key, answers(4));
            return;
        }
        switch (m_permit.phase) {
        case PermitPhase::Ready:
            m_keyboard.release(Qt::Key_R);
            m_keyboard.press(Qt::Key_R);
            break;
        case PermitPhase::Arming:
            break;
        case PermitPhase::Armed:
            m_keyboard.release(Qt::Key_R);
            if (answers(20))
                deadMan(true);
            break;
        case PermitPhase::Engaged:
            move(answers(3));
            if (answers(200))
                deadMan(false);
            break;
        default:
            if (answers(20)) {
                deadMan(false);
                move(false);
            }
            break;
        }
    }

    void report()
    {
        if (m_world.link != LinkState::Open)
            return;
        m_world.reported = m_world.now;
        PermitEvent event;
        event.kind = Kind::RobotReported;
        event.robot = m_world.robot;
        event.permit = m_world.permit;
        event.holdConfirmed = m_world.robot == RobotState::Ready || m_world.robot == RobotState::Hold;
        event.own = m_world.robot == RobotState::Armed && !m_world.another;
        if (event.own && !m_needs.armedAt && m_needs.wasHeld(m_world.now)) {
            m_needs.armedAt = m_world.now;
            m_needs.permit = event.permit;
        } else if (!event.own && m_needs.armedAt) {
            ends("robot"); // the console knows it from now on; the robot itself refuses since it changed
        }
        feed(event);
    }

    /// The loop: guards, the clock's tick.
    void look()
    {
        if (m_frozen)
            return;
        const auto readings = readingsNow();
        PermitEvent event;
        event.kind = Kind::GuardsChecked;
        event.kept = checkKept(readings);
        event.armable = ++m_turns % 5 == 0 ? metGuards(checkGuards(readings)) : m_permit.armable;
        feed(event);
        feed(Kind::Tick);
    }

    GuardReadings readingsNow() { return readingsOf(m_world, m_rack.read(m_world.now), m_permit.spentPermit); }

    /// The network thread's turn.
    QString judge()
    {
        const auto order = m_gate.compose(m_snapshot, m_world.now);
        const bool wasFrozen = std::exchange(m_frozen, false);
        if (wasFrozen)
            feed(Kind::Stalled);
        if (!order)
            return {};
        if (!order->engaged)
            return order->motion.isZero() ? QString() : QStringLiteral("velocity without engagement");
        if (!m_world.pictureRuns && m_world.now - m_world.shown > pictureLimit)
            return QStringLiteral("motion on an old picture");
        if (wasFrozen)
            return QStringLiteral("motion while the screen stood still");
        if (!m_needs.armedAt || !m_needs.engagedAt)
            return QStringLiteral("motion without the whole way, %1 s after: %2")
                .arg(seconds(m_world.now - m_needs.brokenAt))
                .arg(QLatin1String(m_needs.brokenBy));
        if (order->permit != m_needs.permit)
            return QStringLiteral("motion under permit %1 instead of %2").arg(order->permit).arg(m_needs.permit);
        const auto hand = m_rack.read(m_world.now);
        if (!hand.alive || !hand.deadMan || (hand.clutch && !order->motion.isZero()))
            return QStringLiteral("motion without the hand");
        moves += order->motion.isZero() ? 0 : 1;
        return {};
    }

    std::mt19937 m_random;
    World m_world;
    Needs m_needs;
    KeyboardMaster m_keyboard;
    PluggedMaster m_pad{MasterKind::GamePad};
    MasterRack m_rack{m_keyboard};
    PermitState m_permit;
    MotionSnapshot m_snapshot;
    MotionGate m_gate;
    quint64 m_turns = 0;
    bool m_frozen = false;
};

} // namespace

class TestMotionWalk : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void nothingMovesOutsideEngaged()
    {
        std::map<QString, int> endings;
        int moves = 0;
        for (std::uint32_t seed = 1; seed <= 10; ++seed) {
            Walk walk(seed);
            for (int i = 0; i < 100'000; ++i)
                if (const auto wrong = walk.step(); !wrong.isEmpty())
                    QFAIL(qPrintable(QStringLiteral("seed %1, step %2: %3").arg(seed).arg(i).arg(wrong)));
            moves += walk.moves;
            for (const auto& [why, count] : walk.endings)
                endings[why] += count;
        }
        QCOMPARE(endings[QStringLiteral("another master")], 0);       // never from motion
        QVERIFY2(moves > 10'000, qPrintable(QString::number(moves))); // the walks do get there
        for (const auto* why : {"link", "suspect", "stand-by", "focus", "F12", "stall", "force", "robot", "frozen screen", "master"})
            QVERIFY2(endings[QString::fromLatin1(why)] > 5, why);
    }
};

QTEST_GUILESS_MAIN(TestMotionWalk)
#include "test_motion_walk.moc"
