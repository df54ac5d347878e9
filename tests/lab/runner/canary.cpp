// How long this machine keeps an idle thread from running: implementation.
#include "runner/canary.hpp"

#include "runner/record.hpp"

#include <algorithm>
#include <ctime>

namespace liena::lab {

namespace {

constexpr std::int64_t period = 1'000'000;
constexpr std::int64_t second = 1'000'000'000;

} // namespace

Canary::Canary() : m_thread([this] { run(); }) {}

Canary::~Canary()
{
    m_stop = true;
    m_thread.join();
}

void Canary::run()
{
    auto next = nowNs();
    while (!m_stop) {
        next += period;
        const timespec until{next / second, next % second};
        ::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr);
        const auto now = nowNs();
        m_largest = std::max(m_largest.load(), now - next);
        next = std::max(next, now - period);
    }
}

double Canary::takeLargest() { return static_cast<double>(m_largest.exchange(0)) / 1e6; }

} // namespace liena::lab
