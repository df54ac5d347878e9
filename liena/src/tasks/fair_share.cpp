// From the fastest to those below the mean.
#include "tasks/fair_share.hpp"

#include "tasks/path_rate.hpp"

#include <algorithm>
#include <numeric>

namespace liena::tasks {

namespace {

constexpr double part = 0.25;      // of the excess over the mean, at once
constexpr double mostRaise = 0.05; // of a lane's own rate: if it has a narrower path after all, it queues only this much more there
constexpr double alike = 0.25;     // one waits for at least this part of the other's time: they wait in one queue

bool waitAlike(const PathRate& one, const PathRate& other)
{
    return std::chrono::duration<double>(one.waiting()) > alike * other.waiting() &&
           std::chrono::duration<double>(other.waiting()) > alike * one.waiting();
}

} // namespace

void FairShare::enter(PathRate& rate)
{
    if (std::ranges::find(m_busy, &rate) == m_busy.end())
        m_busy.push_back(&rate);
}

void FairShare::leave(PathRate& rate) { std::erase(m_busy, &rate); }

void FairShare::even(const PathRate& met)
{
    if (m_busy.size() < 2)
        return;
    const double sum = std::accumulate(m_busy.begin(), m_busy.end(), 0.0, [](double so, const auto* rate) { return so + rate->steady(); });
    const double mean = sum / static_cast<double>(m_busy.size());
    auto* fastest = *std::ranges::max_element(m_busy, {}, &PathRate::steady);
    const auto below = std::ranges::count_if(m_busy, [mean](const auto* rate) { return rate->steady() < mean; });
    if (below == 0 || !waitAlike(met, *fastest))
        return;
    const double given = part * (fastest->steady() - mean);
    fastest->shift(-given);
    for (auto* rate : m_busy)
        if (rate->steady() < mean)
            rate->shift(std::min(given / static_cast<double>(below), rate->steady() * mostRaise));
}

} // namespace liena::tasks
