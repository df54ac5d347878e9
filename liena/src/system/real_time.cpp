// Asking the kernel, and looking for work before sleeping.
#include "system/real_time.hpp"

#include "system/card_search.hpp"
#include "system/processor_share.hpp"

#include <boost/asio/io_context.hpp>

#include <fmt/format.h>

#include <linux/capability.h>
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <optional>
#include <system_error>
#include <thread>

namespace liena::system {

namespace {

using namespace std::chrono_literals;

constexpr auto whichThereAre = "`nproc --all` and `taskset -p $$` say which there are";
constexpr auto longestSearch = 1s; // longer is a processor of its own, and then that is what it needs

bool mayExceedLocking()
{
    __user_cap_header_struct asked{_LINUX_CAPABILITY_VERSION_3, 0};
    std::array<__user_cap_data_struct, _LINUX_CAPABILITY_U32S_3> held{};
    return ::syscall(SYS_capget, &asked, held.data()) == 0 && (held[CAP_TO_INDEX(CAP_IPC_LOCK)].effective & CAP_TO_MASK(CAP_IPC_LOCK)) != 0;
}

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
    if (options.search > 0us && usableProcessors() == 1)
        return fail(Errc::InvalidArgument,
                    fmt::format("a thread that looks for work needs a processor besides, and this process may use one only: leave out "
                                "the search of {} us, or allow it more with `taskset`, CPUAffinity= or AllowedCPUs=",
                                options.search.count()));
    return ok();
}

/// A limit that is only large enough for now would let an allocation fail in the midst of a procedure.
Result<void> lockMemory()
{
    const auto remedy = [](const std::string& why) {
        return fail(Errc::Forbidden, fmt::format("memory cannot be locked ({}): allow it with `memlock unlimited` in "
                                                 "/etc/security/limits.d, with LimitMEMLOCK=infinity in the systemd unit, or with "
                                                 "CAP_IPC_LOCK",
                                                 why));
    };
    rlimit limit{};
    ::getrlimit(RLIMIT_MEMLOCK, &limit);
    if (limit.rlim_cur != RLIM_INFINITY && !mayExceedLocking())
        return remedy(fmt::format("no more than {} KiB of it, whatever this process comes to need", limit.rlim_cur / 1024));
    if (::mlockall(MCL_CURRENT | MCL_FUTURE) != 0)
        return remedy(std::strerror(errno));
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

/// Of this thread, if it has real-time priority and the kernel limits that.
std::optional<ProcessorShare> ownShare()
{
    if (const int policy = ::sched_getscheduler(0) & ~SCHED_RESET_ON_FORK; policy != SCHED_FIFO && policy != SCHED_RR)
        return std::nullopt;
    constexpr double notToTheLast = 0.95; // the kernel counts those of others with ours
    double runtime = 950'000;
    double period = 1'000'000;
    std::ifstream("/proc/sys/kernel/sched_rt_runtime_us") >> runtime;
    std::ifstream("/proc/sys/kernel/sched_rt_period_us") >> period;
    return runtime < 0 ? std::nullopt : std::optional<ProcessorShare>(notToTheLast * runtime / period);
}

/// Of the thread that asks.
class Looking {
public:
    /// Whether it may look for work rather than sleep until there is some.
    bool isAllowed()
    {
        if (!m_share)
            return true;
        const auto now = std::chrono::steady_clock::now();
        if (now - m_judged < betweenJudgements)
            return !m_spent;
        m_judged = now;
        timespec used{};
        ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &used);
        m_spent = m_share->isSpent(now, std::chrono::seconds(used.tv_sec) + std::chrono::nanoseconds(used.tv_nsec));
        return !m_spent;
    }

private:
    static constexpr auto betweenJudgements = 200us;

    std::optional<ProcessorShare> m_share = ownShare();
    std::chrono::steady_clock::time_point m_judged{};
    bool m_spent = false;
};

void runWithAttention(boost::asio::io_context& context, bool staysAwake, tasks::Attention& attention)
{
    const bool sleepsAlways = !staysAwake || usableProcessors() == 1;
    Looking looking;
    while (!context.stopped()) {
        if (!sleepsAlways && attention.isAwake() && looking.isAllowed())
            context.poll();
        else
            context.run_one();
        if (attention.isConcerned())
            attention.judge(std::chrono::steady_clock::now());
    }
}

void runWithSearch(boost::asio::io_context& context, std::chrono::microseconds search)
{
    Looking looking;
    auto worked = std::chrono::steady_clock::now();
    while (!context.stopped()) {
        const bool mayLook = looking.isAllowed();
        if (mayLook && context.poll() > 0)
            worked = std::chrono::steady_clock::now();
        else if ((!mayLook || std::chrono::steady_clock::now() - worked > search) && context.run_one() > 0)
            worked = std::chrono::steady_clock::now();
    }
}

} // namespace

std::size_t usableProcessors()
{
    cpu_set_t set;
    if (::sched_getaffinity(0, sizeof set, &set) == 0)
        return static_cast<std::size_t>(CPU_COUNT(&set));
    return std::max(std::thread::hardware_concurrency(), 1U); // there are more than the set has room for
}

Result<void> prepareRealTime(const RealTimeOptions& options)
{
    auto done = checkValues(options);
    if (done)
        done = checkCardSearch(options.cardSearch);
    if (done)
        done = tryOnAThread(options);
    if (!done)
        return done;
    return options.lockMemory ? lockMemory() : ok();
}

void runNetworkThread(boost::asio::io_context& context, const RealTimeOptions& options, tasks::Attention& attention)
{
    // Each was permitted when it was tried. Should a processor be gone since, the priority is taken all the same.
    (void)takeProcessors(options.processors);
    (void)takePriority(options.priority);
    if (options.search > 0us)
        runWithSearch(context, options.search);
    else
        runWithAttention(context, options.attention, attention);
}

} // namespace liena::system
