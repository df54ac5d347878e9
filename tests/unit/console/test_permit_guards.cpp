// The guards: each one by itself, to arm and while armed.
#include "model/permit_guards.hpp"
#include "model/present_readings.hpp"

#include <QTest>

#include <functional>

using namespace console;
using namespace std::chrono_literals;

namespace {

GuardReadings good()
{
    GuardReadings r;
    r.robotLink = LinkState::Open;
    r.identityEqual = true;
    r.heartbeatsOnTime = 50;
    r.clockUncertainty = 1ms;
    r.picture.condition = PictureCondition::Live;
    r.picture.source = PictureSource::Simulated;
    r.picture.mayGuide = true;
    r.picture.age = 80ms;
    r.picture.liveFor = 1s;
    r.picture.atRate = true;
    r.picture.keepsRate = true;
    r.pictureLimit = 250ms;
    r.robotFresh = true;
    r.robotState = RobotState::Ready;
    r.robotHoldConfirmed = true;
    r.robotPermit = 4;
    r.spentPermit = 3;
    r.drivesHealthy = true;
    r.roundTrip = 40ms;
    r.usualRoundTrip = 38ms;
    r.carried = 400ms;
    r.tipTracked = r.tipShown = true;
    r.recorded = true;
    r.auditKept = true;
    r.handAlive = true;
    r.windowActive = true;
    r.alarmsTested = true;
    r.interruptionRead = true;
    return r;
}

using Change = std::function<void(GuardReadings&)>;

struct Case {
    const char* name;
    Change change;
    Guard guard;
    bool kept; ///< still met in the form that is kept while armed
};

const std::vector<Case>& cases()
{
    static const std::vector<Case> all{
        {"link closed", [](auto& r) { r.robotLink = LinkState::Closed; }, Guard::SessionOpen, false},
        {"link interrupted", [](auto& r) { r.robotLink = LinkState::Reconnecting; }, Guard::SessionOpen, false},
        {"link suspect within one heartbeat", [](auto& r) { r.robotLink = LinkState::Suspect, r.inLinkState = 20ms; }, Guard::SessionOpen,
         true},
        {"link suspect for longer", [](auto& r) { r.robotLink = LinkState::Suspect, r.inLinkState = 21ms; }, Guard::SessionOpen, false},
        {"another system", [](auto& r) { r.identityEqual = false; }, Guard::IdentityEqual, false},
        {"other commands", [](auto& r) { r.commandsDiffer = true; }, Guard::IdentityEqual, false},
        {"link suspect within one slower heartbeat",
         [](auto& r) { r.robotLink = LinkState::Suspect, r.inLinkState = 50ms, r.heartbeat = 50ms; }, Guard::SessionOpen, true},
        {"link suspect for longer than one quicker heartbeat",
         [](auto& r) { r.robotLink = LinkState::Suspect, r.inLinkState = 6ms, r.heartbeat = 5ms; }, Guard::SessionOpen, false},
        {"a heartbeat was late", [](auto& r) { r.heartbeatsOnTime = 49; }, Guard::HeartbeatsOnTime, true},
        {"clock not compared", [](auto& r) { r.clockUncertainty.reset(); }, Guard::ClockKnown, true},
        {"clock uncertain", [](auto& r) { r.clockUncertainty = 126ms; }, Guard::ClockKnown, true},
        {"no picture", [](auto& r) { r.picture = {}; }, Guard::PictureLive, false},
        {"picture frozen", [](auto& r) { r.picture.condition = PictureCondition::Frozen; }, Guard::PictureLive, false},
        {"picture held", [](auto& r) { r.picture.condition = PictureCondition::Held; }, Guard::PictureLive, false},
        {"picture's age unknown", [](auto& r) { r.picture.condition = PictureCondition::Unknown; }, Guard::PictureLive, false},
        {"picture recorded", [](auto& r) { r.picture.mayGuide = false; }, Guard::PictureLive, false},
        {"picture too old", [](auto& r) { r.picture.age = 251ms; }, Guard::PictureLive, false},
        {"picture perhaps too old", [](auto& r) { r.picture.age = 240ms, r.picture.uncertainty = 11ms; }, Guard::PictureLive, false},
        {"picture not live for a second", [](auto& r) { r.picture.liveFor = 999ms; }, Guard::PictureLive, true},
        {"robot silent", [](auto& r) { r.robotFresh = false; }, Guard::RobotFresh, false},
        {"robot in hold only", [](auto& r) { r.robotState = RobotState::Hold; }, Guard::RobotHolds, true},
        {"emergency stop", [](auto& r) { r.robotState = RobotState::EmergencyStop; }, Guard::RobotHolds, true},
        {"hold not confirmed", [](auto& r) { r.robotHoldConfirmed = false; }, Guard::RobotHolds, true},
        {"no new permit", [](auto& r) { r.spentPermit = r.robotPermit; }, Guard::RobotHolds, true},
        {"drives", [](auto& r) { r.drivesHealthy = false; }, Guard::DrivesHealthy, false},
        {"arm in fault", [](auto& r) { r.armFault = true; }, Guard::DrivesHealthy, false},
        {"a message waits", [](auto& r) { r.queuedMessages = 1; }, Guard::QueueEmpty, true},
        {"a queue", [](auto& r) { r.queuedMessages = 17; }, Guard::QueueEmpty, false},
        {"tip shown where it was last", [](auto& r) { r.tipTracked = false; }, Guard::TipTrackedOrOff, true},
        {"some force", [](auto& r) { r.force = -0.21; }, Guard::ForceNearZero, true},
        {"commands slow", [](auto& r) { r.roundTrip = 251ms; }, Guard::CommandsQuick, true},
        {"commands slow, other profile", [](auto& r) { r.pictureLimit = 400ms, r.roundTrip = 401ms; }, Guard::CommandsQuick, true},
        {"commands far too slow", [](auto& r) { r.roundTrip = 451ms; }, Guard::CommandsQuick, false},
        {"commands later than the robot takes them", [](auto& r) { r.carried = 37ms; }, Guard::CommandsQuick, false},
        {"how late the robot takes commands is not known", [](auto& r) { r.carried.reset(); }, Guard::CommandsQuick, false},
        {"round trip not known", [](auto& r) { r.roundTrip.reset(); }, Guard::CommandsQuick, false},
        {"patient side has not said clear", [](auto& r) { r.clearance = Clearance::Awaited; }, Guard::ClearToArm, true},
        {"patient side's word not known", [](auto& r) { r.robotFresh = false; }, Guard::ClearToArm, false},
        {"only an observer", [](auto& r) { r.role = OperatorRole::Observer; }, Guard::ClearToArm, true},
        {"alarm log not kept", [](auto& r) { r.recorded = false; }, Guard::Recorded, true},
        {"audit file not kept", [](auto& r) { r.auditKept = false; }, Guard::Recorded, true},
        {"force at the stop", [](auto& r) { r.force = 2.0; }, Guard::ForceNearZero, false},
        {"an incident", [](auto& r) { r.incident = true; }, Guard::NoIncident, false},
        {"a high alarm", [](auto& r) { r.highAlarm = true; }, Guard::NoHighAlarm, false},
        {"hand gone", [](auto& r) { r.handAlive = false; }, Guard::HandAlive, false},
        {"keys through a remote desktop", [](auto& r) { r.remoteInput = QStringLiteral("XRDP"); }, Guard::HandAlive, false},
        {"window without keyboard", [](auto& r) { r.windowActive = false; }, Guard::WindowActive, false},
        {"nobody sees the window", [](auto& r) { r.unseen = QStringLiteral("Screen is locked"); }, Guard::WindowActive, false},
        {"dead-man down", [](auto& r) { r.deadMan = true; }, Guard::DeadManReleased, true},
        {"alarms not tested", [](auto& r) { r.alarmsTested = false; }, Guard::AlarmsTested, true},
        {"an interruption not read about", [](auto& r) { r.interruptionRead = false; }, Guard::InterruptionRead, true},
    };
    return all;
}

} // namespace

