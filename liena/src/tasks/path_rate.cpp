// Growing and yielding.
#include "tasks/path_rate.hpp"
#include "tasks/path_figures.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace liena::tasks {

using namespace std::chrono_literals;
using namespace path_figures;

namespace {

constexpr auto shortestWindow = 2ms;    // between decisions, however near the peer is
constexpr auto longestSilence = 50ms;   // until a burst's first acknowledgement; then there is a queue
constexpr auto unrestHalves = 10s;      // what was seen of it, when it is not seen again
constexpr double provenLeft = 0.97;     // of that, a second later
constexpr double drain = 0.25;          // of the rate, while a queue drains
constexpr double drainWhenSlow = 0.125; // where a segment more is long in coming through, or may be
constexpr double margin = 0.93;         // of what was delivered while a queue stood
constexpr double allThatIsSent = 0.95;  // nearly
constexpr double leastProof = 0.002;    // seconds at the rate: shorter bursts do not show what the path carries
constexpr double deepestFall = 0.125;   // at once: a moment in which a processor stood still proves no more
constexpr auto leastPiece = 500us;      // that it takes: less is lost among what computers take
constexpr double asBefore = 0.15;       // of the ceiling: a queue met so near it confirms it
constexpr auto confirmedFor = 2000ms;   // before a slow or calm path's confirmed ceiling is passed again, by waiting and by gentle steps
constexpr double refuted = 1.1;         // times a ceiling, without a queue: it is none
constexpr double quickest = 1.25;       // a step while nothing is known
constexpr double triedStep = 1.12;      // a step once the end of a burst was sent still faster
constexpr double gentle = 1.01;         // a step near the ceiling
constexpr double nearCeiling = 0.9;     // gently from here
constexpr double untried = 0.97;        // of the ceiling: below it hardly ever a queue of ours stands
constexpr double highestLeft = 0.99;    // of the highest ceiling of late, a second later
constexpr double bolder = 1.5;          // each step beyond the ceiling, as long as no queue shows
constexpr int atOnce = 3;               // a part of what is tolerated, by which a round trip waits longer than just before
constexpr int roundTripsToNotice = 6;   // that a rate is too high: the path fills, what is tolerated is passed, and it is heard
constexpr int piecesInDoubt = 4;        // what is late by no more waits for pieces of its own
constexpr std::uint64_t provenBytes = 65536; // before them a connection's round trip is that of its handshake

} // namespace

void PathRate::restart()
{
    m_window.reset();
    m_burst.reset();
    m_departures = {};
    m_calm = {}; // it may go another way
    m_unrest = Nanoseconds::zero();
    m_ofLate = {};
    m_least = Nanoseconds::zero();
    m_waiting = Nanoseconds::zero();
    m_look.forget();
    m_stoodStill.reset();
    m_standing.forget();
    m_usualWait.forget();
    m_pieceWait.forget();
    m_draining = false;
    m_passed = 0;
    m_effective = 0;
    m_bytes = {};
    m_sent = 0;
}

void PathRate::observe(const transport::PathFacts& facts, Instant now, bool goesOn)
{
    const auto ofSession = asOfSession(facts, now);
    enter(goesOn, now); // with the first byte: it takes of the path before it tells of it
    if (facts.bytesAcknowledged < provenBytes)
        return;
    decide(asOfLate(ofSession, now), now);
}

/// They were none, the path has become longer: back to what it carried before. On a slow path, where a step too far is long in coming
/// through, only where that is proven.
void PathRate::forgetQueues()
{
    m_confirmed.reset();
    if (isSlow() && !m_ofLate.isProven())
        return;
    m_ceiling = m_highest > m_rate ? std::optional(m_highest) : std::nullopt;
    m_doubted = m_draining = false;
    m_look.stop();
    m_effective = 0;
}

