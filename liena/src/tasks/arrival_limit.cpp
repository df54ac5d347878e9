// Queues that only the other end can see.
#include "tasks/arrival_limit.hpp"

#include "tasks/path_rate.hpp"

#include <algorithm>
#include <functional>
#include <numeric>
#include <utility>

namespace liena::tasks {

using namespace std::chrono_literals;

namespace {

constexpr std::size_t remembered = 150; // reports: half a minute of them
constexpr std::ptrdiff_t recent = 5;    // a second
constexpr auto proof = 500ms;           // that a queue stands before its arrivals tell what the way carries
constexpr double tolerated = 0.1;       // seconds of waiting
constexpr double lost = 0.25;           // of the packets, at most
constexpr auto nearby = 20ms;           // a round trip on which next to nothing is on its way
constexpr double drained = 0.02;        // seconds of waiting that are left when a queue counts as gone
constexpr double draining = 0.5;        // of what the way carries, until then
constexpr double margin = 0.95;         // of it, from then on
constexpr int gently = 15;              // the first reports without a queue
constexpr double gentle = 1.01;         // a step in them
constexpr double bolder = 1.5;          // each one beyond
constexpr double quickest = 1.1;

double secondsOf(std::chrono::nanoseconds time) { return std::chrono::duration<double>(time).count(); }

} // namespace

void ArrivalLimit::reported(const Report& report)
{
    if (report.window <= Nanoseconds::zero())
        return;
    // Without sign: a peer may report what it likes.
    const auto sent = report.sent - std::exchange(m_sent, report.sent);
    m_under = static_cast<std::int64_t>(static_cast<std::uint64_t>(m_under) + sent - report.received);
    const auto packets = report.packets - std::exchange(m_sentInPackets, report.packets);
    m_arrivals.push_back({m_under, report.received, sent, packets, report.window});
    if (m_arrivals.size() > remembered)
        m_arrivals.pop_front();
    const auto least = std::ranges::min_element(m_arrivals, {}, &Arrival::under)->under;
    m_waiting = static_cast<std::uint64_t>(m_under) - static_cast<std::uint64_t>(least);

    const auto rate = recentRate();
    // Whole messages are counted, and one may be under way at either end of what the kernel holds.
    const auto onItsWay = report.held + 2 * report.largest + (report.roundTrip > nearby ? sentWithin(report.roundTrip) : 0);
    const double queue = static_cast<double>(m_waiting) - static_cast<double>(onItsWay) - lost * static_cast<double>(sentInPackets());
    if (queue > tolerated * rate)
        return meetQueue(report, rate);
    m_full.reset();
    if (m_draining)
        m_draining = queue > drained * rate;
    else if (m_carried)
        grow();
}

void ArrivalLimit::forgetWaiting()
{
    m_arrivals.clear();
    m_waiting = 0;
    m_full.reset();
}

double ArrivalLimit::recentRate() const
{
    std::uint64_t bytes = 0;
    Nanoseconds time{};
    for (auto at = m_arrivals.end() - std::min(recent, std::ssize(m_arrivals)); at != m_arrivals.end(); ++at) {
        bytes += at->received;
        time += at->window;
    }
    return static_cast<double>(bytes) / secondsOf(time);
}

/// Of the last windows that together are that long.
std::uint64_t ArrivalLimit::sentWithin(Nanoseconds time) const
{
    std::uint64_t bytes = 0;
    for (auto at = m_arrivals.rbegin(); at != m_arrivals.rend() && time > Nanoseconds::zero(); ++at) {
        bytes += at->sent;
        time -= at->window;
    }
    return bytes;
}

/// Since the first of the reports that the least of what was under way is known from.
std::uint64_t ArrivalLimit::sentInPackets() const
{
    return std::transform_reduce(m_arrivals.begin() + 1, m_arrivals.end(), std::uint64_t{0}, std::plus{}, std::mem_fn(&Arrival::packets));
}

void ArrivalLimit::meetQueue(const Report& report, double rate)
{
    if (m_carried && !std::exchange(m_draining, true)) {
        m_carried = std::clamp(std::min(*m_carried, rate), PathRate::least, PathRate::most);
        m_calm = 0;
    }
    if (!m_full) {
        m_full = Full();
        return;
    }
    m_full->received += report.received;
    m_full->time += report.window;
    if (m_full->time < proof)
        return;
    m_carried = std::clamp(static_cast<double>(m_full->received) / secondsOf(m_full->time), PathRate::least, PathRate::most);
    m_draining = true;
    m_calm = 0;
    m_full = Full();
}

void ArrivalLimit::grow()
{
    m_step = ++m_calm <= gently ? gentle : std::min(1 + (m_step - 1) * bolder, quickest);
    *m_carried *= m_step;
    if (*m_carried >= PathRate::most)
        m_carried.reset();
}

std::optional<double> ArrivalLimit::bytesPerSecond() const
{
    if (!m_carried)
        return std::nullopt;
    return std::max(*m_carried * (m_draining ? draining : margin), PathRate::least);
}

} // namespace liena::tasks