class TestPermitGuards : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void areAllMetWhenEverythingIsGood();
    void areUnmetWithoutAnyReading();
    void aTipThatIsNotTrackedIsMissingOnlyWhileItIsShown();
    void theTipIsShownOnlyWhereItIsMeasuredWhileTheRobotCanMove();
    void acceptedForceMeetsItsGuard();
    void lateCommandsAreToldWithBothFigures();
    void fewPicturesEndMotion();
    void saysWhatIsMissingOfThePicture();
    void saysWhenAnotherConsoleHasTheRobot();
    void failOneByOne_data();
    void failOneByOne();
};

void TestPermitGuards::areAllMetWhenEverythingIsGood()
{
    QVERIFY(metGuards(checkGuards(good())).all());
    QVERIFY(checkKept(good()).all());
}

void TestPermitGuards::areUnmetWithoutAnyReading()
{
    const auto met = metGuards(checkGuards({}));
    QVERIFY(!met.test(std::size_t(Guard::SessionOpen)));
    QVERIFY(!met.test(std::size_t(Guard::PictureLive)));
    QVERIFY(!met.test(std::size_t(Guard::RobotHolds)));
    QVERIFY(!met.test(std::size_t(Guard::ForceNearZero)));
    QVERIFY(!met.test(std::size_t(Guard::AlarmsTested)));
    QVERIFY(!met.test(std::size_t(Guard::InterruptionRead)));
    QVERIFY(!checkKept({}).all());
}

