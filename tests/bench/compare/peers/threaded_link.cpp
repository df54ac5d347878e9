// The loop of the thread that is not the library's.
#include "peers/threaded_link.hpp"

#include <algorithm>
#include <utility>

namespace liena::compare {

ThreadedLink::ThreadedLink(const Options& options) : m_options(options) {}

void ThreadedLink::every(Nanoseconds period, std::function<void()> task) { m_tasks.push_back({period, {}, std::move(task)}); }

void ThreadedLink::run(LinkEvents& events)
{
    m_events = &events;
    connect();
    for (auto& task : m_tasks)
        task.due = Clock::now() + task.period;
    events.ready();
    std::unique_lock lock(m_mutex);
    while (!m_stopped) {
        m_wake.wait_until(lock, nextDue(), [this] { return m_stopped || m_credit; });
        const auto credit = std::exchange(m_credit, std::nullopt);
        lock.unlock();
        if (credit)
            events.commandReceived(*credit);
        runDue();
        lock.lock();
    }
}

void ThreadedLink::stop()
{
    {
        const std::lock_guard lock(m_mutex);
        m_stopped = true;
    }
    m_wake.notify_one();
}

bool ThreadedLink::isStopped()
{
    const std::lock_guard lock(m_mutex);
    return m_stopped;
}

void ThreadedLink::received(const Command& command)
{
    const bool throughput = m_options.workload == WorkloadKind::Frames || m_options.workload == WorkloadKind::Messages;
    if (!isClient() || !throughput)
        return m_events->commandReceived(command);
    {
        const std::lock_guard lock(m_mutex);
        m_credit = command;
    }
    m_wake.notify_one();
}

void ThreadedLink::runDue()
{
    for (auto& task : m_tasks)
        if (const auto now = Clock::now(); now >= task.due) {
            task.due = std::max(task.due + task.period, now);
            task.run();
        }
}

Instant ThreadedLink::nextDue() const
{
    auto next = Clock::now() + std::chrono::seconds(1);
    for (const auto& task : m_tasks)
        next = std::min(next, task.due);
    return next;
}

} // namespace liena::compare
