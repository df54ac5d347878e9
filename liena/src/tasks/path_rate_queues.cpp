// What is taken for a queue: how late what was sent may be, and how much of it may be under way.
#include "tasks/path_figures.hpp"
#include "tasks/path_rate.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace liena::tasks {

using namespace std::chrono_literals;
using namespace path_figures;

namespace {

constexpr auto alwaysTolerated = 200us;
constexpr auto toleratedWhenCalm = 100us;
constexpr double doubtfulAfterStandstill = 0.9;
constexpr double clearlyBelow = 0.75; // what passed without a queue a moment ago
constexpr double smoothing = 8;       // acknowledgements that bring the smoothed round trip nearer to the present one by a factor of e
constexpr double noticing = 12;       // pieces of two packets, until the smoothed round trip shows a queue
constexpr double slack = 0.0002;      // seconds of what is delivered, in a round trip without a queue
// With header and seal two full packets.
constexpr std::size_t smallestSegment = 2854;
constexpr std::size_t largestSegment = 3 * smallestSegment; // a command waits for one; longer ones save little

} // namespace

/// What takes longer than the shortest for as long as this is no queue of ours: it would have drained.
transport::PathFacts PathRate::asOfLate(transport::PathFacts facts, Instant now)
{
    const auto ofLate = m_ofLate.note(facts.roundTrip, now);
    if (ofLate && *ofLate - facts.leastRoundTrip > tolerated(facts))
        facts.leastRoundTrip = *ofLate;
    const auto before = std::exchange(m_least, facts.leastRoundTrip);
    if (before > Nanoseconds::zero() && m_least - before > tolerated(facts))
        forgetQueues();
    return facts;
}

/// After it yielded, as after a second look, little was delivered since little was sent: on a short way a window that began then tells
/// nothing, but for clearly more under way than a round trip carries, or than had drained, which is another queue.
bool PathRate::mayStillDrain(const transport::PathFacts& facts, std::uint64_t acknowledgedBefore) const
{
    const double stood = m_look.drainedFrom().value_or(m_rate * secondsOf(facts.leastRoundTrip));
    return facts.leastRoundTrip < longWay && acknowledgedBefore < m_effective && underWay(facts) <= stood + m_rate * settling;
}

bool PathRate::isEffective(const transport::PathFacts& facts) const { return facts.bytesAcknowledged >= m_effective; }

bool PathRate::hasWaited(const transport::PathFacts& facts) const { return facts.roundTrip - facts.leastRoundTrip > tolerated(facts); }

/// The round trip is smoothed over many acknowledgements, which on a slow path takes long: it goes on telling of a queue that is gone. What
/// is under way knows better, and at once.
bool PathRate::hasQueue(const transport::PathFacts& facts, Instant now) const
{
    if (!hasWaited(facts))
        return false;
    const double segments = static_cast<double>(segment() * m_lanes);
    const auto usual = usualWait();
    const double own = usual ? std::min(segments, m_rate * secondsOf(*usual)) : segments;
    return underWay(facts) > mayBeUnderWay(facts, now) + own + segments / 4;
}

/// Without a queue: what a round trip carries, as was delivered of late; or what left within the last one, which is not late yet, however
/// little left before it: a connection that has just begun sends twice as much in each, and one that yielded sends at its rate again.
double PathRate::mayBeUnderWay(const transport::PathFacts& facts, Instant now) const
{
    const double carried = m_delivered * (secondsOf(facts.leastRoundTrip) + slack);
    const auto before = m_departures.about(now - facts.leastRoundTrip);
    return before ? std::max(carried, static_cast<double>(facts.bytesSent) - *before) : carried;
}

/// A path's own unrest, as it is assumed or was heard, and two of our segments; where these take milliseconds, what the kernel sends in one
/// piece and one of them, or as little as that is seen to wait: behind a token bucket a step too far costs commands next to nothing.
PathRate::Nanoseconds PathRate::tolerated(const transport::PathFacts& facts) const
{
    const double segments = 2 * static_cast<double>(segment()) / part();
    const double piece = inOnePiece / part();
    const auto usual = usualWait();
    const std::chrono::duration<double> own(std::min(segments, (usual ? std::min(piece, secondsOf(*usual)) : piece) + 0.0003));
    return (isCalm(facts) ? toleratedWhenCalm : alwaysTolerated) + std::chrono::duration_cast<Nanoseconds>(own) +
           std::max(std::min<Nanoseconds>(facts.leastRoundTrip / 16, m_calm.unrest()), unrest(facts));
}

