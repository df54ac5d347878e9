// What a lane's rate has to do with the other lanes of its session.
#include "tasks/path_rate.hpp"

#include <algorithm>
#include <utility>

namespace liena::tasks {

using namespace std::chrono_literals;

PathRate::~PathRate() { shareWith(nullptr); }

void PathRate::shareWith(std::shared_ptr<FairShare> share, DeviceId session)
{
    if (m_share)
        m_share->leave(*this);
    m_share = std::move(share);
    m_session = session;
    m_sender = nullptr;
    m_isBurst = false;
    m_lanes = 1;
    m_usualPart = 1;
}

void PathRate::pause(Instant now, std::uint32_t unsent)
{
    m_leaves = now + std::chrono::duration_cast<Nanoseconds>(std::chrono::duration<double>(unsent / rate()));
    if (m_share)
        m_share->pause(*this, now);
    m_isBurst = m_tries = false;
    m_window.reset();
    m_draining = false; // it drains by itself
    m_look.pause(now);
    if (m_burst && !m_burst->end)
        m_burst->end = now;
}

void PathRate::enter(bool goesOn, Instant now)
{
    if (!m_share)
        return;
    m_share->enter(*this);
    if (!goesOn || m_isBurst)
        return;
    m_isBurst = true;
    if (const auto* other = m_share->makeRoom(*this, now))
        learnFrom(*other);
}

/// What all of them send and deliver is what this one does, so many times over: none has more of the path than another.
transport::PathFacts PathRate::asOfSession(const transport::PathFacts& facts, Instant now)
{
    const auto before = static_cast<double>(m_lanes);
    m_lanes = m_share ? m_share->lanesOf(*this, now) : 1;
    const auto bytes = m_bytes.note({facts.bytesSent, facts.bytesAcknowledged}, m_lanes);
    const double seconds = static_cast<double>(bytes.sent - std::exchange(m_sent, bytes.sent)) / m_rate;
    m_usualPart += (1 / before - m_usualPart) * std::min(seconds, 1.0);
    auto ofSession = facts;
    ofSession.bytesSent = bytes.sent;
    ofSession.bytesAcknowledged = bytes.acknowledged;
    return ofSession;
}

void PathRate::shareAmong(std::size_t lanes, Instant now)
{
    if (lanes == m_lanes)
        return;
    if (m_leaves > now) // so much later as it sends slower
        m_leaves = now + (m_leaves - now) * static_cast<int>(lanes) / static_cast<int>(m_lanes);
    m_lanes = lanes;
    if (m_sender != nullptr)
        m_sender->rateChanged();
}

/// Of two that met the same queue one may have yielded too far: what tells of less is taken only for what is long ago here.
void PathRate::learnFrom(const PathRate& other)
{
    constexpr auto longAgo = 1s;
    const auto newer = other.m_judged - m_judged;
    if (!other.m_ceiling || newer <= 0s || (other.m_rate < m_rate && newer < longAgo))
        return;
    if (m_burst && m_burst->end && *m_burst->end < other.m_judged)
        m_burst.reset(); // what it would tell is older
    m_look.stop();       // what it looks at is older, too
    m_judged = other.m_judged;
    m_shown = std::max(m_shown, other.m_shown);
    m_rate = other.m_rate;
    m_ceiling = other.m_ceiling;
    m_ceilingBefore = other.m_ceilingBefore;
    m_highest = other.m_highest;
    m_doubted = other.m_doubted;
    m_proven = other.m_proven;
    m_passed = other.m_passed;
    m_step = other.m_step;
    m_nextStep = other.m_nextStep;
    m_confirmed = other.m_confirmed;
}

} // namespace liena::tasks
