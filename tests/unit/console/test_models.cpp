// Sessions, devices, the log and the measurements.
#include "model/event_log.hpp"
#include "model/instrument_state.hpp"
#include "model/log_roles.hpp"
#include "model/measurements.hpp"
#include "model/permit_model.hpp"
#include "model/session_model.hpp"

#include <QAbstractItemModelTester>
#include <QJsonObject>
#include <QSignalSpy>
#include <QTest>

using namespace console;
using namespace std::chrono_literals;

namespace {

const Instant start = Instant{} + 1h;

SessionModel::Topology pair()
{
    SessionModel::Topology topology;
    DeviceNode self;
    self.id = 0x40018208;
    self.name = QStringLiteral("cockpit");
    self.self = true;
    DeviceNode robot;
    robot.id = 0x00008208;
    robot.title = QStringLiteral("Robot");
    topology.devices = {self, robot};
    topology.links = {{robot.id, self.id}};
    return topology;
}

} // namespace

class TestModels : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void everyLinkStateHasItsOwnWord()
    {
        QStringList words;
        for (int state = 0; state < 8; ++state)
            words << word(static_cast<LinkState>(state));
        QCOMPARE(words.join(QLatin1Char(' ')), QStringLiteral("closed opening open suspect interrupted stand-by re-opening closing"));
    }

    void valueThatWasNeverReceivedIsNotFresh()
    {
        Aged<int> value;
        QCOMPARE(value.freshness(start, 1s), Freshness::Unknown);
        value.receive(3, start);
        QCOMPARE(value.freshness(start + 1s, 1s), Freshness::Fresh);
        QCOMPARE(value.freshness(start + 1s + 1ns, 1s), Freshness::Stale);
    }

    void linkTellsOfEachChangeOnce()
    {
        SessionModel sessions;
        sessions.setTopology(pair());
        QSignalSpy changes(&sessions, &SessionModel::linkStateChanged);
        sessions.setLinkState(0x00008208, LinkState::Opening, start);
        sessions.setLinkState(0x00008208, LinkState::Open, start);
        sessions.setLinkState(0x00008208, LinkState::Open, start);
        sessions.setLinkState(0x12345678, LinkState::Open, start);
        QCOMPARE(changes.size(), 2);
        QVERIFY(sessions.allOpen());
        QCOMPARE(sessions.titleOf(0x40018208), QStringLiteral("cockpit"));
        QCOMPARE(sessions.titleOf(0x12345678), QStringLiteral("0x12345678"));
        QCOMPARE(sessions.firstPeer(DeviceKind::Hand), std::optional<quint32>(0x00008208));
        QVERIFY(!sessions.firstPeer(DeviceKind::Eye));
    }

    void historyIsOneMinute()
    {
        SessionModel sessions;
        sessions.setTopology(pair());
        for (auto at = 0ms; at <= 90s; at += 50ms)
            sessions.setLinkFigures(0x00008208, {}, start + at);
        const auto& history = sessions.linkTo(0x00008208)->history;
        QCOMPARE(history.size(), std::size_t(601));
        QVERIFY(history.front().at >= start + 30s);
        QVERIFY(!history.front().roundTripMs);
    }

    void anOpenLinkIsAsOldAsItsReading()
    {
        SessionModel sessions;
        sessions.setTopology(pair());
        const auto* link = sessions.linkTo(0x00008208);
        QVERIFY(!link->heardAgo(start));
        sessions.setLinkState(0x00008208, LinkState::Open, start);
        const auto read = [&sessions](Duration silence, Duration at) {
            LinkFigures figures;
            figures.lastHeard = start + at - silence;
            sessions.setLinkFigures(0x00008208, figures, start + at);
        };
        read(15ms, 1s);
        QCOMPARE(*link->heardAgo(start + 1s), Duration(15ms));
        QCOMPARE(*link->heardAgo(start + 1s + 250ms), Duration(15ms));
        read(115ms, 1s + 100ms); // of the same datagram: the peer is silent, whatever the state says
        QCOMPARE(*link->heardAgo(start + 1s + 200ms), Duration(115ms));
    }

    /// Nothing that is not heard looks as if it were.
    void silenceGrowsWithoutReadingsAndInEveryOtherState()
    {
        SessionModel sessions;
        sessions.setTopology(pair());
        const auto* link = sessions.linkTo(0x00008208);
        sessions.setLinkState(0x00008208, LinkState::Open, start);
        LinkFigures figures;
        figures.lastHeard = start;
        sessions.setLinkFigures(0x00008208, figures, start + 10ms);
        QCOMPARE(*link->heardAgo(start + 310ms), Duration(310ms));
        QCOMPARE(*link->heardAgo(start + 5s), Duration(5s));
        for (const auto state : {LinkState::Suspect, LinkState::Reconnecting, LinkState::StandBy, LinkState::Reopening}) {
            sessions.setLinkState(0x00008208, state, start + 10ms);
            QCOMPARE(*link->heardAgo(start + 90ms), Duration(90ms));
        }
    }

    void usualRoundTripLeavesOneOutlierOut()
    {
        SessionModel sessions;
        sessions.setTopology(pair());
        const auto* link = sessions.linkTo(0x00008208);
        QVERIFY(!link->usualRoundTrip());
        const auto measure = [&sessions](std::optional<Duration> roundTrip) {
            LinkFigures figures;
            figures.roundTrip = roundTrip;
            sessions.setLinkFigures(0x00008208, figures, start);
        };
        measure(8ms);
        measure(90ms);
        QCOMPARE(*link->usualRoundTrip(), Duration(90ms)); // of two the worse
        measure(9ms);
        QCOMPARE(*link->usualRoundTrip(), Duration(9ms));
        measure(91ms);
        measure(92ms);
        QCOMPARE(*link->usualRoundTrip(), Duration(91ms));
        measure(std::nullopt); // another session
        QVERIFY(!link->usualRoundTrip());
    }

    void suspectsOfTheLastMinuteAreCounted()
    {
        SessionModel sessions;
        sessions.setTopology(pair());
        for (const auto at : {0s, 50s, 70s}) {
            sessions.setLinkState(0x00008208, LinkState::Suspect, start + at);
            sessions.setLinkState(0x00008208, LinkState::Reconnecting, start + at);
            sessions.setLinkState(0x00008208, LinkState::Open, start + at);
        }
        QCOMPARE(sessions.linkTo(0x00008208)->suspects.size(), std::size_t(2));
    }

    void drivesAreHealthyOnlyWhenAllAreKnownToBe()
    {
        InstrumentState state;
        QVERIFY(!state.drivesHealthy(start));
        DriveStatus drives;
        drives.enabled.fill(true);
        state.receiveDrives(drives, start);
        QVERIFY(state.drivesHealthy(start + 1s));
        QVERIFY(!state.drivesHealthy(start + 1s + 1ms));
        drives.temperature[2] = 81;
        state.receiveDrives(drives, start + 2s);
        QVERIFY(!state.drivesHealthy(start + 2s));
        drives.temperature[2] = 20;
        drives.enabled.fill(false); // as they are while the robot holds
        state.receiveDrives(drives, start + 2s);
        QVERIFY(state.drivesHealthy(start + 2s));
        RobotStatus status;
        status.state = RobotState::Fault;
        state.receiveRobot(status, start + 2s);
        QVERIFY(!state.drivesHealthy(start + 2s));
    }

    void robotKeepsForceTrailAndPeak()
    {
        InstrumentState state;
        QSignalSpy changes(&state, &InstrumentState::robotStateChanged);
        RobotStatus status;
        for (auto at = 0s; at <= 20s; at += 1s) {
            status.guidewireForce = at == 3s ? -1.5 : 0.1;
            state.receiveRobot(status, start + at);
        }
        QCOMPARE(state.forceHistory().size(), std::size_t(11));
        QCOMPARE(state.peakForce(), 1.5);
        QCOMPARE(changes.size(), 1);
        QVERIFY(state.robotFresh(start + 20s + 100ms));
        QVERIFY(!state.robotFresh(start + 20s + 101ms));
    }

    /// Another one that is in force may be reset, and then the robot would be free.
    void aStopIsUnheardUntilTheRobotNamesIt()
    {
        InstrumentState state;
        const auto report = [&state](quint64 token, Instant at) {
            RobotStatus status;
            status.emergencyStopToken = token;
            state.receiveRobot(status, at);
        };
        report(4, start);
        state.noteStopAsked(5, start);
        report(4, start + 10ms);
        QCOMPARE(state.stopUnheard(), std::optional(start));
        report(0, start + 20ms);
        QCOMPARE(state.stopUnheard(), std::optional(start));
        report(5, start + 30ms);
        QVERIFY(!state.stopUnheard());
    }

    /// A long line: what is still on its way is younger than what was answered.
    void ofTwoStopsTheOneThatIsNotNamedIsUnheard()
    {
        InstrumentState state;
        state.noteStopAsked(5, start);
        state.noteStopAsked(6, start + 150ms);
        QCOMPARE(state.stopUnheard(), std::optional(start));
        RobotStatus status;
        status.emergencyStopToken = 5;
        state.receiveRobot(status, start + 190ms);
        QCOMPARE(state.stopUnheard(), std::optional(start + 150ms));
        status.emergencyStopToken = 6;
        state.receiveRobot(status, start + 340ms);
        QVERIFY(!state.stopUnheard());
    }

    void injectionIsReplacedByItsNewerReport()
    {
        InstrumentState state;
        QVERIFY(!state.injectionHeard());
        state.receiveInjection({4, 0, InjectionProgress::Accepted, {}}, start);
        state.receiveInjection({4, 2.5, InjectionProgress::Done, {}}, start + 3s);
        QCOMPARE(state.injections().size(), std::size_t(1));
        QCOMPARE(state.injections().front().delivered, 2.5);
        QCOMPARE(state.injectionHeard(), std::optional<Instant>(start + 3s));
        // The age is that of the last one, whatever is still told of those before it.
        state.receiveInjection({5, 0, InjectionProgress::Accepted, {}}, start + 9s);
        state.receiveInjection({4, 2.5, InjectionProgress::Done, {}}, start + 20s);
        QCOMPARE(state.injectionHeard(), std::optional<Instant>(start + 9s));
    }

    void aPeakThatIsResetBeginsWithThePresentForce()
    {
        InstrumentState state;
        RobotStatus status;
        status.guidewireForce = -1.2;
        state.receiveRobot(status, start);
        status.guidewireForce = 0.3;
        state.receiveRobot(status, start + 10ms);
        QCOMPARE(state.peakForce(), 1.2);
        state.resetPeakForce();
        QCOMPARE(state.peakForce(), 0.3);
    }

    void logIsAnHonestListModel()
    {
        constexpr int limit = 20;
        EventLog log(limit);
        const QAbstractItemModelTester tester(&log, QAbstractItemModelTester::FailureReportingMode::QtTest);
        for (int line = 0; line < limit + 3; ++line)
            log.append(LogKind::Note, QString::number(line), line);
        QCOMPARE(log.rowCount(), limit);
        QCOMPARE(log.lost(), quint64(3));
        QCOMPARE(log.data(log.index(0), LogTextRole).toString(), QStringLiteral("3"));
        QVERIFY(log.data(log.index(0)).toString().endsWith(QStringLiteral("note  3")));
    }

    void forceIsAcceptedAsItWasShownAndNoLarger()
    {
        InstrumentState robot;
        QVERIFY(!robot.acceptForce(0.5, start)); // nothing is known
        const auto feel = [&robot](double newtons, Instant at = start) {
            RobotStatus status;
            status.guidewireForce = newtons;
            robot.receiveRobot(status, at);
        };
        feel(0.15);
        QVERIFY(!robot.mayAcceptForce(start)); // nothing to accept
        feel(1.0);
        QVERIFY(!robot.mayAcceptForce(start) && !robot.acceptForce(1.0, start)); // a warning stands
        feel(-0.5);
        QVERIFY(robot.mayAcceptForce(start));
        QVERIFY(!robot.acceptForce(-0.5, start + 101ms)); // the report is old
        QVERIFY(!robot.acceptForce(-0.39, start));        // it grew since it was shown
        QVERIFY(!robot.acceptForce(0, start));
        QVERIFY(robot.acceptForce(-0.5, start));
        QVERIFY(robot.forceAccepted(start) && !robot.mayAcceptForce(start));
        feel(0.59);
        QVERIFY(robot.forceAccepted(start));
        feel(0.61);
        QVERIFY(!robot.forceAccepted(start)); // another force
        feel(0.5);
        QVERIFY(robot.forceAccepted(start));
        feel(0.1);
        feel(0.5);
        QVERIFY(!robot.forceAccepted(start)); // it went, and another came
        QVERIFY(robot.acceptForce(0.5, start));
        robot.dropForce();
        QVERIFY(!robot.forceAccepted(start));
    }

    void acceptedForceLastsForHalfAMinuteThroughNoiseAboutItsLimit()
    {
        InstrumentState robot;
        const auto feel = [&robot](double newtons, Instant at) {
            RobotStatus status;
            status.guidewireForce = newtons;
            robot.receiveRobot(status, at);
        };
        feel(0.21, start);
        feel(0.19, start);
        QVERIFY(robot.acceptForce(0.21, start));
        feel(0.19, start);
        feel(0.22, start + 30s);
        QVERIFY(robot.forceAccepted(start + 30s));
        QVERIFY(!robot.forceAccepted(start + 30s + 1ms));
        QVERIFY(robot.mayAcceptForce(start + 30s + 1ms));
    }

    void permitModelTellsOfPhasesAndConditions()
    {
        PermitModel model;
        QSignalSpy phases(&model, &PermitModel::phaseChanged);
        QSignalSpy lists(&model, &PermitModel::checklistChanged);
        QVERIFY(model.unmetCount() > 0);
        PermitEvent open;
        open.kind = PermitEventKind::SessionOpen;
        model.apply(open, start);
        GuardReadings readings;
        readings.robotLink = LinkState::Open;
        model.check(readings, start);
        model.check(readings, start);
        QCOMPARE(phases.size(), 1);
        QCOMPARE(lists.size(), 1);
        QVERIFY(!model.unmetText(1).isEmpty());
    }

    void permitModelNamesTheLinkThatWasInterrupted()
    {
        PermitModel model;
        const auto feed = [&model](PermitEventKind kind) {
            PermitEvent event;
            event.kind = kind;
            event.armable = event.kept = ~GuardSet{};
            event.robot = RobotState::Ready;
            event.holdConfirmed = true;
            model.apply(event, start);
        };
        const auto beginArming = [&] {
            feed(PermitEventKind::SessionOpen);
            feed(PermitEventKind::GuardsChecked);
            feed(PermitEventKind::ArmPressed);
            return model.phase() == PermitPhase::Arming;
        };
        QVERIFY(beginArming());
        model.interrupt(QStringLiteral("Robotic arm"), start);
        QCOMPARE(model.phase(), PermitPhase::Hold);
        QCOMPARE(model.holdReasons(), QStringList{QStringLiteral("Robotic arm link is not open any more")});
        feed(PermitEventKind::RobotReported);
        QVERIFY(beginArming());
        feed(PermitEventKind::SessionInterrupted); // nobody says whose
        QCOMPARE(model.holdReasons(), QStringList{QStringLiteral("a link is not open any more")});
    }

    void percentileIsByNearestRank()
    {
        QVERIFY(!percentile({}, 0.5));
        QCOMPARE(*percentile({7}, 0.99), 7.0);
        std::vector<double> hundred;
        for (int n = 100; n >= 1; --n)
            hundred.push_back(n);
        QCOMPARE(*percentile(hundred, 0.5), 50.0);
        QCOMPARE(*percentile(hundred, 0.99), 99.0);
        QCOMPARE(*percentile(hundred, 0), 1.0);
    }

    void reportSaysWhatDidNotWork()
    {
        Measurements m;
        QVERIFY(m.failures().size() >= 6);
        m.sessions[1] = {QStringLiteral("Robot"), QStringLiteral("open"), true, 40.0, {}};
        m.begin(start);
        m.end(start + 10s);
        for (int frame = 0; frame < 150; ++frame)
            m.notePainted(frame);
        m.armed = m.engaged = true;
        RobotStatus status;
        status.appliedCommands = 100;
        m.noteRobot(status);
        status.appliedCommands = 5100;
        status.guidewirePosition = 12;
        m.noteRobot(status);
        QVERIFY2(m.failures().empty(), qPrintable(m.failures().empty() ? QString() : m.failures().front()));
        QCOMPARE(m.toJson().value(QStringLiteral("ok")).toBool(), true);
        QCOMPARE(m.applied(), quint64(5000));
        QCOMPARE(m.framesPerSecond(), 15.0);
        m.incidents = 1;
        QCOMPARE(m.failures().size(), std::size_t(1));
        QCOMPARE(m.toJson().value(QStringLiteral("ok")).toBool(), false);
    }
};

QTEST_GUILESS_MAIN(TestModels)
#include "test_models.moc"
