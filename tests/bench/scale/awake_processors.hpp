// Keeps every processor from sleeping, and gives way to whatever else wants to run.
#pragma once

#include <sched.h>

#include <thread>
#include <vector>

namespace liena::bench {

class AwakeProcessors {
public:
    AwakeProcessors()
    {
        for (unsigned i = 0; i < std::thread::hardware_concurrency(); ++i)
            m_threads.emplace_back([](const std::stop_token& stop) {
                const sched_param least{};
                ::sched_setscheduler(0, SCHED_IDLE, &least); // of the calling thread alone
                while (!stop.stop_requested()) {
                }
            });
    }

private:
    std::vector<std::jthread> m_threads;
};

} // namespace liena::bench