void PathRate::decide(const transport::PathFacts& facts, Instant now)
{
    m_waiting = facts.roundTrip - facts.leastRoundTrip;
    const auto standing = m_standing.look({now, m_waiting, facts.bytesSent, facts.bytesAcknowledged}, facts.roundTrip);
    if (standing == StandingWait::Says::OfThePath)
        m_ofLate.prove(facts.roundTrip, now);
    const bool mayBeOfThePath = standing != StandingWait::Says::Nothing;
    m_isLong = facts.leastRoundTrip >= longWay;
    if (m_unrest > Nanoseconds::zero() && now - m_unrestSeen > unrestHalves) {
        m_unrest /= 2;
        m_unrestSeen = now;
    }
    if (now - m_provenFaded > 1s) {
        m_proven *= provenLeft;
        m_highest *= highestLeft;
        m_provenFaded = now;
    }
    m_departures.note({now, facts.bytesSent}, facts.leastRoundTrip);
    if (!m_window) {
        m_look.resume(now);
        if (m_burst && !mayBeOfThePath)
            judgeBurst(facts, now);
        m_burst = Burst{now, std::nullopt, facts.bytesSent, facts.bytesAcknowledged >= facts.bytesSent};
        m_window = Window{{now, facts.bytesAcknowledged}, facts.windowClosed, true};
        m_course.forget();
        return;
    }
    if (m_draining && !hasQueue(facts, now)) {
        m_draining = false;
        if (m_look.isOn(now))
            return goOn(facts, now);
        if (!m_isLong)
            m_effective = std::max(m_effective, facts.bytesSent); // until now at the pace of the drain
    }
    const auto elapsed = now - m_window->begin.at;
    if (m_window->first && m_burst->alone && facts.bytesAcknowledged <= m_burst->bytesSent && elapsed < longestSilence)
        return; // nothing of it is acknowledged yet
    if (elapsed < std::max<Nanoseconds>(shortestWindow, facts.leastRoundTrip))
        return;
    const Window ended = std::exchange(*m_window, Window{{now, facts.bytesAcknowledged}, facts.windowClosed, false});
    if (ended.first && facts.leastRoundTrip > shortestWindow / 8)
        return; // little of it is acknowledged yet
    const bool receiverLimits = facts.windowClosed - ended.windowClosed > elapsed / 4;
    m_delivered = m_course.rate(ended.begin, {now, facts.bytesAcknowledged}, timeToNotice());
    const double sending = rate() * static_cast<double>(m_lanes);
    m_judged = now;
    if (m_delivered > sending * used) // also at a limit, below what it would grow from
        m_shown = now;
    const bool queue = hasQueue(facts, now);
    if (queue || receiverLimits || m_delivered > m_rate * used)
        m_burst.reset();
    if (queue) {
        // If it may be the way's, to yield further would tell no more.
        if (mayBeOfThePath)
            return;
        const bool heard = facts.bytesAcknowledged > ended.begin.bytes; // else the round trip is an old one
        const bool allCame = carriesWhatIsSent(facts, now);
        if (mayStillDrain(facts, ended.begin.bytes))
            return m_course.forget();
        if (isEffective(facts) || (heard && m_delivered * margin < sending * used))
            meetQueue(facts, allCame ? std::max(m_delivered, m_rate * mostThatIsSent) : m_delivered, allCame, now);
        return;
    }
    if (m_ceiling && m_rate < *m_ceiling * untried && isEffective(facts))
        m_usualWait.note(m_waiting, now);
    if (m_ceiling && timeOf(inOnePiece) > leastPiece && isEffective(facts) && m_pieceWait.isOver(m_waiting, timeOf(inOnePiece), now))
        doubtCeiling(now);
    if (!receiverLimits && m_delivered > m_rate * used)
        grow(facts, m_delivered, quickest, now);
}

/// It was over before its acknowledgements came; what they said of it is known when the next one begins.
void PathRate::judgeBurst(const transport::PathFacts& facts, Instant now)
{
    constexpr double leastBytes = 4096; // fewer make no queue of their own
    const double bytes = static_cast<double>(facts.bytesSent - m_burst->bytesSent);
    const double seconds = std::max(secondsOf(m_burst->end.value_or(now) - m_burst->begin), bytes / m_rate);
    if (!isEffective(facts))
        return;
    const bool proves = bytes > m_rate * leastProof;
    if (proves)
        m_judged = now;
    const double carried = bytes / (seconds + secondsOf(std::max(m_waiting - unrest(facts), Nanoseconds::zero()))); // that is not its queue
    const bool tells = !mayBeUnrest(facts) || (proves && seconds > secondsOf(m_waiting)); // else it was late for longer than it took
    if (bytes >= leastBytes && hasWaited(facts))
        meetQueue(facts, tells ? carried : m_rate, mayBeUnrest(facts), now);
    else if (!hasWaited(facts) && bytes / seconds > m_rate * used && proves)
        grow(facts, carried, m_burst->tries ? triedStep : quickest, now);
    m_draining = false; // it had the pause for that
}

void PathRate::endsBurst(bool ends)
{
    m_tries = ends && mayTry();
    if (m_tries && m_burst)
        m_burst->tries = true;
}

bool PathRate::mayTry() const { return m_isLong && m_calm.isCalm() && !m_ceiling && !m_draining; }

