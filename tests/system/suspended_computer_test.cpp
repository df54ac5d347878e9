// A computer that was suspended: nobody ran, and the monotonic clock does not know it.
#include "hostile_stage.hpp"

#include <QTest>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <ctime>
#include <future>

#include <sys/syscall.h>
#include <unistd.h>

using namespace liena;
using namespace liena::test;
using namespace std::chrono_literals;
using Kind = SessionEvent::Kind;

namespace {

constexpr std::int64_t second = 1'000'000'000;

std::atomic<std::int64_t> suspended = 0; ///< nanoseconds by which the boot clock is ahead of what it was

/// A session of a robot with a scripted X-ray system that beats seldom: what a test does with it comes between two beats.
struct SlowLink {
    TestSystem system{
        {reference::robot, reference::xray}, {"robot xray"}, {"tls", R"(heartbeat="1s" suspect="3s" lost="4s" reconnect="20s")"}};
    const DeviceId xrayId = system.idOf("xray");
    ScriptedPeer peer{roleOf(system, "xray", "robot")};
    TestDevice robot{system.settingsOf("robot")};

    SlowLink()
    {
        peer.open();
        if (!eventually([this] { return robot.heard(Kind::Opened, xrayId); }))
            throw std::runtime_error("the scripted session did not open: " + robot.story());
    }

    LinkStatus link() { return robot->links().at(0); }

    /// The robot's network thread stands while that happens, and ten seconds more.
    template <typename Event>
    void stallDuring(Event event)
    {
        std::promise<void> stands;
        std::promise<void> over;
        robot->post([&stands, until = over.get_future().share()] {
            stands.set_value();
            until.wait();
            suspended += 10 * second;
        });
        stands.get_future().wait();
        event();
        over.set_value();
    }
};

} // namespace

// This replaces the C library's, also for the libraries; a sanitizer may not be ready when it is called first.
extern "C" __attribute__((no_sanitize("address", "thread", "undefined"))) int clock_gettime(clockid_t clock, timespec* time) noexcept
{
    if (::syscall(SYS_clock_gettime, clock, time) != 0)
        return -1;
    if (clock == CLOCK_BOOTTIME) {
        const auto since = time->tv_sec * second + time->tv_nsec + suspended.load();
        time->tv_sec = since / second;
        time->tv_nsec = since % second;
    }
    return 0;
}

class SuspendedComputerTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void isAStallOfThisProcess()
    {
        TestSystem system({reference::cockpit, reference::robot}, {"cockpit robot"},
                          {"tls", R"(heartbeat="20ms" suspect="500ms" lost="800ms" reconnect="20s")"});
        TestDevice robot(system.settingsOf("robot"));
        TestDevice cockpit(system.settingsOf("cockpit"));
        QVERIFY(cockpit->openChannel(system.idOf("robot")));
        QTRY_VERIFY2(robot.heard(Kind::Opened), robot.story().c_str());
        const auto longest = [&] {
            std::chrono::nanoseconds most{};
            for (const auto& event : robot.events(Kind::LocalStall))
                most = std::max<std::chrono::nanoseconds>(most, event.duration);
            return most;
        };
        QVERIFY(longest() < 10s);
        suspended += 10 * second;
        QTRY_VERIFY2(longest() >= 10s, robot.story().c_str());
        QTRY_VERIFY2(robot.heard(Kind::Interrupted, system.idOf("cockpit")), robot.story().c_str()); // and goes on
    }

    /// Its end is the first thing that is read afterwards, while the peer asks for a session anew.
    void aLaneThatBreaksMeanwhileIsGone()
    {
        SlowLink stage;
        auto& peer = stage.peer;
        auto lane = peer.lane(1);
        QTRY_COMPARE(stage.link().bulkLanesIn, std::uint8_t{1});
        peer.habits.heartbeats = false;
        // The second takes the place of the first, and waits.
        for (const std::uint64_t token : {1U, 2U})
            peer.keep(peer.saying(wire::Words().raw(peer.attach(token)).raw(peer.handshake(token))));
        QVERIFY(peer.waits([&] { return !peer.heard(wire::number::rejected).empty(); }));
        QCOMPARE(peer.heard(wire::number::rejected)[0].datagram.body.at(8), wire::reason::busy);
        stage.stallDuring([&] { lane.reset(); });
        peer.habits.heartbeats = true; // it was there all the time: its handshake was late, and the session goes on
        QTRY_VERIFY2(stage.robot.heard(Kind::LocalStall), stage.robot.story().c_str());
        QTRY_COMPARE(stage.link().bulkLanesIn, std::uint8_t{0});
        QTRY_VERIFY2(stage.robot.heard(Kind::Interrupted, stage.xrayId), stage.robot.story().c_str());
        QVERIFY2(!stage.robot.heard(Kind::Lost), stage.robot.story().c_str());
    }

    /// A message may be lost; late it may not come.
    void whatWasHandedOverBeforeItDoesNotLeaveAfterIt()
    {
        SlowLink stage;
        const auto hand = [&](const std::string& reason) {
            auto report = stage.robot->report("InjectionReport").value();
            report.set("reason", reason);
            return stage.robot->send(stage.xrayId, report).has_value();
        };
        const auto stalls = [&] { return stage.robot.events(Kind::LocalStall).size(); };
        const auto failures = [&] { return stage.robot.events(Kind::SendFailed, stage.xrayId); };
        const auto before = stalls();
        stage.stallDuring([&] { QVERIFY(hand("before")); });
        QTRY_COMPARE(failures().size(), std::size_t{1});
        QCOMPARE(failures()[0].message, std::string("InjectionReport"));
        QVERIFY2(failures()[0].detail.find("did not run") != std::string::npos, failures()[0].detail.c_str());
        QCOMPARE(stalls(), before + 1);
        QTRY_VERIFY2(stage.robot.heard(Kind::Interrupted, stage.xrayId), stage.robot.story().c_str());

        // Also where the session is interrupted already, and what is no control would wait.
        stage.peer.habits.heartbeats = false;
        stage.stallDuring([] {});
        QTRY_COMPARE(stalls(), before + 2);
        stage.stallDuring([&] { QVERIFY(hand("meanwhile")); });
        QTRY_COMPARE(failures().size(), std::size_t{2});
        QCOMPARE(stalls(), before + 3);
        QVERIFY(hand("after"));
        stage.peer.habits.heartbeats = true;
        const auto number = stage.robot->report("InjectionReport").value().definition().number;
        QVERIFY2(stage.peer.waits([&] { return !stage.peer.heard(number).empty(); }), stage.robot.story().c_str());
        const auto heard = stage.peer.heard(number);
        QCOMPARE(heard.size(), std::size_t{1});
        const auto& body = heard[0].datagram.body;
        QVERIFY(std::string(body.begin(), body.end()).find("after") != std::string::npos);
    }

    /// It would act in a session that still looks whole.
    void whatWasPostedBeforeItRunsWhenItIsKnown()
    {
        SlowLink stage;
        const auto stalls = [&] { return stage.robot.events(Kind::LocalStall).size(); };
        const auto before = stalls();
        stage.peer.habits.heartbeats = false;
        std::promise<std::size_t> ran;
        auto found = ran.get_future();
        stage.stallDuring([&] { stage.robot->post([&] { ran.set_value(stalls()); }); });
        QVERIFY(found.wait_for(20s) == std::future_status::ready);
        QCOMPARE(found.get(), before + 1); // a heartbeat that lay unread may have healed it since
    }
};

QTEST_GUILESS_MAIN(SuspendedComputerTest)
#include "suspended_computer_test.moc"
