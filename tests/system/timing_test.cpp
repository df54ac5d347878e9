// What is late, missing or stalled in whole devices, and the timing of a single link.
#include "test_system.hpp"

#include <QTest>

#include <algorithm>
#include <semaphore>

using namespace liena;
using namespace liena::test;
using Kind = SessionEvent::Kind;

namespace {

Result<void> sendMotion(TestDevice& cockpit, DeviceId robot, std::uint32_t sequence)
{
    auto message = cockpit->command(robot, "MotionCommand").value();
    message.set("sequence", sequence).set("engaged", true).set("guidewire_velocity", 2.5);
    return cockpit->send(robot, message);
}

std::vector<std::uint32_t> motionsHeard(TestDevice& robot)
{
    std::vector<std::uint32_t> sequences;
    for (const auto& message : robot.messages("MotionCommand"))
        sequences.push_back(message.get<std::uint32_t>("sequence"));
    return sequences;
}

/// A stream, as a hand's is: one command alone may be too old when a busy computer comes to it, and is then refused with reason.
bool streamedUntilHeard(TestDevice& from, DeviceId to, TestDevice& robot, std::uint32_t sequence)
{
    const auto heard = motionsHeard(robot);
    return std::ranges::find(heard, sequence) != heard.end() || ((void)sendMotion(from, to, sequence), false);
}

std::uint64_t heartbeatsFrom(TestDevice& device, DeviceId peer)
{
    for (const auto& link : device->links())
        if (link.peer == peer)
            return link.heartbeatsReceived;
    return 0;
}

/// A cockpit with links to a robot and to an arm.
struct Trio {
    explicit Trio(const char* robotLink) : system({reference::cockpit, reference::robot, reference::arm}, {robotLink, "cockpit arm"}) {}

    bool opens()
    {
        const auto asked = cockpit->openChannel(robotId) && cockpit->openChannel(armId);
        return asked && QTest::qWaitFor([this] {
                   return cockpit.heard(Kind::Opened, robotId) && cockpit.heard(Kind::Opened, armId) && robot.heard(Kind::Opened) &&
                          arm.heard(Kind::Opened);
               });
    }

    TestSystem system;
    DeviceId robotId = system.idOf("robot");
    DeviceId armId = system.idOf("arm");
    TestDevice robot{system.settingsOf("robot")};
    TestDevice arm{system.settingsOf("arm")};
    TestDevice cockpit{system.settingsOf("cockpit")};
};

} // namespace

class TimingTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void aMissedDeadlineIsToldOncePerGap()
    {
        TestSystem system({reference::cockpit, reference::robot}, {"cockpit robot"});
        const auto robotId = system.idOf("robot");
        TestDevice robot(system.settingsOf("robot"));
        TestDevice cockpit(system.settingsOf("cockpit"));
        QVERIFY(cockpit->openChannel(robotId));
        QTRY_VERIFY2(robot.heard(Kind::Opened), robot.story().c_str());
        const auto missed = [&] { return cockpit.events(Kind::DeadlineMissed, robotId); };

        const auto beats = heartbeatsFrom(cockpit, robotId);
        QTRY_VERIFY(heartbeatsFrom(cockpit, robotId) >= beats + 10); // a stream that has not begun misses nothing
        QVERIFY2(missed().empty(), cockpit.story().c_str());
        for (std::size_t gap = 1; gap <= 2; ++gap) {
            const auto status = robot->report("RobotStatus").value(); // deadline 50 ms
            QCOMPARE(robot->publish(status), std::size_t{1});
            QTRY_COMPARE(cockpit.messages("RobotStatus").size(), gap);
            QTRY_COMPARE(missed().size(), gap);
            QCOMPARE(missed().back().message, std::string("RobotStatus"));
            const auto later = heartbeatsFrom(cockpit, robotId);
            QTRY_VERIFY(heartbeatsFrom(cockpit, robotId) >= later + 10);
            QCOMPARE(missed().size(), gap);
        }
    }

    void nothingIsMissedOfALinkThatWasClosed()
    {
        Trio trio("cockpit robot");
        auto& [system, robotId, armId, robot, arm, cockpit] = trio;
        QVERIFY2(trio.opens(), cockpit.story().c_str());
        QCOMPARE(robot->publish(robot->report("RobotStatus").value()), std::size_t{1}); // deadline 50 ms
        QVERIFY(robot->closeChannel(system.idOf("cockpit")));
        QTRY_COMPARE(words(cockpit.state(robotId)), words(SessionState::Closed));
        QCOMPARE(cockpit.messages("RobotStatus").size(), std::size_t{1});
        // What the arm says later has a longer deadline: when that is missed, the robot's would have been.
        QCOMPARE(arm->publish(arm->report("ArmStatus").value()), std::size_t{1});
        QTRY_VERIFY2(cockpit.heard(Kind::DeadlineMissed, armId), cockpit.story().c_str());
        for (const auto& missed : cockpit.events(Kind::DeadlineMissed, robotId)) // on a busy computer one before the closing
            QVERIFY2(carriesMessages(missed.to), cockpit.story().c_str());
    }

    void aLinkMayHaveATimingOfItsOwn()
    {
        Trio trio(R"(cockpit robot|heartbeat="60ms")");
        auto& [system, robotId, armId, robot, arm, cockpit] = trio;
        QVERIFY2(trio.opens(), cockpit.story().c_str());
        const auto before = std::pair(heartbeatsFrom(cockpit, robotId), heartbeatsFrom(cockpit, armId));
        QTRY_VERIFY(heartbeatsFrom(cockpit, armId) >= before.second + 20);
        const auto ofRobot = heartbeatsFrom(cockpit, robotId) - before.first;
        const auto ofArm = heartbeatsFrom(cockpit, armId) - before.second;
        QVERIFY2(ofArm > 2 * ofRobot, (std::to_string(ofRobot) + " of the robot, " + std::to_string(ofArm) + " of the arm").c_str());
    }

    /// The robot's process stands still: what came meanwhile is never delivered, and the stall is told.
    void whatCameWhileThisProcessStoodStillIsNotDelivered()
    {
        TestSystem system({reference::cockpit, reference::robot}, {"cockpit robot"},
                          {"tls", R"(heartbeat="20ms" suspect="500ms" lost="800ms" reconnect="20s")"});
        const auto robotId = system.idOf("robot");
        const auto cockpitId = system.idOf("cockpit");
        TestDevice robot(system.settingsOf("robot"));
        TestDevice cockpit(system.settingsOf("cockpit"));
        QVERIFY(cockpit->openChannel(robotId));
        QTRY_VERIFY2(robot.heard(Kind::Opened), robot.story().c_str());
        QTRY_VERIFY2(streamedUntilHeard(cockpit, robotId, robot, 1), robot.story().c_str());

        std::binary_semaphore stands{0};
        std::binary_semaphore goOn{0};
        robot->post([&] {
            stands.release();
            goOn.acquire();
        });
        stands.acquire();
        QVERIFY(sendMotion(cockpit, robotId, 2).has_value()); // the cockpit does not know yet
        QTRY_COMPARE(words(cockpit.state(robotId)), words(SessionState::Reconnecting));
        goOn.release();
        QTRY_VERIFY2(robot.heard(Kind::LocalStall), robot.story().c_str());
        QVERIFY(robot.events(Kind::LocalStall)[0].duration >= std::chrono::milliseconds(500));
        QTRY_VERIFY2(cockpit.heard(Kind::Interrupted, robotId), cockpit.story().c_str());
        QTRY_VERIFY2(robot.heard(Kind::Interrupted, cockpitId), robot.story().c_str());
        QTRY_VERIFY2(streamedUntilHeard(cockpit, robotId, robot, 3), (cockpit.story() + robot.story()).c_str());
        const auto heard = motionsHeard(robot);
        QVERIFY(std::ranges::find(heard, 2U) == heard.end());
        for (auto* device : {&robot, &cockpit}) // a lane 0 made anew changes the keys of packets, and none looks forged for that
            for (const auto& event : device->events(Kind::MessagesDropped))
                QVERIFY2(event.detail.find("sealed") == std::string::npos, event.detail.c_str());
    }

    /// Too short for a stall of the process: the session stands, and nothing but its age speaks against a command.
    void whatWaitedLongerThanItsMaxAgeIsNotDelivered()
    {
        Trio trio(R"(cockpit robot|heartbeat="20ms" suspect="4s" lost="5s" reconnect="10s")");
        auto& [system, robotId, armId, robot, arm, cockpit] = trio;
        QVERIFY2(trio.opens(), cockpit.story().c_str());
        QTRY_VERIFY2(streamedUntilHeard(cockpit, robotId, robot, 1), robot.story().c_str());

        std::binary_semaphore stands{0};
        std::binary_semaphore goOn{0};
        robot->post([&stands, &goOn] {
            stands.release();
            goOn.acquire();
        });
        stands.acquire();
        const auto beats = heartbeatsFrom(cockpit, armId);
        int sent = 0;
        for (std::uint32_t sequence = 2; sequence < 22; ++sequence)
            sent += sendMotion(cockpit, robotId, sequence) ? 1 : 0;
        // Ten of the arm's heartbeats are 200 ms; a motion command may be 50 ms old.
        const bool late = QTest::qWaitFor([&trio, beats] { return heartbeatsFrom(trio.cockpit, trio.armId) >= beats + 10; });
        goOn.release();
        QVERIFY(late);
        QCOMPARE(sent, 20);
        QTRY_VERIFY2(streamedUntilHeard(cockpit, robotId, robot, 22), (cockpit.story() + robot.story()).c_str());
        for (const auto sequence : motionsHeard(robot))
            QVERIFY2(sequence == 1 || sequence == 22, std::to_string(sequence).c_str());
        // It was that, and neither the stall nor what is judged after the age.
        const auto dropped = robot.events(Kind::MessagesDropped);
        QVERIFY2(std::ranges::any_of(dropped, [](const auto& event) { return event.detail == "older than its max-age"; }),
                 robot.story().c_str());
        QVERIFY2(!robot.heard(Kind::LocalStall) && !robot.heard(Kind::Interrupted), robot.story().c_str());
        QVERIFY2(!cockpit.heard(Kind::Interrupted, robotId), cockpit.story().c_str());
    }

    void noSecurityIsSaidLoudly()
    {
        TestSystem system({reference::cockpit, reference::robot}, {"cockpit robot"}, {"none"});
        auto settings = system.settingsOf("robot");
        std::vector<std::string> warnings;
        settings.log = [&](const LogLine& line) {
            if (line.level >= LogLevel::Warning)
                warnings.emplace_back(line.text);
        };
        QVERIFY(DistributedSystem::create(settings));
        QVERIFY2(std::any_of(warnings.begin(), warnings.end(),
                             [](const std::string& text) { return text.find("NO SECURITY") != std::string::npos; }),
                 warnings.empty() ? "nothing was said" : warnings[0].c_str());
    }
};

QTEST_GUILESS_MAIN(TimingTest)
#include "timing_test.moc"