/// On a short way, and not for one of several lanes of a session: of those the others may have fallen at the same queue already.
bool PathRate::looksAgain(const transport::PathFacts& facts, Instant now)
{
    const SecondLook::Seen seen{now, m_rate, underWay(facts), m_waiting};
    const auto longEnough = 2 * timeToNotice() + roundTripsToNotice * facts.leastRoundTrip;
    const bool isOn = m_look.isOn(now);
    const bool begins = !isOn && !m_isLong && m_lanes == 1 && m_look.begins(seen, tolerated(facts) / atOnce, longEnough);
    if (!begins && !(isOn && m_look.goesOn(seen)))
        return false;
    m_draining = true; // also when a pause came between
    m_drain = drainWhenSlow;
    if (begins)
        judgeFrom(facts, now);
    return true;
}

/// A standstill had left the queue, and it is gone. If it was a step too far after all, this is what that would cost.
void PathRate::goOn(const transport::PathFacts& facts, Instant now)
{
    m_look.drained(now);
    m_stoodStill = now;
    if (m_ceiling)
        m_rate = std::min(m_rate, *m_ceiling * margin);
    m_effective = std::max(facts.bytesSent + static_cast<std::uint64_t>(m_rate * settling), whenForgotten(facts));
    judgeFrom(facts, now);
    m_step = gentle;
    m_nextStep = now + pauseBetweenSteps();
    if (m_share)
        m_share->even(*this);
}

/// What came before tells of the standstill, or of how little was sent.
void PathRate::judgeFrom(const transport::PathFacts& facts, Instant now)
{
    m_window = Window{{now, facts.bytesAcknowledged}, facts.windowClosed, false};
    m_course.forget();
}

void PathRate::meetQueue(const transport::PathFacts& facts, double delivered, bool allCame, Instant now)
{
    m_shown = now;
    if (looksAgain(facts, now))
        return;
    if (mayBeUnrest(facts) && std::exchange(m_passed, 0) >= m_rate)
        return; // seen once, at a rate that passed: a computer that stood still for a moment looks like that
    m_usualWait.forget();
    const double carried = std::clamp(delivered, least, most);
    if (allCame && !isCalm(facts) && m_unrest == Nanoseconds::zero())
        delivered = m_rate; // nothing is known of the path's own unrest
    if (takenForUnrest(facts, delivered, now))
        return;
    if (m_waiting > piecesInDoubt * timeOf(inOnePiece))
        m_standing.yielded({now, m_waiting, facts.bytesSent, facts.bytesAcknowledged}, carried);
    if (allCame)
        m_proven = std::max(m_proven, std::min(m_rate, carried));
    const bool less = delivered < m_rate * allThatIsSent;
    delivered = std::max(delivered, m_rate * deepestFall);
    const bool again = m_ceiling && std::abs(delivered - *m_ceiling) < asBefore * *m_ceiling;
    const bool wasDoubted = std::exchange(m_doubted, !again && delivered < m_rate * doubtedBelow(now));
    if (!wasDoubted)
        m_ceilingBefore = m_ceiling;
    if (delivered < m_rate * doubtful)
        m_stoodStill.reset(); // that was before a fall, and tells nothing of what comes after it
    if (less && !m_doubted)
        m_unrest = Nanoseconds::zero(); // it hides a queue of ours: let it be seen again, if it was one
    if (again && m_confirmed)
        delivered = (delivered + *m_ceiling) / 2; // what a token bucket had left came through, too
    m_ceiling = std::clamp(delivered, least, most);
    m_highest = std::max(m_highest, std::min(*m_ceiling, carried));
    if (mayBeUnrest(facts) && m_calm.isDue(now))
        m_calm.begin();
    else
        m_calm.stop();
    m_rate =
        std::clamp(m_calm.listens() ? std::min(m_rate, carried) * PathCalm::slower : std::min(m_rate, delivered) * margin, least, most);
    yield(facts);
    m_look.forget();
    m_step = gentle;
    m_nextStep = now + (m_doubted ? pauseInDoubt(facts) : pauseBetweenSteps());
    const auto climb = pauseBetweenSteps() * static_cast<int>(std::log(refuted / margin) / std::log(gentle));
    const bool believed = again && (isSlow() || isCalm(facts));
    const auto wait = std::max<Nanoseconds>(confirmedFor - climb, 0s);
    m_confirmed = believed ? std::optional(now + wait) : std::nullopt;
    if (m_share)
        m_share->even(*this);
}

/// The rate is lower now: first what stands drains, and what was sent before says nothing of it. A rate that fell deep at once may still be
/// far above what the path carries. On a long way it is known late that a queue is gone.
void PathRate::yield(const transport::PathFacts& facts)
{
    m_draining = true;
    m_drain = !m_isLong && (m_doubted || isSlow()) ? drainWhenSlow : drain;
    m_effective = facts.bytesSent + static_cast<std::uint64_t>(m_rate * settling);
}

