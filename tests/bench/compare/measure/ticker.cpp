// The rhythm.
#include "measure/ticker.hpp"

#include <algorithm>
#include <utility>

namespace liena::compare {

Ticker::Ticker(Nanoseconds period, std::function<void(Instant)> task)
    : m_thread([this, period, task = std::move(task)] { run(period, task); })
{}

Ticker::~Ticker()
{
    {
        const std::lock_guard lock(m_mutex);
        m_ended = true;
    }
    m_wake.notify_one();
    m_thread.join();
}

void Ticker::run(Nanoseconds period, const std::function<void(Instant)>& task)
{
    auto due = Clock::now() + period;
    std::unique_lock lock(m_mutex);
    while (!m_wake.wait_until(lock, due, [this] { return m_ended; })) {
        lock.unlock();
        task(due);
        lock.lock();
        due = std::max(due + period, Clock::now());
    }
}

} // namespace liena::compare
