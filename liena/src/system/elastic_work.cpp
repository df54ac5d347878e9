// Asking the policy, and the processors that it may count on.
#include "system/elastic_work.hpp"

#include "base/ordinary_thread.hpp"
#include "system/real_time.hpp"

#include <algorithm>
#include <utility>

namespace liena::system {

using namespace std::chrono_literals;

namespace {

constexpr auto period = 100ms;

double share(std::chrono::nanoseconds busy, std::chrono::nanoseconds time)
{
    return std::chrono::duration<double>(busy) / std::chrono::duration<double>(time);
}

/// Of the processors one is the network thread's and one the application's: where there are no others, a step on another thread costs more
/// than it relieves. A network thread that looks for work does not leave its processor, and who binds one to processors divides them by
/// himself.
std::size_t mostWorkers(const Settings& settings)
{
    constexpr std::size_t taken = 2;
    if (settings.bulkWorkers)
        return *settings.bulkWorkers;
    if (settings.realTime.search > 0us || !settings.realTime.processors.empty())
        return 0;
    return std::max(usableProcessors(), taken) - taken;
}

} // namespace

ElasticWork::ElasticWork(boost::asio::io_context& network, const Settings& settings)
    : m_workers(network, base::runAsOrdinaryThread), m_balancer(mostWorkers(settings)), m_begin(std::chrono::steady_clock::now())
{}

bool ElasticWork::balance(std::chrono::steady_clock::time_point now)
{
    if (now - m_begin < period)
        return true;
    const auto busy = m_workers.takeBusy();
    const auto time = now - std::exchange(m_begin, now);
    const bool lacked = m_workers.lacks();
    m_workers.resize(m_balancer.judge({share(busy.network, time), share(busy.workers, time), busy.connections}, now));
    return lacked || !m_workers.lacks();
}

} // namespace liena::system
