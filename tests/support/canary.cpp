// How long this machine keeps an idle thread from running: implementation.
#include "support/canary.hpp"

#include <algorithm>
#include <ctime>

#include <sched.h>

namespace liena::test {

namespace {

constexpr std::int64_t second = 1'000'000'000;
constexpr std::int64_t worthKeeping = 300'000;
constexpr std::size_t mostKept = 100'000;

std::int64_t nowNs() { return std::chrono::nanoseconds(std::chrono::steady_clock::now().time_since_epoch()).count(); }

} // namespace

Canary::Canary(std::chrono::nanoseconds period) : m_period(period.count())
{
    for (unsigned processor = 0; processor < std::max(1U, std::thread::hardware_concurrency()); ++processor)
        m_threads.emplace_back([this, processor] { run(processor); });
}

Canary::~Canary()
{
    m_stop = true;
    for (auto& thread : m_threads)
        thread.join();
}

void Canary::run(unsigned processor)
{
    cpu_set_t only;
    CPU_ZERO(&only);
    CPU_SET(processor, &only);
    (void)::sched_setaffinity(0, sizeof only, &only); // where it may not, it watches whatever it runs on
    auto next = nowNs();
    while (!m_stop) {
        next += m_period;
        const timespec until{next / second, next % second};
        ::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr);
        const auto now = nowNs();
        note({next, now});
        next = std::max(next, now - m_period);
    }
}

void Canary::note(Stall stall)
{
    const auto length = stall.end - stall.begin;
    auto largest = m_largest.load();
    while (length > largest && !m_largest.compare_exchange_weak(largest, length)) {
    }
    if (length < worthKeeping)
        return;
    const std::lock_guard lock(m_mutex);
    if (m_stalls.size() == mostKept)
        m_stalls.pop_front();
    m_stalls.push_back(stall);
}

std::vector<Canary::Stall> Canary::stalls() const
{
    const std::lock_guard lock(m_mutex);
    return {m_stalls.begin(), m_stalls.end()};
}

double Canary::takeLargest() { return static_cast<double>(m_largest.exchange(0)) / 1e6; }

double Canary::largestBetween(std::int64_t from, std::int64_t to) const
{
    const std::lock_guard lock(m_mutex);
    std::int64_t largest = 0;
    for (const auto& stall : m_stalls)
        if (stall.begin < to && stall.end > from)
            largest = std::max(largest, stall.end - stall.begin);
    return static_cast<double>(largest) / 1e6;
}

} // namespace liena::test
