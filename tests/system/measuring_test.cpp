// Measuring the line between two devices on loopback: what is found, what is refused, and that nothing else notices.
#include "test_system.hpp"

#include <QTest>

#include <atomic>
#include <cmath>
#include <mutex>

using namespace liena;
using namespace liena::test;
using namespace std::chrono_literals;
using Kind = SessionEvent::Kind;

namespace {

/// A cockpit and a robot in session; the cockpit measures.
struct Pair {
    TestSystem system{{reference::cockpit, reference::robot}, {"cockpit robot"}};
    DeviceId cockpitId = system.idOf("cockpit");
    DeviceId robotId = system.idOf("robot");
    MeasuringBudget robotBudget;
    std::unique_ptr<TestDevice> robot;
    std::unique_ptr<TestDevice> cockpit;
    std::mutex mutex;
    std::vector<Measurement> found;

    void open(const TestDevice::Setup& cockpitSetup = {})
    {
        auto settings = system.settingsOf("robot");
        settings.measuring = robotBudget;
        robot = std::make_unique<TestDevice>(settings);
        cockpit = std::make_unique<TestDevice>(system.settingsOf("cockpit"), cockpitSetup);
        if (!(*cockpit)->openChannel(robotId) || !QTest::qWaitFor([this] { return isOpen(); }, 20000))
            throw std::runtime_error("no session: " + story());
    }
    bool isOpen() { return cockpit->state(robotId) == SessionState::Open && robot->state(cockpitId) == SessionState::Open; }

    Result<void> begin(MeasurementPlan plan)
    {
        return (*cockpit)->measure(robotId, std::move(plan), [this](const Measurement& measurement) {
            const std::lock_guard lock(mutex);
            found.push_back(measurement);
        });
    }
    bool waitFor(std::size_t count)
    {
        return QTest::qWaitFor(
            [&] {
                const std::lock_guard lock(mutex);
                return found.size() >= count;
            },
            30000);
    }
    Measurement measure(MeasurementPlan plan)
    {
        if (!begin(std::move(plan)) || !waitFor(1))
            throw std::runtime_error("no measurement: " + story());
        return found.front();
    }

