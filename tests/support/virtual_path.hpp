// A path in virtual time: a bottleneck with a queue before it.
#pragma once

#include "support/virtual_kernel.hpp"
#include "tasks/path_rate.hpp"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <deque>
#include <limits>
#include <random>
#include <utility>

namespace liena::test {

using namespace std::chrono_literals;

/// A sender, its kernel at the rate's pace, a bottleneck, and the kernel's smoothed view of the round trip.
class VirtualPath {
public:
    using Nanoseconds = std::chrono::nanoseconds;

    VirtualPath(double bytesPerSecond, Nanoseconds idleRoundTrip)
        : capacity(bytesPerSecond), m_idle(idleRoundTrip), m_smoothed(idleRoundTrip)
    {
        m_kernel.pace(rate.rate(), rate.segment());
    }

    /// There is always more to send, or nothing.
    void run(Nanoseconds time, bool busy = true)
    {
        m_toWrite = busy ? std::numeric_limits<double>::infinity() : 0;
        goOn(time);
    }

    /// So many bytes more are to be sent.
    void give(double bytes) { m_toWrite += bytes; }

    /// With what there is to send.
    void goOn(Nanoseconds time)
    {
        for (const auto end = m_now + time; m_now < end; m_now += step)
            tick();
    }

    double unwritten() const { return m_toWrite; }                  ///< bytes that the kernel does not have yet
    double unsent() const { return m_toWrite + m_kernel.unsent(); } ///< and those that it has
    void drop() { m_toWrite = 0; }                                  ///< what the kernel does not have yet

    /// So many bytes, each so often; what has not left by then is left out. How long they took to leave.
    Nanoseconds frame(double bytes, Nanoseconds period)
    {
        const auto begun = m_now;
        drop();
        give(bytes);
        while (unsent() > 0 && m_now < begun + period)
            goOn(step);
        const auto took = m_now - begun;
        drop();
        goOn(period - took);
        return took;
    }

    /// The sender's computer does nothing for so long: it sends nothing, and what comes meanwhile is late by what is left of it.
    void standStill(Nanoseconds time)
    {
        const auto until = m_now + time;
        for (; m_now < until; m_now += step) {
            const double carried = std::min(m_queue, capacity * std::chrono::duration<double>(step).count());
            m_queue -= carried;
            leave(carried, Nanoseconds::zero());
        }
        for (auto& news : m_onItsWay) {
            news.waiting += std::max(until - news.known, Nanoseconds::zero());
            news.known = std::max(news.known, until);
        }
    }

    /// The receiver's computer, or the way back, does nothing for so long: what comes meanwhile is acknowledged then.
    void deafen(Nanoseconds time) { m_heardFrom = m_now + time; }

    /// What was carried a round trip ago is known now.
    void acknowledge()
    {
        for (; !m_onItsWay.empty() && m_onItsWay.front().known <= m_now; m_onItsWay.pop_front()) {
            const auto& news = m_onItsWay.front();
            if (news.bytes <= 0)
                continue;
            m_delivered += news.bytes;
            m_window += news.bytes; // slow start
            // An eighth for each acknowledgement, which comes for two packets: on a slow path that takes its time.
            for (m_unacknowledged += news.bytes; m_unacknowledged >= acknowledged; m_unacknowledged -= acknowledged)
                m_smoothed += ((m_idle + news.waiting + unrest()) - m_smoothed) / 8;
        }
    }

    /// As on a wireless or a busy way: what overtakes nothing is late together.
    Nanoseconds unrest()
    {
        if (mostUnrest <= Nanoseconds::zero())
            return Nanoseconds::zero();
        if (m_sinceUnrest++ % lateTogether == 0)
            m_unrest = Nanoseconds(static_cast<Nanoseconds::rep>(random() % static_cast<std::uint64_t>(mostUnrest.count())));
        return m_unrest;
    }

    void forget()
    {
        longestWait = late = veryLate = Nanoseconds::zero();
        m_sent = 0;
    }
    Nanoseconds carrying(double bytes) const
    {
        return std::chrono::duration_cast<Nanoseconds>(std::chrono::duration<double>(bytes / capacity));
    }
    Nanoseconds waiting() const { return carrying(m_queue); }
    double sent() const { return m_sent; }

    /// Another route from now on; the kernel remembers the shortest.
    void reroute(Nanoseconds idleRoundTrip) { m_idle = idleRoundTrip; }

