// A computer that was suspended: nobody ran, and the monotonic clock does not know it.
#include "test_system.hpp"

#include <QTest>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <ctime>

#include <sys/syscall.h>
#include <unistd.h>

using namespace liena;
using namespace liena::test;
using namespace std::chrono_literals;
using Kind = SessionEvent::Kind;

namespace {

constexpr std::int64_t second = 1'000'000'000;

std::atomic<std::int64_t> suspended = 0; ///< nanoseconds by which the boot clock is ahead of what it was

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
};

QTEST_GUILESS_MAIN(SuspendedComputerTest)
#include "suspended_computer_test.moc"
