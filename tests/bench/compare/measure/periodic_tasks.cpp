// Timer descriptors.
#include "measure/periodic_tasks.hpp"

#include <sys/timerfd.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

namespace liena::compare {

PeriodicTasks::~PeriodicTasks()
{
    for (const auto& task : m_tasks)
        ::close(task.descriptor);
}

void PeriodicTasks::add(Nanoseconds period, std::function<void()> task)
{
    const int descriptor = ::timerfd_create(CLOCK_MONOTONIC, TFD_NONBLOCK);
    if (descriptor < 0)
        throw std::system_error(errno, std::generic_category(), "timerfd_create");
    m_tasks.push_back({descriptor, period, {}, std::move(task)});
}

void PeriodicTasks::start()
{
    for (auto& task : m_tasks) {
        task.due = Clock::now();
        arm(task);
    }
}

void PeriodicTasks::expire(std::size_t place)
{
    auto& task = m_tasks[place];
    std::uint64_t count = 0;
    if (::read(task.descriptor, &count, sizeof count) != sizeof count)
        return;
    arm(task);
    task.run();
}

void PeriodicTasks::arm(Task& task)
{
    task.due = std::max(task.due + task.period, Clock::now());
    const auto at = std::chrono::duration_cast<Nanoseconds>(task.due.time_since_epoch()).count();
    itimerspec when{};
    when.it_value = {at / 1'000'000'000, at % 1'000'000'000};
    ::timerfd_settime(task.descriptor, TFD_TIMER_ABSTIME, &when, nullptr);
}

} // namespace liena::compare