    /// Nobody noticed: no loss, no interruption, no violation.
    bool untouched() const
    {
        for (const auto* device : {cockpit.get(), robot.get()})
            for (const auto kind : {Kind::Lost, Kind::Interrupted, Kind::StandByBegan, Kind::Closed})
                if (device->heard(kind))
                    return false;
        return true;
    }
    std::string story() const { return (cockpit ? cockpit->story() : "") + "--\n" + (robot ? robot->story() : ""); }
};

MeasurementPhase paced(std::chrono::nanoseconds duration, double perSecond = 200)
{
    return {"paced", duration, {perSecond}, {perSecond / 2}, {}};
}

MeasurementPlan everything()
{
    return {paced(300ms),
            {"back-to-back", 200ms, {0, 1}, {}, {}},
            {"messages", 200ms, {0, 64}, {}, {}},
            {"beside-images", 300ms, {200}, {100}, {20, 0, 300'000}},
            {"images", 200ms, {}, {}, {0, 2, 1'000'000}}};
}

/// How measurements failed, in the order of their ends; empty for those that did not.
class Failures {
public:
    DistributedSystem::MeasurementHandler add()
    {
        return [this](const Measurement& measurement) {
            const std::lock_guard lock(m_mutex);
            m_all.push_back(measurement.failure);
        };
    }
    std::vector<std::string> all() const
    {
        const std::lock_guard lock(m_mutex);
        return m_all;
    }

private:
    mutable std::mutex m_mutex;
    std::vector<std::string> m_all;
};

/// A command that is guarded, twenty a second.
void commandsFrom(DistributedSystem& cockpit, DeviceId robot, std::atomic<int>& sent)
{
    cockpit.every(50ms, [&cockpit, robot, &sent] {
        auto command = cockpit.command(robot, "GripperCommand");
        if (command && cockpit.send(robot, std::move(command.value())))
            ++sent;
    });
}

} // namespace

class MeasuringTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void measuresEveryPhaseAndNobodyNotices()
    {
        Pair pair;
        pair.open();
        const auto found = pair.measure(everything());
        QVERIFY2(found.failure.empty(), found.failure.c_str());
        QVERIFY(!found.inUse && !found.imagesFlowed); // those that measure are none of the application
        QCOMPARE(found.phases.size(), std::size_t{5});
        for (const auto& phase : found.phases)
            for (const auto* figures : {&phase.prompt, &phase.images}) {
                if (!figures->asked.isUsed())
                    continue;
                QVERIFY2(figures->sent > 0, phase.name.c_str());
                QCOMPARE(figures->echoed, figures->sent); // TCP loses nothing
                QCOMPARE(figures->heard, figures->sent);
                QCOMPARE(figures->roundTrip.count(), figures->echoed);
                QVERIFY(!figures->limited);
            }
        QCOMPARE(found.phases[0].prompt.sent, std::uint64_t{60});
        QVERIFY(found.phases[0].packets.echoed > 0); // loopback carries UDP
        QVERIFY2(pair.isOpen() && pair.untouched(), pair.story().c_str());
        QVERIFY((*pair.robot)->cache().drain().messages.empty()); // no application sees it
        QVERIFY2(!pair.robot->heard(Kind::MessagesDropped) && !pair.cockpit->heard(Kind::MessagesDropped), pair.story().c_str());
    }

    void eitherEndMayMeasureAndAtTheSameTime()
    {
        Pair pair;
        pair.open();
        std::atomic<int> done = 0;
        const auto count = [&done](const Measurement& found) { done += found.failure.empty() ? 1 : 100; };
        QVERIFY((*pair.cockpit)->measure(pair.robotId, {paced(300ms)}, count));
        QVERIFY((*pair.robot)->measure(pair.cockpitId, {paced(300ms)}, count));
        QTRY_COMPARE_WITH_TIMEOUT(done.load(), 2, 30000);
        QVERIFY2(pair.untouched(), pair.story().c_str());
    }

    void aDeviceThatLetsNobodyMeasureSaysSo()
    {
        Pair pair;
        pair.robotBudget.allowed = false;
        pair.open();
        const auto found = pair.measure(everything());
        QVERIFY2(found.failure.find("robot refuses to be measured") != std::string::npos, found.failure.c_str());
        QVERIFY(found.phases.empty());
        QVERIFY2(pair.isOpen() && pair.untouched(), pair.story().c_str());
    }

    void whatIsAskedBeyondAGrantIsNotSent()
    {
        Pair pair;
        pair.robotBudget.atRest = {100, 1'000'000, 60s};
        pair.open();
        const auto found = pair.measure({{"both", 1s, {1000}, {}, {20, 0, 250'000}}});
        QVERIFY2(found.failure.empty(), found.failure.c_str());
        const auto& both = found.phases.at(0);
        QVERIFY(both.prompt.limited && both.images.limited);
        QCOMPARE(both.prompt.sent, std::uint64_t{100});
        QCOMPARE(both.images.sent, std::uint64_t{4});
        QCOMPARE(both.prompt.echoed + both.images.echoed, std::uint64_t{104}); // and the robot dropped none
        QVERIFY2(!pair.robot->heard(Kind::MessagesDropped), pair.story().c_str());
    }

    void aTimeThatIsTooLongIsRefused()
    {
        Pair pair;
        pair.robotBudget.atRest.longest = 5s;
        pair.open();
        const auto found = pair.measure({paced(60s)});
        QVERIFY2(found.failure.find("measured for at most 5 s at once") != std::string::npos, found.failure.c_str());
    }

    void aPlanThatMakesNoSenseIsRefused()
    {
        Pair pair;
        pair.open();
        const std::vector<MeasurementPlan> wrong{{},
                                                 {{"long", 2h, {1}, {}, {}}},
                                                 {{"none", 0s, {1}, {}, {}}},
                                                 {{"large", 1s, {1, 0, 1025}, {}, {}}},
                                                 {{"large", 1s, {}, {}, {1, 0, (8U << 20U) + 1}}},
                                                 {{"many", 1s, {}, {}, {0, 1025, 1}}},
                                                 {{"nan", 1s, {std::nan("")}, {}, {}}}};
        for (std::size_t i = 0; i < wrong.size(); ++i) {
            QVERIFY(pair.begin(wrong[i]));
            QVERIFY(pair.waitFor(i + 1));
            QVERIFY2(!pair.found.back().failure.empty(), std::to_string(i).c_str());
        }
        QVERIFY(pair.isOpen());
    }

    void oneAtATime()
    {
        Pair pair;
        pair.open();
        QVERIFY(pair.begin({paced(10s)}));
        QVERIFY(pair.begin({paced(1s)}));
        QVERIFY(pair.waitFor(1));
        QVERIFY2(pair.found.front().failure.find("being measured already") != std::string::npos, pair.found.front().failure.c_str());
        (*pair.cockpit)->stopMeasuring(pair.robotId);
        QVERIFY(pair.waitFor(2));
        QCOMPARE(pair.found.back().failure, std::string("it was stopped"));
        pair.found.clear();
        QVERIFY(pair.measure({paced(100ms)}).failure.empty()); // the robot knows that it is over
    }

    void commandsFlowBesideItWithinTheBudgetForThat()
    {
        Pair pair;
        std::atomic<int> sent = 0;
        pair.open([&](DistributedSystem& cockpit) { commandsFrom(cockpit, pair.robotId, sent); });
        QTRY_VERIFY(sent > 3);
        QTRY_VERIFY(!pair.robot->messages("GripperCommand").empty());
        const auto before = sent.load();
        const auto found = pair.measure({paced(1s, 1000), {"beside-images", 1s, {1000}, {}, {50, 0, 400'000}}});
        const auto during = sent.load() - before;
        QVERIFY2(found.failure.empty(), found.failure.c_str());
        QVERIFY(found.inUse);
        QCOMPARE(found.limits.probesPerSecond, 200U);
        const auto& mixed = found.phases.at(1);
        QVERIFY(mixed.prompt.limited && mixed.images.limited);
        QVERIFY2(mixed.prompt.sent <= 201 && mixed.images.sent <= 11, qPrintable(QString::number(mixed.images.sent)));
        QVERIFY2(during > 5, "commands did not flow");
        const auto all = static_cast<std::size_t>(sent.load());
        QTRY_VERIFY(pair.robot->messages("GripperCommand").size() >= all); // each of them arrived
        QVERIFY2(pair.isOpen() && pair.untouched(), pair.story().c_str());
    }

    void aDeviceInUseHasOneLineMeasuredAtATime()
    {
        TestSystem system({reference::cockpit, reference::robot, reference::arm}, {"cockpit robot", "arm robot"});
        const auto cockpitId = system.idOf("cockpit");
        const auto robotId = system.idOf("robot");
        const auto armId = system.idOf("arm");
        std::atomic<int> sent = 0;
        Failures asked;
        Failures ofTheRobot;
        TestDevice robot(system.settingsOf("robot"));
        TestDevice arm(system.settingsOf("arm"));
        TestDevice cockpit(system.settingsOf("cockpit"), [&](DistributedSystem& own) { commandsFrom(own, robotId, sent); });
        QVERIFY(arm->openChannel(robotId));
        QVERIFY(cockpit->openChannel(robotId));
        QTRY_VERIFY(!robot.messages("GripperCommand").empty());
        QTRY_VERIFY(arm.state(robotId) == SessionState::Open && robot.state(armId) == SessionState::Open);
        QTRY_VERIFY(robot.state(cockpitId) == SessionState::Open);
        const auto isTold = [](const Failures& failures, std::size_t place, const char* words) {
            const auto all = failures.all();
            return place < all.size() && all[place].find(words) != std::string::npos;
        };

        QVERIFY(robot->measure(cockpitId, {paced(60s)}, ofTheRobot.add()));
        QVERIFY(robot->measure(armId, {paced(100ms)}, asked.add())); // one that asks asks no second
        QTRY_VERIFY(isTold(asked, 0, "its line to cockpit is being measured"));
        QVERIFY(arm->measure(robotId, {paced(100ms)}, asked.add())); // and answers none
        QTRY_VERIFY(isTold(asked, 1, "robot refuses to be measured: this device is in use, and its line to cockpit is being measured"));
        QVERIFY(ofTheRobot.all().empty());
        robot->stopMeasuring(cockpitId);
        QTRY_VERIFY(isTold(ofTheRobot, 0, "it was stopped"));

        const auto before = arm->links().front().bytesReceived;
        QVERIFY(arm->measure(robotId, {paced(60s)}, asked.add()));         // one that answers asks for none
        QTRY_VERIFY(arm->links().front().bytesReceived > before + 20'000); // the robot answers
        QVERIFY(robot->measure(cockpitId, {paced(100ms)}, ofTheRobot.add()));
        QTRY_VERIFY(isTold(ofTheRobot, 1, "its line to arm is being measured"));
        arm->stopMeasuring(robotId);
        QTRY_VERIFY(isTold(asked, 2, "it was stopped"));
    }

    void aDeviceThatComesIntoUseEndsIt()
    {
        Pair pair;
        pair.open();
        QVERIFY(pair.begin({paced(20s)}));
        QTRY_VERIFY((*pair.robot)->links().front().bytesReceived > 50'000); // it runs
        auto command = (*pair.cockpit)->command(pair.robotId, "GripperCommand");
        QTRY_VERIFY((*pair.cockpit)->send(pair.robotId, command.value()));
        QVERIFY(pair.waitFor(1));
        QVERIFY2(pair.found.front().failure.find("came into use") != std::string::npos, pair.found.front().failure.c_str());
        QVERIFY2(pair.isOpen() && pair.untouched(), pair.story().c_str());
    }

    void itEndsWithTheSession()
    {
        Pair pair;
        pair.open();
        QVERIFY(pair.begin({{"long", 20s, {100}, {50}, {5, 0, 100'000}}}));
        QTRY_VERIFY((*pair.robot)->links().front().bytesReceived > 300'000); // it runs
        QVERIFY((*pair.cockpit)->closeChannel(pair.robotId));
        QVERIFY(pair.waitFor(1));
        QVERIFY2(pair.found.front().failure.find("closed") != std::string::npos, pair.found.front().failure.c_str());
        QTRY_VERIFY(pair.robot->state(pair.cockpitId) == SessionState::Closed);
        QVERIFY(!pair.robot->heard(Kind::Lost) && !pair.cockpit->heard(Kind::Lost));
        QVERIFY((*pair.cockpit)->openChannel(pair.robotId)); // and the next session can be measured
        QTRY_VERIFY_WITH_TIMEOUT(pair.isOpen(), 20000);
        pair.found.clear();
        QVERIFY(pair.measure({paced(100ms)}).failure.empty());
    }

    void itEndsWithThePeer()
    {
        Pair pair;
        pair.open();
        QVERIFY(pair.begin({paced(20s)}));
        QTRY_VERIFY((*pair.robot)->links().front().bytesReceived > 5'000);
        (*pair.robot)->stop();
        QVERIFY(pair.waitFor(1));
        QVERIFY(!pair.found.front().failure.empty());
        QVERIFY2(!pair.cockpit->heard(Kind::Lost), pair.story().c_str());
    }

    void withoutASessionNothingIsMeasured()
    {
        TestSystem system({reference::cockpit, reference::robot, reference::arm}, {"cockpit robot"});
        TestDevice cockpit(system.settingsOf("cockpit"));
        const auto none = [](const Measurement&) {};
        const auto closed = cockpit->measure(system.idOf("robot"), {paced(1s)}, none);
        QVERIFY(!closed && closed.error().code == Errc::NotOpen);
        const auto unlinked = cockpit->measure(system.idOf("arm"), {paced(1s)}, none);
        QVERIFY(!unlinked && unlinked.error().code == Errc::NoLink);
    }
};

QTEST_GUILESS_MAIN(MeasuringTest)
#include "measuring_test.moc"
