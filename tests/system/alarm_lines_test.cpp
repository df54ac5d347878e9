// Alarms of a line that is slow, that loses, that jitters or lets no packet pass: by a robot that is played over a line as the test makes
// it.
#include "hostile_stage.hpp"
#include "puppet_theatre.hpp"
#include "shown_alarms.hpp"
#include "widgets/theme.hpp"

#include <QApplication>
#include <QTest>
#include <QTimer>

using namespace console;
using console::test::isPresent;
using console::test::present;
using console::test::puppetWishes;
using console::test::Theatre;
using namespace std::chrono_literals;
using C = AlarmCondition;

namespace {

constexpr int patience = Theatre::patience;
constexpr std::uint16_t permitRequest = 0x0100; ///< in the robot's set

/// The console, in session with a robot that beats and says nothing else.
struct Line {
    Theatre theatre{puppetWishes()};
    liena::test::ScriptedPeer robot{role()};

    liena::test::PeerRole role()
    {
        auto played = liena::test::roleOf(theatre.files, "robot", "cockpit");
        played.heartbeat = 20ms;
        return played;
    }

    /// Open, and every figure that a test may look at is known.
    bool opens()
    {
        robot.open();
        const auto known = [this] {
            const auto* own = link();
            return own != nullptr && own->state == LinkState::Open && own->figures.clockOffset && own->figures.packetsPass;
        };
        return QTest::qWaitFor(known, patience);
    }

    const LinkNode* link() const { return theatre.models().sessions.linkTo(theatre.files.idOf("robot").value()); }

    bool told(C condition) const { return isPresent(theatre, condition, AlarmPriority::Low); }

    bool unsteady(const QString& why) const
    {
        const auto* alarm = present(theatre, C::LinkUnsteady);
        return alarm != nullptr && alarm->priority == AlarmPriority::Low && alarm->text.contains(why);
    }

    GuardLine guard(Guard which) const { return theatre.models().permit.checklist().at(std::size_t(which)); }
};

} // namespace

class AlarmLinesTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void initTestCase() { theme::apply(*qobject_cast<QApplication*>(QCoreApplication::instance())); }

    void init()
    {
        m_line = std::make_unique<Line>();
        QVERIFY2(m_line->opens(), qPrintable(m_line->theatre.story()));
    }

    void cleanup()
    {
        if (!QTest::currentTestFailed())
            m_line->robot.close();
        m_line.reset();
    }

    /// 8 and 16: a line on which half a second passes until the robot hears.
    void aLineThatIsSlowOneWayIsTwoAlarmsAndArmsNothing()
    {
        Line& line = *m_line;
        auto& theatre = line.theatre;
        QTRY_VERIFY2_WITH_TIMEOUT(line.guard(Guard::ClockKnown).met, qPrintable(theatre.story()), patience);
        QVERIFY(!line.told(C::CommandRoundTrip) && !line.told(C::ClockUncertain));
        line.robot.habits.delay = 500ms; // this profile: 400 ms there and back, clocks to within 200 ms
        QTRY_VERIFY2_WITH_TIMEOUT(line.told(C::CommandRoundTrip), qPrintable(theatre.story()), patience);
        QTRY_VERIFY2_WITH_TIMEOUT(line.told(C::ClockUncertain), qPrintable(theatre.story()), patience);
        QVERIFY(present(theatre, C::ClockUncertain)->text.contains(QStringLiteral("ages unknown")));
        QCOMPARE(theatre.link("robot"), LinkState::Open);
        const auto clocks = line.guard(Guard::ClockKnown);
        QVERIFY2(!clocks.met && clocks.text.startsWith(QStringLiteral("Clock uncertain by \u00B1")), qPrintable(clocks.text));
        QVERIFY(!line.guard(Guard::CommandsQuick).met);
        theatre.hold(Qt::Key_R);
        QVERIFY(!theatre.reaches(PermitPhase::Arming, Theatre::twiceArmHold));
        theatre.release(Qt::Key_R);
        QVERIFY(line.robot.heard(permitRequest).empty());
        line.robot.habits.delay = 0ms;
        QTRY_VERIFY2_WITH_TIMEOUT(!line.told(C::CommandRoundTrip) && !line.told(C::ClockUncertain), qPrintable(theatre.story()), patience);
        QTRY_VERIFY2_WITH_TIMEOUT(line.guard(Guard::ClockKnown).met, qPrintable(theatre.story()), patience);
    }

    /// 10: a firewall begins to drop UDP, and the session goes on by TCP.
    void packetsThatPassNoMoreAreAnAlarm()
    {
        Line& line = *m_line;
        QVERIFY(!line.told(C::PacketsLost));
        line.robot.habits.datagrams = false;
        QTRY_VERIFY2_WITH_TIMEOUT(line.told(C::PacketsLost), qPrintable(line.theatre.story()), patience);
        QCOMPARE(line.theatre.link("robot"), LinkState::Open);
        line.robot.habits.datagrams = true;
        QTRY_VERIFY2_WITH_TIMEOUT(!line.told(C::PacketsLost), qPrintable(line.theatre.story()), patience);
    }

    /// 9: one heartbeat in five goes by no way.
    void aLineThatLosesIsAnAlarm()
    {
        Line& line = *m_line;
        const auto lossy = [&line] { return line.unsteady(QStringLiteral("% lost")); };
        QVERIFY(!lossy());
        int turns = 0;
        QTimer clock;
        QObject::connect(&clock, &QTimer::timeout, &clock, [&line, &turns] {
            const bool passes = ++turns % 5 != 0;
            line.robot.habits.datagrams = passes;
            line.robot.habits.laneZero = passes;
        });
        clock.start(60); // far below the half second after which a link is suspect
        QTRY_VERIFY2_WITH_TIMEOUT(lossy(), qPrintable(line.theatre.story()), patience);
        QCOMPARE(line.theatre.link("robot"), LinkState::Open);
        clock.stop();
        line.robot.habits.datagrams = true;
        line.robot.habits.laneZero = true;
        QTRY_VERIFY2_WITH_TIMEOUT(!lossy(), qPrintable(line.theatre.story()), patience);
    }

    /// 9: all heartbeats come, and some of them much later than others.
    void aLineThatJittersIsAnAlarm()
    {
        Line& line = *m_line;
        const auto jittery = [&line] { return line.unsteady(QStringLiteral("jitter above 15 ms")); };
        QVERIFY(!jittery());
        line.robot.habits.lateness = 80ms; // this profile: 15 ms on average
        QTRY_VERIFY2_WITH_TIMEOUT(jittery(), qPrintable(line.theatre.story()), patience);
        QCOMPARE(line.theatre.link("robot"), LinkState::Open);
        QVERIFY(line.link()->figures.jitter && 15ms < *line.link()->figures.jitter);
        line.robot.habits.lateness = 0ms;
        QTRY_VERIFY2_WITH_TIMEOUT(!jittery(), qPrintable(line.theatre.story()), patience);
    }

private:
    std::unique_ptr<Line> m_line;
};

QTEST_MAIN(AlarmLinesTest)
#include "alarm_lines_test.moc"
