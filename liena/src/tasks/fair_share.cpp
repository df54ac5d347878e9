// From the fastest to those below the mean.
#include "tasks/fair_share.hpp"

#include "tasks/path_rate.hpp"

#include <algorithm>

namespace liena::tasks {

namespace {

constexpr double part = 0.35;      // of the excess over the mean, at once
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

/// What one lane is of its session.
double FairShare::partOf(const PathRate& rate) const
{
    return 1.0 / static_cast<double>(std::ranges::count(m_busy, rate.session(), &PathRate::session));
}

/// Among the lanes that wait as long as `met`. Each is judged by what its session would have if all lanes of that were as fast.
void FairShare::even(const PathRate& met)
{
    const auto concerned = [&met](const PathRate* rate) { return waitAlike(met, *rate); };
    const auto ofSession = [this](const PathRate* rate) { return rate->steady() / partOf(*rate); };
    PathRate* fastest = nullptr;
    double sum = 0;
    double sessions = 0;
    for (auto* rate : m_busy) {
        if (!concerned(rate))
            continue;
        sum += rate->steady();
        sessions += partOf(*rate);
        if (fastest == nullptr || ofSession(rate) > ofSession(fastest))
            fastest = rate;
    }
    if (fastest == nullptr)
        return;
    const double mean = sum / sessions;
    const auto isBelow = [&](const PathRate* rate) { return concerned(rate) && ofSession(rate) < mean; };
    double below = 0;
    for (const auto* rate : m_busy)
        below += isBelow(rate) ? partOf(*rate) : 0;
    if (below <= 0)
        return;
    const double given = part * (fastest->steady() - mean * partOf(*fastest));
    fastest->shift(-given);
    for (auto* rate : m_busy)
        if (isBelow(rate))
            rate->shift(std::min(given * partOf(*rate) / below, rate->steady() * mostRaise));
}

} // namespace liena::tasks
