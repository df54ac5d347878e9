// The bulk lanes of one or several sessions in virtual time, each with its kernel, before one bottleneck with a queue.
#pragma once

#include "support/virtual_kernel.hpp"
#include "tasks/fair_share.hpp"
#include "tasks/path_rate.hpp"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>
#include <numeric>
#include <vector>

namespace liena::test {

using namespace std::chrono_literals;

/// A source of frames, a lane as TransmissionTask serves it, and the kernel's view of its path.
class VirtualLane final : public tasks::PathRate::Sender {
public:
    using Nanoseconds = std::chrono::nanoseconds;
    using Instant = tasks::PathRate::Instant;

    /// A frame that is due while the one before still waits is left out.
    struct Stream {
        double frame = 0; ///< bytes
        Nanoseconds period{};
        Nanoseconds begins{};
        std::uint32_t session = 1;
    };

    VirtualLane(Stream stream, Nanoseconds roundTrip, Instant now)
        : m_stream(stream), m_idle(roundTrip), m_smoothed(roundTrip), m_due(now + stream.begins)
    {
        rateChanged();
    }

    void rateChanged() override { m_kernel.pace(rate.rate(), rate.segment()); }

    /// A write after the other, as long as the kernel takes them: of a millisecond, and looked at every five.
    void write(Instant now)
    {
        produce(now);
        while (m_write > 0 || m_waiting > 0) {
            if (m_write <= 0)
                beginWrite(now);
            if (!m_kernel.hasRoom())
                return look(now);
            const double taken = std::min(m_write, 16384.0);
            m_write -= taken;
            m_kernel.take(taken);
        }
        if (m_sending) {
            m_sending = false;
            rate.pause(now, static_cast<std::uint32_t>(m_kernel.unsent()));
            took.push_back(now - m_begun);
        }
    }

    /// Bytes that leave its kernel, within one step.
    double send(Instant now, Nanoseconds step, double atMost)
    {
        const double bytes = m_kernel.send(now, step, atMost);
        m_sent += bytes;
        return bytes;
    }

    /// So many bytes left the bottleneck after so long a wait.
    void carried(double bytes, Nanoseconds waited, Instant now) { m_onItsWay.push_back({now + m_idle, waited, bytes}); }

    void hear(Instant now, Nanoseconds carryingTwoPackets)
    {
        for (; !m_onItsWay.empty() && m_onItsWay.front().known <= now; m_onItsWay.pop_front()) {
            const auto& news = m_onItsWay.front();
            m_acknowledged += news.bytes;
            delivered += news.bytes;
            for (m_unheard += news.bytes; m_unheard >= twoPackets; m_unheard -= twoPackets)
                m_smoothed += ((m_idle + news.waited + carryingTwoPackets) - m_smoothed) / 8;
        }
    }

    void stop()
    {
        m_due = Instant::max();
        m_write = m_waiting = 0;
    }

    /// That so large a part of its frames took at most.
    Nanoseconds tookFor(double part) const
    {
        auto sorted = took;
        std::ranges::sort(sorted);
        return sorted.empty() ? Nanoseconds::zero() : sorted[static_cast<std::size_t>(part * static_cast<double>(sorted.size() - 1))];
    }

    Nanoseconds tookInTheMean() const
    {
        return took.empty() ? Nanoseconds::zero()
                            : std::accumulate(took.begin(), took.end(), Nanoseconds::zero()) / static_cast<int>(took.size());
    }

    static constexpr double twoPackets = 2896; ///< bytes, which are acknowledged at once

    tasks::PathRate rate;
    double delivered = 0;
    std::vector<Nanoseconds> took;

private:
    struct News {
        Instant known;
        Nanoseconds waited{};
        double bytes = 0;
    };

    void produce(Instant now)
    {
        if (now < m_due)
            return;
        m_due += m_stream.period;
        if (m_waiting > 0 || m_write > 0)
            return;
        m_waiting = m_stream.frame;
        m_begun = now;
    }

    void beginWrite(Instant now)
    {
        m_write = std::min(m_waiting, std::clamp(rate.rate() / 1000, static_cast<double>(rate.segment()), 65536.0));
        m_waiting -= m_write;
        m_sending = true;
        observe(now);
    }

    void look(Instant now)
    {
        if (now >= m_look)
            observe(now);
    }

    void observe(Instant now)
    {
        const auto unsent = static_cast<std::uint32_t>(m_kernel.unsent());
        rate.observe({m_smoothed, m_idle, static_cast<std::uint64_t>(m_sent), static_cast<std::uint64_t>(m_acknowledged), {}, unsent}, now,
                     m_waiting > 0);
        rate.endsBurst(m_waiting <= 0);
        rateChanged();
        m_look = now + 5ms;
    }

