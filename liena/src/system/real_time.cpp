// Asking the kernel, and looking for work before sleeping.
#include "system/real_time.hpp"

#include "system/card_search.hpp"

#include <boost/asio/io_context.hpp>

#include <fmt/format.h>

#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>

#include <cerrno>
#include <cstring>
#include <system_error>
#include <thread>

namespace liena::system {

namespace {

using namespace std::chrono_literals;

constexpr auto whichThereAre = "`nproc --all` and `taskset -p $$` say which there are";
constexpr auto longestSearch = 1s; // longer is a processor of its own, and then that is what it needs

Result<void> checkValues(const RealTimeOptions& options)
{
    const int highest = ::sched_get_priority_max(SCHED_FIFO);
    if (options.priority < 0 || options.priority > highest)
        return fail(Errc::InvalidArgument, fmt::format("real-time priority {} is not 0 to {}", options.priority, highest));
    for (const int processor : options.processors)
        if (processor < 0 || processor >= CPU_SETSIZE)
            return fail(Errc::InvalidArgument, fmt::format("processor {} is not 0 to {}", processor, CPU_SETSIZE - 1));
    if (options.search < 0us || options.search > longestSearch)
        return fail(Errc::InvalidArgument, fmt::format("a search of {} us is not 0 to {} us", options.search.count(),
                                                       std::chrono::microseconds(longestSearch).count()));
    return ok();
}

Result<void> takePriority(int priority)
{
    if (priority == 0)
        return ok();
    sched_param parameters{};
    parameters.sched_priority = priority;
    if (const int error = ::pthread_setschedparam(::pthread_self(), SCHED_FIFO, &parameters); error != 0)
        return fail(Errc::Forbidden, fmt::format("real-time priority {} is not permitted to this user ({}): allow it with `rtprio` in "
                                                 "/etc/security/limits.d, with LimitRTPRIO= in the systemd unit, or with CAP_SYS_NICE",
                                                 priority, std::strerror(error)));
    return ok();
}

Result<void> takeProcessors(const std::vector<int>& processors)
{
    if (processors.empty())
        return ok();
    cpu_set_t set;
    CPU_ZERO(&set);
    for (const int processor : processors)
        CPU_SET(processor, &set);
    if (const int error = ::pthread_setaffinity_np(::pthread_self(), sizeof set, &set); error != 0)
        return fail(Errc::InvalidArgument,
                    fmt::format("none of the chosen processors may be used here ({}): {}", std::strerror(error), whichThereAre));
    cpu_set_t taken; // the kernel leaves out those that this process may not use
    if (::pthread_getaffinity_np(::pthread_self(), sizeof taken, &taken) != 0)
        return ok();
    for (const int processor : processors)
        if (!CPU_ISSET(processor, &taken))
            return fail(Errc::InvalidArgument, fmt::format("processor {} may not be used here: {}", processor, whichThereAre));
    return ok();
}

Result<void> takeThread(const RealTimeOptions& options)
{
    auto taken = takeProcessors(options.processors);
    return taken ? takePriority(options.priority) : taken;
}

/// On a thread of its own: priority and processors are a thread's.
Result<void> tryOnAThread(const RealTimeOptions& options)
{
    Result<void> taken = ok();
    try {
        std::thread([&] { taken = takeThread(options); }).join();
    } catch (const std::system_error& none) {
        return fail(Errc::Forbidden, fmt::format("no thread can be had ({}): allow more with `nproc` in /etc/security/limits.d, or with "
                                                 "TasksMax= in the systemd unit",
                                                 none.code().message()));
    }
    return taken;
}

bool hasOneProcessor()
{
    cpu_set_t set;
    return ::sched_getaffinity(0, sizeof set, &set) == 0 && CPU_COUNT(&set) == 1;
}

void runWithAttention(boost::asio::io_context& context, bool staysAwake, tasks::Attention& attention)
{
    const bool sleepsAlways = !staysAwake || hasOneProcessor();
    while (!context.stopped()) {
        if (attention.isAwake() && !sleepsAlways)
            context.poll();
        else
            context.run_one();
        if (attention.isConcerned())
            attention.judge(std::chrono::steady_clock::now());
    }
}

} // namespace

Result<void> prepareRealTime(const RealTimeOptions& options)
{
    auto done = checkValues(options);
    if (done)
        done = checkCardSearch(options.cardSearch);
    if (done)
        done = tryOnAThread(options);
    if (!done)
        return done;
    if (options.lockMemory && ::mlockall(MCL_CURRENT | MCL_FUTURE) != 0)
        return fail(Errc::Forbidden, fmt::format("memory cannot be locked ({}): allow it with `memlock unlimited` in "
                                                 "/etc/security/limits.d, with LimitMEMLOCK=infinity in the systemd unit, or with "
                                                 "CAP_IPC_LOCK",
                                                 std::strerror(errno)));
    return ok();
}

void runNetworkThread(boost::asio::io_context& context, const RealTimeOptions& options, tasks::Attention& attention)
{
    // Each was permitted when it was tried. Should a processor be gone since, the priority is taken all the same.
    (void)takeProcessors(options.processors);
    (void)takePriority(options.priority);
    if (options.search <= 0us) {
        runWithAttention(context, options.attention, attention);
        return;
    }
    auto worked = std::chrono::steady_clock::now();
    while (!context.stopped()) {
        if (context.poll() > 0)
            worked = std::chrono::steady_clock::now();
        else if (std::chrono::steady_clock::now() - worked > options.search && context.run_one() > 0)
            worked = std::chrono::steady_clock::now();
    }
}

} // namespace liena::system