void TestPermitGuards::aTipThatIsNotTrackedIsMissingOnlyWhileItIsShown()
{
    auto readings = good();
    const auto said = [&readings] { return checkGuards(readings).at(std::size_t(Guard::TipTrackedOrOff)); };
    QVERIFY(said().met);
    QCOMPARE(said().text, QStringLiteral("Tip is tracked"));
    readings.tipTracked = readings.tipShown = false;
    QVERIFY(said().met);
    QCOMPARE(said().text, QStringLiteral("Tip not tracked, not shown"));
    readings.tipShown = true;
    QVERIFY(!said().met);
}

/// What the scene is given and what the guard is told are one and the same.
void TestPermitGuards::theTipIsShownOnlyWhereItIsMeasuredWhileTheRobotCanMove()
{
    const Instant now = Instant{} + 1h;
    constexpr quint32 robot = 0x8208;
    DeviceNode self;
    self.id = 0x40018208;
    self.self = true;
    DeviceNode hand;
    hand.id = robot;
    SessionModel::Topology topology;
    topology.devices = {self, hand};
    topology.links = {{self.id, robot}};
    ConsoleModels models;
    models.sessions.setTopology(topology);
    models.sessions.setLinkState(robot, LinkState::Open, now);
    const auto line = [&](Duration passed) {
        return checkGuards(guardReadings(models, robot, true, now + passed)).at(std::size_t(Guard::TipTrackedOrOff));
    };
    const auto shown = [&](Duration passed) { return shownTip(models, robot, now + passed).has_value(); };
    QVERIFY(!shown(0ms)); // none was ever told
    models.instrument.receiveTip({true, {1, 2, 3}, {1, 0, 0, 0}, 0.4}, now);
    QVERIFY(shown(0ms));
    QCOMPARE(line(0ms).text, QStringLiteral("Tip is tracked"));
    QVERIFY(!shown(1s)); // overdue
    QCOMPARE(line(1s).text, QStringLiteral("Tip not tracked, not shown"));
    models.sessions.setLinkState(robot, LinkState::StandBy, now + 1s);
    QVERIFY(shown(1s)); // where it was last
    QVERIFY(!line(1s).met);
    models.instrument.receiveTip({false, {1, 2, 3}, {1, 0, 0, 0}, 0.4}, now + 1s);
    QVERIFY(!shown(1s)); // the tracker does not see it
    QVERIFY(line(1s).met);
}

void TestPermitGuards::acceptedForceMeetsItsGuard()
{
    auto readings = good();
    readings.force = 0.4;
    readings.forceAccepted = true;
    const auto line = checkGuards(readings).at(std::size_t(Guard::ForceNearZero));
    QVERIFY(line.met);
    QVERIFY2(line.text.contains(QStringLiteral("0.40")), qPrintable(line.text));
    readings.robotFresh = false;
    QVERIFY(!checkGuards(readings).at(std::size_t(Guard::ForceNearZero)).met);
    readings = good();
    readings.force = readings.limits.forceStop;
    readings.forceAccepted = true;
    QVERIFY(!checkKept(readings).all());
}