    Stream m_stream;
    Nanoseconds m_idle;
    Nanoseconds m_smoothed;
    Instant m_due;
    Instant m_begun;
    Instant m_look;
    double m_waiting = 0; ///< of a frame, not yet written
    double m_write = 0;   ///< of the write in hand, not yet in the kernel
    bool m_sending = false;
    VirtualKernel m_kernel;
    double m_sent = 0;
    double m_acknowledged = 0;
    double m_unheard = 0;
    std::deque<News> m_onItsWay;
};

/// A first-in-first-out queue before them all.
class VirtualLanes {
public:
    using Nanoseconds = std::chrono::nanoseconds;

    VirtualLanes(double bytesPerSecond, Nanoseconds roundTrip, const std::vector<VirtualLane::Stream>& streams,
                 const std::shared_ptr<tasks::FairShare>& share = std::make_shared<tasks::FairShare>())
        : capacity(bytesPerSecond)
    {
        for (const auto& stream : streams) {
            m_lanes.push_back(std::make_unique<VirtualLane>(stream, roundTrip, m_now));
            m_lanes.back()->rate.shareWith(share, DeviceId(stream.session));
            m_lanes.back()->rate.serve(*m_lanes.back());
        }
    }

    void run(Nanoseconds time)
    {
        for (const auto end = m_now + time; m_now < end; m_now += step)
            tick();
    }

    void forget()
    {
        m_waits.clear();
        for (auto& lane : m_lanes) {
            lane->delivered = 0;
            lane->took.clear();
        }
    }

    void stop(std::size_t place) { m_lanes[place]->stop(); }
    std::size_t count() const { return m_lanes.size(); }

    /// What it has in the queue is gone, too.
    void close(std::size_t place)
    {
        const auto* lane = m_lanes[place].get();
        std::erase_if(m_chunks, [lane](const Chunk& chunk) { return chunk.lane == lane; });
        m_queue = 0;
        for (const auto& chunk : m_chunks)
            m_queue += chunk.bytes;
        m_lanes.erase(m_lanes.begin() + static_cast<std::ptrdiff_t>(place));
    }

    VirtualLane& lane(std::size_t place) { return *m_lanes[place]; }

    Nanoseconds carrying(double bytes) const
    {
        return std::chrono::duration_cast<Nanoseconds>(std::chrono::duration<double>(bytes / capacity));
    }

    /// Who comes at any time waits for at most this in the queue, in so large a part of the time.
    Nanoseconds waitedFor(double part) const
    {
        auto sorted = m_waits;
        std::ranges::sort(sorted);
        return sorted.empty() ? Nanoseconds::zero() : sorted[static_cast<std::size_t>(part * static_cast<double>(sorted.size() - 1))];
    }

    static constexpr Nanoseconds step = 50us;

    double capacity;
    bool stalled = false;

private:
    struct Chunk {
        VirtualLane* lane;
        double bytes = 0;
        tasks::PathRate::Instant entered;
    };

    void tick()
    {
        const double seconds = std::chrono::duration<double>(step).count();
        const double room = std::max(512e3, capacity * 0.005) - m_queue; // as of a switch
        for (auto& lane : m_lanes) {
            lane->write(m_now);
            enter(*lane, lane->send(m_now, step, std::max(room, 0.0) / static_cast<double>(m_lanes.size())));
        }
        for (double left = stalled ? 0 : capacity * seconds; left > 0 && !m_chunks.empty();)
            left -= carry(left);
        m_waits.push_back(carrying(m_queue));
        for (auto& lane : m_lanes)
            lane->hear(m_now, carrying(VirtualLane::twoPackets));
    }

    void enter(VirtualLane& lane, double bytes)
    {
        if (bytes <= 0)
            return;
        m_queue += bytes;
        m_chunks.push_back({&lane, bytes, m_now});
    }

    double carry(double most)
    {
        auto& chunk = m_chunks.front();
        const double bytes = std::min(most, chunk.bytes);
        chunk.lane->carried(bytes, m_now - chunk.entered, m_now);
        chunk.bytes -= bytes;
        m_queue = std::max(0.0, m_queue - bytes);
        if (chunk.bytes <= 0)
            m_chunks.pop_front();
        return bytes;
    }

    tasks::PathRate::Instant m_now{1h};
    std::vector<std::unique_ptr<VirtualLane>> m_lanes;
    std::deque<Chunk> m_chunks;
    double m_queue = 0;
    std::vector<Nanoseconds> m_waits;
};

} // namespace liena::test
