// This process's wall clock: the program's own clock_gettime, time and gettimeofday stand before the C library's.
#include "device/wall_clock.hpp"

#include <sys/syscall.h>
#include <sys/time.h>
#include <unistd.h>

#include <atomic>
#include <cstdint>
#include <ctime>

namespace {

constexpr std::int64_t second = 1'000'000'000;

std::atomic<std::int64_t> stepNs{0};

std::int64_t wallNs()
{
    timespec now{};
    ::syscall(SYS_clock_gettime, CLOCK_REALTIME, &now);
    return now.tv_sec * second + now.tv_nsec + stepNs.load(std::memory_order_relaxed);
}

} // namespace

namespace liena::lab {

void stepWallClock(std::chrono::milliseconds step) { stepNs += std::chrono::nanoseconds(step).count(); }

} // namespace liena::lab

extern "C" {

int clock_gettime(clockid_t clock, timespec* time) noexcept
{
    if (clock != CLOCK_REALTIME && clock != CLOCK_REALTIME_COARSE)
        return static_cast<int>(::syscall(SYS_clock_gettime, clock, time));
    const auto now = wallNs();
    time->tv_sec = now / second;
    time->tv_nsec = now % second;
    return 0;
}

int gettimeofday(timeval* time, void*) noexcept
{
    const auto now = wallNs();
    time->tv_sec = now / second;
    time->tv_usec = now % second / 1000;
    return 0;
}

time_t time(time_t* result) noexcept
{
    const auto now = static_cast<time_t>(wallNs() / second);
    if (result != nullptr)
        *result = now;
    return now;
}
}