    /// As a new connection.
    void startSlowly() { m_window = 14'600; }

    /// A new connection, of another way perhaps: nothing is under way, and its kernel remembers nothing.
    void reconnect(Nanoseconds idleRoundTrip)
    {
        rate.restart();
        m_isWriting = false;
        m_kernel = {};
        m_kernel.pace(rate.rate(), rate.segment());
        m_entered = m_left = m_delivered = m_queue = m_tokens = m_unacknowledged = 0;
        m_entries.clear();
        m_onItsWay.clear();
        m_smoothed = m_shortest = m_idle = idleRoundTrip;
    }

    tasks::PathRate rate;
    double capacity;
    double bucket = 0; ///< bytes that pass at once, as those of a policer do, where less passed before
    bool stalled = false;
    bool receiverLimits = false;
    Nanoseconds mostUnrest{};  ///< so much later may acknowledgements come, whatever is sent
    unsigned lateTogether = 1; ///< so many of them by the same
    std::mt19937_64 random{1}; ///< of the unrest
    Nanoseconds tooLong = 2ms;
    Nanoseconds muchTooLong = 10ms;
    Nanoseconds longestWait{};
    Nanoseconds late{};     ///< time in which what entered had to wait too long
    Nanoseconds veryLate{}; ///< and much too long

private:
    void tick()
    {
        const double seconds = std::chrono::duration<double>(step).count();
        write();
        const double offered = m_kernel.send(m_now, step, std::max(m_window - (m_entered - m_delivered), 0.0));
        const double carried = stalled ? 0 : std::min(m_queue + offered, capacity * seconds + m_tokens);
        m_tokens = std::clamp(m_tokens + capacity * seconds - carried, 0.0, bucket);
        const double taken = std::min(offered, deepest() + carried - m_queue);
        m_queue += taken - carried;
        m_entered += taken;
        m_entries.push_back({m_now, m_entered});
        leave(carried, m_tokens > 0 ? Nanoseconds::zero() : carrying(acknowledged));
        acknowledge();
        m_sent += offered;
        longestWait = std::max(longestWait, waiting());
        late += waiting() > tooLong ? step : Nanoseconds::zero();
        veryLate += waiting() > muchTooLong ? step : Nanoseconds::zero();
    }

    /// As TransmissionTask does: a millisecond's at a time, as long as the kernel takes it. It looks at the path before each, and while one
    /// lasts for longer than 5 ms.
    void write()
    {
        if (m_toWrite > 0 && receiverLimits)
            m_closed += step;
        if (m_isWriting && m_now - m_looked >= 5ms)
            observe();
        while (m_toWrite > 0 && m_kernel.hasRoom()) {
            m_isWriting = true;
            observe();
            const double bytes = std::min(m_toWrite, std::max(rate.rate() / 1000, static_cast<double>(rate.segment())));
            m_toWrite -= bytes;
            rate.endsBurst(m_toWrite <= 0);
            m_kernel.pace(rate.rate(), rate.segment());
            m_kernel.take(bytes);
        }
        if (m_toWrite <= 0 && std::exchange(m_isWriting, false))
            rate.pause(m_now, static_cast<std::uint32_t>(m_kernel.unsent()));
    }

    void observe()
    {
        m_looked = m_now;
        m_shortest = std::min(m_shortest, m_idle);
        rate.observe({m_smoothed, m_shortest, static_cast<std::uint64_t>(m_entered), static_cast<std::uint64_t>(m_delivered), m_closed,
                      static_cast<std::uint32_t>(m_kernel.unsent())},
                     m_now);
        m_kernel.pace(rate.rate(), rate.segment());
    }

    struct News {
        tasks::PathRate::Instant known;
        Nanoseconds waiting{};
        double bytes = 0;
    };

    /// So much in this step, besides what the piece itself takes.
    void leave(double carried, Nanoseconds piece)
    {
        m_left += carried;
        while (m_entries.size() > 1 && m_entries.front().total < m_left)
            m_entries.pop_front();
        const auto delay = std::max(m_heardFrom - m_now, Nanoseconds::zero());
        m_onItsWay.push_back({m_now + m_idle + delay, m_now - m_entries.front().at + piece + delay, carried});
    }

    /// A switch has half a megabyte or so, a faster one more.
    double deepest() const { return std::max(512e3, capacity * 0.005); }

    struct Entry {
        tasks::PathRate::Instant at;
        double total = 0;
    };

    static constexpr Nanoseconds step = 250us;
    static constexpr double acknowledged = 2896; ///< bytes, at once

    Nanoseconds m_idle;
    Nanoseconds m_shortest = m_idle; ///< as the kernel remembers it
    Nanoseconds m_smoothed;
    tasks::PathRate::Instant m_now{1h};
    tasks::PathRate::Instant m_looked{};
    double m_toWrite = 0; ///< of what is to be sent, what the kernel has not yet
    bool m_isWriting = false;
    VirtualKernel m_kernel;
    double m_queue = 0;
    double m_tokens = 0;
    double m_entered = 0;
    double m_left = 0;
    std::deque<Entry> m_entries; ///< of what waits: since when
    double m_delivered = 0;
    tasks::PathRate::Instant m_heardFrom{}; ///< by the receiver
    double m_window = 1e12;                 ///< bytes that TCP lets be under way
    double m_unacknowledged = 0;
    std::deque<News> m_onItsWay;
    double m_sent = 0;
    Nanoseconds m_closed{};
    Nanoseconds m_unrest{};
    unsigned m_sinceUnrest = 0;
};

} // namespace liena::test
