// Whether a queue is no more than what a standstill left.
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <optional>
#include <utility>

namespace liena::tasks {

/// Pure. A computer or a network that stands still for some milliseconds leaves a queue, and as little has come meanwhile as on a path that
/// fell. But that queue is there at once, at a rate that had passed for a while, and drains about as fast as that, once hardly anything is
/// sent. A rate that is too high makes one that grows; behind a path that fell deep none drains so fast, and behind one that fell less
/// another stands soon after. So it is looked at a second time before anything is concluded from it.
class SecondLook {
public:
    using Instant = std::chrono::steady_clock::time_point;
    using Nanoseconds = std::chrono::nanoseconds;

    struct Seen {
        Instant at;
        double rate = 0;     ///< bytes per second
        double underWay = 0; ///< bytes
        Nanoseconds waiting{};
    };

    void forget() { *this = {}; }

    /// Nothing is sent from now on: no time in which a rate passes.
    void pause(Instant now)
    {
        if (!m_paused)
            m_paused = now;
    }
    void resume(Instant now)
    {
        if (m_paused)
            m_since += now - *std::exchange(m_paused, std::nullopt);
    }

    /// Enough was delivered, and no queue met: one that was looked at is gone.
    void passed(double rate, Nanoseconds waiting, Instant now)
    {
        if (rate > m_rate * hardlyMore) {
            m_rate = rate;
            m_since = now;
        }
        m_rate = std::max(m_rate, rate);
        m_waited = {waiting, m_waited[0]};
        m_first.reset();
    }

    /// A queue is met: whether it is looked at again, since it came `atOnce`, at a rate that had passed for `longEnough`, pauses left out.
    bool begins(const Seen& seen, Nanoseconds atOnce, Nanoseconds longEnough)
    {
        if (seen.rate > m_rate * hardlyMore || seen.at - m_since < longEnough || seen.waiting - std::min(m_waited[0], m_waited[1]) < atOnce)
            return false;
        m_first = seen;
        return true;
    }

    /// What was met longer ago than that is another matter.
    bool isOn(Instant now) const { return m_first && now - m_first->at < longest; }

    /// It is met still, or again after a pause: whether it drains as one does that a standstill left, or it is only the smoothed round trip
    /// that tells of it still. If not, this look is over, and it is none.
    bool goesOn(const Seen& seen)
    {
        const std::chrono::duration<double> since = seen.at - m_first->at;
        if (seen.waiting < m_first->waiting * sameQueue || seen.underWay < m_first->underWay - m_first->rate * slowest * since.count())
            return true;
        m_first.reset();
        return false;
    }

    /// It is gone. What comes within as long again, or before the rate has passed for long enough, was not left by a standstill.
    void drained(Instant now)
    {
        m_since = now + (now - m_first->at);
        m_drainedFrom = m_first->underWay;
        m_first.reset();
    }

    /// So many bytes had been under way when the last queue was met that drained; nothing: none did since the last fall.
    std::optional<double> drainedFrom() const { return m_drainedFrom; }
    void stop() { m_first.reset(); }

private:
    static constexpr double hardlyMore = 1.03; // than a rate that passed
    static constexpr double slowest = 0.25;    // of the rate
    static constexpr double sameQueue = 0.8;   // of what waited first; less is the smoothed round trip, which forgets slowly
    static constexpr Nanoseconds longest = std::chrono::seconds(2);

    double m_rate = 0; ///< the highest that passed since the last fall
    Instant m_since{}; ///< it or hardly less does so
    std::array<Nanoseconds, 2> m_waited{};
    std::optional<Instant> m_paused;
    std::optional<Seen> m_first;
    std::optional<double> m_drainedFrom;
};

} // namespace liena::tasks
