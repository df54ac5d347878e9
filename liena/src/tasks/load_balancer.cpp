// When to grow and when to shrink.
#include "tasks/load_balancer.hpp"

#include <algorithm>
#include <cmath>

namespace liena::tasks {

using namespace std::chrono_literals;

namespace {

constexpr std::size_t mostWorkers = 4;
constexpr std::size_t mostLanes = 4; // a peer takes up to 8; more than a few streams at once do not gain from their own
constexpr auto quietWorkers = 2s;
constexpr auto quietLanes = 3s;
constexpr double firstAt = 0.25; // of the network thread
constexpr double idleAt = 0.05;
constexpr double fullAt = 0.75; // of a worker
constexpr double halfAt = 0.5;  // of each that would be left

} // namespace

std::size_t ElasticCount::want(std::size_t wanted, Instant now)
{
    wanted = std::clamp(wanted, m_bounds.least, m_bounds.most);
    if (wanted >= m_count) {
        m_count = wanted;
        m_less.reset();
        return m_count;
    }
    if (!m_less)
        m_less = now;
    if (now - *m_less >= m_bounds.quiet) {
        --m_count;
        m_less = now;
    }
    return m_count;
}

LoadBalancer::LoadBalancer(std::size_t most) : m_workers({0, std::min(mostWorkers, most), quietWorkers}) {}

std::size_t LoadBalancer::judge(const Sample& sample, Instant now) { return m_workers.want(wanted(sample), now); }

std::size_t LoadBalancer::wanted(const Sample& sample) const
{
    const auto now = m_workers.count();
    const double load = sample.network + sample.workers;
    if (now == 0)
        return sample.network >= firstAt && sample.lanes > 0 ? 1 : 0;
    if (sample.workers >= fullAt * static_cast<double>(now))
        return std::max(now, std::min(now + 1, sample.lanes));
    const bool lessWouldDo = now > 1 ? load < halfAt * static_cast<double>(now - 1) : load < idleAt;
    return lessWouldDo || (now > 1 && sample.lanes < now) ? now - 1 : now;
}

ElasticCount laneCount() { return ElasticCount({1, mostLanes, quietLanes}); }

} // namespace liena::tasks