/// Of a long path only: on a short one what is late by as much is a queue.
PathRate::Nanoseconds PathRate::unrest(const transport::PathFacts& facts) const
{
    return facts.leastRoundTrip >= longWay ? m_unrest : Nanoseconds::zero();
}

/// Elsewhere a piece takes next to no time.
std::optional<PathRate::Nanoseconds> PathRate::usualWait() const { return isSlow() ? m_usualWait.calmest() : std::nullopt; }

bool PathRate::isCalm(const transport::PathFacts& facts) const { return facts.leastRoundTrip >= longWay && m_calm.isCalm(); }

bool PathRate::mayBeUnrest(const transport::PathFacts& facts) const
{
    return isAlone() && facts.leastRoundTrip >= longWay && m_waiting <= std::min<Nanoseconds>(facts.leastRoundTrip / 3, mostUnrest);
}

/// Of a long path: what left a round trip ago has come, only somewhat late. A connection that TCP itself holds back, as each does at first,
/// delivers less than the rate, and that says nothing of the path.
bool PathRate::carriesWhatIsSent(const transport::PathFacts& facts, Instant now) const
{
    if (!mayBeUnrest(facts))
        return false;
    const auto from = m_departures.until(m_course.since() - facts.leastRoundTrip);
    const auto to = m_departures.until(now - facts.leastRoundTrip);
    return from && to &&
           m_delivered * secondsOf(now - m_course.since()) >= mostThatIsSent * (static_cast<double>(*to) - static_cast<double>(*from));
}

/// Of the rate: what makes it fall further at once is to be seen twice. Where something stood still just before it probably did so again,
/// if the rate was one that the path was known to carry. Of several lanes one may have met the queue of another.
double PathRate::doubtedBelow(Instant now) const
{
    const bool wasCarried = m_ceiling && m_rate <= *m_ceiling && m_lanes == 1;
    return wasCarried && m_stoodStill && now - *m_stoodStill < 1s ? doubtfulAfterStandstill : doubtful;
}

/// A path that carried more a moment ago, and carries what is sent now, has no queue of ours: its round trips vary by themselves, as those
/// of long and of wireless ways do. On a calm path something stood still.
bool PathRate::takenForUnrest(const transport::PathFacts& facts, double delivered, Instant now)
{
    if (!mayBeUnrest(facts) || delivered < m_rate * used)
        m_proven = 0;
    if (m_rate > m_proven * clearlyBelow)
        return false;
    if (!isCalm(facts)) {
        m_unrest = std::max(m_unrest, m_waiting);
        m_unrestSeen = now;
    }
    return true;
}

/// Once so much is acknowledged, the smoothed round trip tells no more of the queue that it tells of now.
std::uint64_t PathRate::whenForgotten(const transport::PathFacts& facts) const
{
    const double times = secondsOf(m_waiting) / secondsOf(tolerated(facts));
    return facts.bytesSent + static_cast<std::uint64_t>(smoothing * inOnePiece * std::log(std::max(times, 1.0)));
}

PathRate::Nanoseconds PathRate::timeOf(double bytes) const
{
    return std::chrono::duration_cast<Nanoseconds>(std::chrono::duration<double>(bytes / part()));
}

PathRate::Nanoseconds PathRate::timeToNotice() const { return timeOf(noticing * inOnePiece); }

/// It takes longer than between two steps elsewhere until a queue shows.
bool PathRate::isSlow() const { return timeToNotice() > gentlePause; }

std::size_t PathRate::segment() const
{
    const auto quarter = static_cast<std::size_t>(std::min(part(), m_limit.value_or(most)) * 0.00025);
    return std::clamp(quarter / smallestSegment * smallestSegment, smallestSegment, largestSegment);
}

} // namespace liena::tasks