void TestPermitGuards::lateCommandsAreToldWithBothFigures()
{
    auto readings = good();
    readings.carried = 39ms;
    readings.roundTrip = 90ms; // a single one: the usual is 38 ms
    QVERIFY(checkGuards(readings).at(std::size_t(Guard::CommandsQuick)).met);
    QVERIFY(brokenGuards(readings).isEmpty());
    readings.usualRoundTrip = 62ms;
    readings.carried = 30ms;
    const auto broken = brokenGuards(readings);
    QCOMPARE(broken.size(), 1);
    QVERIFY2(broken.front().contains(QStringLiteral("62 ms")) && broken.front().contains(QStringLiteral("30 ms")),
             qPrintable(broken.front()));
    QCOMPARE(checkGuards(readings).at(std::size_t(Guard::CommandsQuick)).text, broken.front());
}

/// Live and young, and too few of them.
void TestPermitGuards::fewPicturesEndMotion()
{
    auto readings = good();
    readings.picture.keepsRate = false;
    QVERIFY(!checkKept(readings).test(std::size_t(Guard::PictureLive)));
}

void TestPermitGuards::saysWhatIsMissingOfThePicture()
{
    const auto said = [](const Change& change) {
        auto readings = good();
        change(readings);
        return checkGuards(readings).at(std::size_t(Guard::PictureLive)).text;
    };
    QCOMPARE(said([](auto& r) { r.picture.age.reset(); }), QStringLiteral("Picture's age is unknown"));
    QCOMPARE(said([](auto& r) { r.picture.age = 240ms, r.picture.uncertainty = 11ms; }),
             QStringLiteral("Picture may be 251 ms old, at most 250 ms"));
    QCOMPARE(said([](auto& r) {
                 r.picture.liveFor = 0ms, r.picture.atRate = false;
                 r.picture.shownPerSecond = 10, r.picture.expectedPerSecond = 15;
             }),
             QStringLiteral("Picture slow: 10 of 15 a second"));
    QCOMPARE(said([](auto& r) { r.picture.liveFor = 400ms; }), QStringLiteral("Picture live for 0.4 of 1.0 s"));
}

void TestPermitGuards::saysWhenAnotherConsoleHasTheRobot()
{
    auto readings = good();
    readings.robotState = RobotState::Engaged;
    readings.anotherHasRobot = true;
    const auto said = [&readings] { return checkGuards(readings).at(std::size_t(Guard::RobotHolds)).text; };
    QVERIFY2(said().startsWith(QStringLiteral("Another console")), qPrintable(said()));
    readings.robotFresh = false; // it may have been given back since
    QVERIFY2(said().startsWith(QStringLiteral("Robot's hold is not known")), qPrintable(said()));
    readings.robotFresh = true;
    readings.anotherHasRobot = false;
    QVERIFY2(said().startsWith(QStringLiteral("Robot reports")), qPrintable(said()));
}

void TestPermitGuards::failOneByOne_data()
{
    QTest::addColumn<int>("number");
    for (int number = 0; number < int(cases().size()); ++number)
        QTest::newRow(cases().at(std::size_t(number)).name) << number;
}

void TestPermitGuards::failOneByOne()
{
    QFETCH(int, number);
    const auto& one = cases().at(std::size_t(number));
    auto readings = good();
    one.change(readings);
    const auto checklist = checkGuards(readings);
    const auto& line = checklist.at(std::size_t(one.guard));
    QCOMPARE(line.guard, one.guard);
    QVERIFY(!line.met);
    const auto met = checkGuards(good()).at(std::size_t(one.guard));
    QVERIFY2(!line.text.isEmpty() && line.text != met.text, qPrintable(line.text));
    QCOMPARE(checkKept(readings).all(), one.kept);
}

QTEST_GUILESS_MAIN(TestPermitGuards)
#include "test_permit_guards.moc"
