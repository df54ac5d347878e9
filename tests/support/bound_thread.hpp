// A thread with one processor of its own, as a network thread may have.
#pragma once

#include <functional>
#include <thread>

#include <sched.h>
#include <unistd.h>

namespace liena::test {

/// Of the calling thread.
inline cpu_set_t ownProcessors()
{
    cpu_set_t set;
    CPU_ZERO(&set);
    (void)::sched_getaffinity(0, sizeof set, &set);
    return set;
}

/// Of the process's first thread.
inline cpu_set_t processorsOfProcess()
{
    cpu_set_t set;
    CPU_ZERO(&set);
    (void)::sched_getaffinity(::getpid(), sizeof set, &set);
    return set;
}

/// Runs `task` to its end on such a thread.
inline void runBound(const std::function<void()>& task)
{
    std::thread([&task] {
        cpu_set_t one;
        CPU_ZERO(&one);
        CPU_SET(static_cast<std::size_t>(::sched_getcpu()), &one);
        (void)::sched_setaffinity(0, sizeof one, &one);
        task();
    }).join();
}

} // namespace liena::test
