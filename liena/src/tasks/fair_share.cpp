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

bool sharesPath(const PathRate& one, const PathRate& other) { return &one != &other && one.session() == other.session(); }

} // namespace

void FairShare::enter(PathRate& rate)
{
    std::erase(m_leaving, &rate);
    if (std::ranges::find(m_busy, &rate) == m_busy.end())
        m_busy.push_back(&rate);
}

const PathRate* FairShare::makeRoom(const PathRate& rate, Instant now)
{
    std::erase_if(m_leaving, [now](const auto* leaving) { return leaving->leaves() <= now; });
    tellOthers(rate, now);
    const PathRate* newest = nullptr;
    for (const auto* other : m_busy)
        if (sharesPath(*other, rate) && other->isBurst() && (newest == nullptr || other->judged() > newest->judged()))
            newest = other;
    return newest;
}

bool FairShare::isAlone(const PathRate& rate) const
{
    return std::ranges::all_of(m_busy, [&rate](const auto* other) { return other->session() == rate.session(); });
}

void FairShare::pause(PathRate& rate, Instant now)
{
    leave(rate);
    if (!rate.isBurst())
        return;
    if (rate.leaves() > now)
        m_leaving.push_back(&rate);
    else
        tellOthers(rate, now);
}

void FairShare::leave(PathRate& rate)
{
    std::erase(m_busy, &rate);
    std::erase(m_leaving, &rate);
}

std::size_t FairShare::lanesOf(const PathRate& rate, Instant now) const
{
    const auto isBurst = [&](const auto* other) { return sharesPath(*other, rate) && other->isBurst(); };
    const auto sends = [&](const auto* other) { return sharesPath(*other, rate) && other->leaves() > now; };
    return static_cast<std::size_t>(1 + std::ranges::count_if(m_busy, isBurst) + std::ranges::count_if(m_leaving, sends));
}

/// How many they are now.
void FairShare::tellOthers(const PathRate& rate, Instant now) const
{
    for (const auto* lanes : {&m_busy, &m_leaving})
        for (auto* other : *lanes)
            if (sharesPath(*other, rate))
                other->shareAmong(lanesOf(*other, now), now);
}

/// What one lane is of its session.
double FairShare::partOf(const PathRate& rate) const
{
    return 1.0 / static_cast<double>(std::ranges::count(m_busy, rate.session(), &PathRate::session));
}

/// Among the lanes that wait as long as `met`. Each is judged by what its session would have if all lanes of that were as fast.
void FairShare::even(const PathRate& met)
{
    const auto concerned = [&met](const PathRate* rate) { return waitAlike(met, *rate); };
    PathRate* fastest = nullptr;
    double sum = 0;
    double sessions = 0;
    for (auto* rate : m_busy) {
        if (!concerned(rate))
            continue;
        sum += rate->steady() * partOf(*rate);
        sessions += partOf(*rate);
        if (fastest == nullptr || rate->steady() > fastest->steady())
            fastest = rate;
    }
    if (fastest == nullptr)
        return;
    const double mean = sum / sessions;
    const auto isBelow = [&](const PathRate* rate) { return concerned(rate) && rate->steady() < mean; };
    double below = 0;
    for (const auto* rate : m_busy)
        below += isBelow(rate) ? partOf(*rate) : 0;
    if (below <= 0)
        return;
    const double given = part * (fastest->steady() - mean);
    fastest->shift(-given);
    for (auto* rate : m_busy)
        if (isBelow(rate))
            rate->shift(std::min(given * partOf(*fastest) / below, rate->steady() * mostRaise));
}

} // namespace liena::tasks