void PathRate::shift(double bytesPerSecond)
{
    m_rate = std::clamp(m_rate + bytesPerSecond, least, most);
    m_highest = std::max(m_highest + bytesPerSecond, 0.0);
    for (auto* ceiling : {&m_ceiling, &m_ceilingBefore})
        if (*ceiling)
            *ceiling = std::clamp(**ceiling + bytesPerSecond, least, most);
}

void PathRate::grow(const transport::PathFacts& facts, double delivered, double quickStep, Instant now)
{
    m_shown = now;
    m_passed = m_rate;
    m_look.passed(m_rate, m_waiting, now);
    m_proven = std::max(m_proven, std::min(m_rate, delivered));
    if (m_calm.listens() && !listen(facts, now))
        return;
    if (m_doubted)
        return growInDoubt(facts, now);
    if (!m_ceiling && m_isLong && !m_calm.listens())
        m_calm.overhear(m_waiting - timeOf(inOnePiece));
    if (!m_ceiling || m_rate < *m_ceiling * nearCeiling) {
        m_rate = std::min(m_rate * quickStep, m_ceiling ? *m_ceiling * margin : most);
        return;
    }
    if (now < m_nextStep || (m_confirmed && now < *m_confirmed))
        return;
    if (m_rate > *m_ceiling * refuted)
        m_confirmed.reset();
    const bool isBelowHighest = m_isLong && m_rate < m_highest * refuted;
    if (isBelowHighest && m_rate >= m_highest * untried)
        m_step = gentle;
    m_rate = std::min(m_rate * (m_confirmed ? gentle : m_step), isBelowHighest ? std::max(m_highest * untried, m_rate * gentle) : most);
    if (m_rate > *m_ceiling && !m_confirmed)
        m_step = std::min(1 + (m_step - 1) * bolder, quickest);
    m_nextStep = m_step < quickest || isSlow() ? now + pauseBetweenSteps() : now;
}

/// True: that is over, or another lane has begun.
bool PathRate::listen(const transport::PathFacts& facts, Instant now)
{
    if (!mayBeUnrest(facts)) {
        m_calm.stop();
        return true;
    }
    switch (m_calm.hear(m_waiting - timeOf(inOnePiece), now)) {
    case PathCalm::Heard::NotAll:
        return false;
    case PathCalm::Heard::Calm:
        m_unrest = Nanoseconds::zero();
        return true;
    case PathCalm::Heard::Doubtful:
        m_rate = std::clamp(m_rate * PathCalm::slower, least, most);
        yield(facts);
        m_calm.begin();
        return false;
    case PathCalm::Heard::Unquiet:
        m_unrest = std::min<Nanoseconds>(m_calm.heard(), mostUnrest);
        m_unrestSeen = now;
        return true;
    }
    return true;
}

/// The path may carry more than was met.
void PathRate::doubtCeiling(Instant now)
{
    m_confirmed.reset();
    m_doubted = true;
    m_nextStep = now;
}

/// A processor that stands still for some milliseconds looks like a path that carries a tenth, and so does a network. One that does shows
/// its queue again within a step or two.
void PathRate::growInDoubt(const transport::PathFacts& facts, Instant now)
{
    if (now < m_nextStep)
        return;
    m_rate = std::min(m_rate * quickest, most);
    m_nextStep = now + pauseInDoubt(facts);
    if (m_rate > *m_ceiling * refuted) {
        // On a short way a step beyond what it carries is seen before it is over, unless a piece takes long.
        m_ceiling = (m_isLong || isSlow()) && m_ceilingBefore && *m_ceilingBefore > m_rate ? m_ceilingBefore : std::nullopt;
        m_doubted = false;
    }
}

/// On a long way a queue shows a round trip later.
PathRate::Nanoseconds PathRate::pauseInDoubt(const transport::PathFacts& facts) const
{
    const auto until = timeToNotice() + (m_isLong ? facts.leastRoundTrip : Nanoseconds::zero());
    return std::max<Nanoseconds>(shortestWindow, until);
}

/// A step too far must show before the next one.
PathRate::Nanoseconds PathRate::pauseBetweenSteps() const { return std::max<Nanoseconds>(gentlePause, timeToNotice()); }

std::optional<double> PathRate::known() const
{
    const double usual = m_rate * m_usualPart;
    if (m_limit && *m_limit < usual)
        return m_limit;
    return m_ceiling ? std::optional(usual) : std::nullopt;
}

} // namespace liena::tasks
