// Packets, their repair, and what the two ends are told.
#include "connection.hpp"

#include <algorithm>
#include <utility>

namespace liena::simulation {

using namespace std::chrono_literals;

namespace {

constexpr std::size_t largestPacket = 14480;
constexpr std::size_t windowBuffers = 4; ///< what may be on the way, in send buffers
constexpr std::size_t tidyAbove = 64 << 10;
constexpr auto firstTimeout = 200ms;
constexpr int mostDoublings = 3;
constexpr auto lingering = 20s; ///< how long an end that closed still tries to deliver

} // namespace

Connection::Connection(Network& network, ConnectionNumber number, HostIndex maker, HostIndex acceptor, SeededRandom random)
    : m_network(network), m_number(number), m_random(random)
{
    m_maker.host = maker;
    m_acceptor.host = acceptor;
    const auto draw = m_random.below(10);
    m_chunks = draw < 5 ? Chunks::Whole : draw < 8 ? Chunks::Mixed : Chunks::Small;
}

bool Connection::write(std::span<const std::byte> bytes)
{
    if (m_maker.closed || m_maker.told)
        return true;
    m_stream.insert(m_stream.end(), bytes.begin(), bytes.end());
    pump();
    m_writerWaits = m_stream.size() - m_sentBytes > m_network.sendBuffer();
    return !m_writerWaits;
}

void Connection::pump()
{
    while (m_sentBytes < m_stream.size() && m_sentBytes - m_readBytes < windowBuffers * m_network.sendBuffer()) {
        const auto size = std::min(m_stream.size() - m_sentBytes, largestPacket);
        m_sentBytes += size;
        add({size, 0, false, false, false});
    }
    if (m_writerWaits && m_stream.size() - m_sentBytes <= m_network.sendBuffer()) {
        m_writerWaits = false;
        m_network.programs().whenRunning(m_maker.host, [network = &m_network, number = m_number] {
            if (auto* self = network->find(number); self != nullptr && self->m_maker.listener != nullptr)
                self->m_maker.listener->bytesWritten();
        });
    }
}

void Connection::add(Packet packet)
{
    m_packets.push_back(packet);
    transmit(m_firstPacket + m_packets.size() - 1);
}

Connection::Packet* Connection::packet(std::uint64_t id)
{
    return id >= m_firstPacket && id < m_firstPacket + m_packets.size() ? &m_packets[id - m_firstPacket] : nullptr;
}

void Connection::transmit(std::uint64_t id)
{
    auto& sent = *packet(id);
    const auto tries = ++sent.tries;
    const bool swallowed = sent.ends && m_network.path(m_maker.host, m_acceptor.host).keepsEnds;
    const auto arrives = swallowed ? std::nullopt : m_network.arrival(m_maker.host, m_acceptor.host, sent.bytes);
    sent.lost = !arrives;
    if (arrives)
        return m_network.time().at(*arrives, [network = &m_network, number = m_number, id] {
            if (auto* self = network->find(number))
                self->arrived(id);
        });
    retryLater(id, tries, firstTimeout * (1 << std::min(tries - 1, mostDoublings)));
}

void Connection::retryLater(std::uint64_t id, int tries, Nanoseconds wait)
{
    m_network.time().after(wait, [network = &m_network, number = m_number, id, tries] {
        if (auto* self = network->find(number))
            self->retry(id, tries);
    });
}

void Connection::retry(std::uint64_t id, int tries)
{
    const auto* lost = packet(id);
    if (lost != nullptr && !lost->arrived && lost->tries == tries && !m_maker.told)
        transmit(id);
}

void Connection::arrived(std::uint64_t id)
{
    auto* came = packet(id);
    if (came == nullptr || came->arrived)
        return;
    if (m_network.isCut(m_maker.host, m_acceptor.host) || m_network.programs().reception(m_acceptor.host) == Reception::Silent) {
        came->lost = true;
        return retryLater(id, came->tries, firstTimeout * (1 << std::min(came->tries - 1, mostDoublings)));
    }
    if (m_acceptor.closed)
        return tellAcross(m_acceptor, m_maker, "connection reset by the peer");
    came->arrived = true;
    repairAround(id);
    while (!m_packets.empty() && m_packets.front().arrived) {
        m_arrivedBytes += m_packets.front().bytes;
        m_endArrived = m_endArrived || m_packets.front().ends;
        m_packets.pop_front();
        ++m_firstPacket;
    }
    deliver();
}

/// The acknowledgement of a later packet shows the gap, once; that of a packet which was sent again shows every gap.
void Connection::repairAround(std::uint64_t id)
{
    if (m_network.isCut(m_acceptor.host, m_maker.host))
        return;
    const bool again = packet(id)->tries > 1;
    const auto end = again ? m_firstPacket + m_packets.size() : id;
    for (auto missing = m_firstPacket; missing < end; ++missing) {
        const auto* candidate = packet(missing);
        if (!candidate->arrived && candidate->lost && (again || candidate->tries == 1))
            retryLater(missing, candidate->tries, m_network.path(m_acceptor.host, m_maker.host).delay);
    }
}

void Connection::read(std::span<std::byte> where)
{
    m_where = where;
    m_reading = true;
    deliver();
}

void Connection::deliver()
{
    if (m_delivering || m_acceptor.closed)
        return;
    m_network.programs().whenRunning(m_acceptor.host, [network = &m_network, number = m_number] {
        auto* self = network->find(number);
        if (self == nullptr || self->m_delivering)
            return;
        self->m_delivering = true;
        while (self->deliverOnce()) {
        }
        self->m_delivering = false;
    });
}

bool Connection::deliverOnce()
{
    if (!m_reading || m_acceptor.closed || m_acceptor.listener == nullptr)
        return false;
    if (m_heldUntil > m_network.time().now())
        return false; // holdReading() set the alarm
    const auto available = m_arrivedBytes - m_readBytes;
    if (available == 0) {
        if (m_endArrived)
            tellOver(m_acceptor, "closed by the peer");
        return false;
    }
    auto size = std::min(available, m_where.size());
    if (m_chunks != Chunks::Whole && size > 1)
        size = m_random.between(1, m_chunks == Chunks::Small ? std::min<std::size_t>(size, 24) : size);
    std::copy_n(m_stream.begin() + static_cast<std::ptrdiff_t>(m_readBytes), size, m_where.begin());
    m_readBytes += size;
    m_reading = false;
    if (m_readBytes > tidyAbove || m_readBytes == m_stream.size()) {
        m_stream.erase(m_stream.begin(), m_stream.begin() + static_cast<std::ptrdiff_t>(m_readBytes));
        m_sentBytes -= m_readBytes;
        m_arrivedBytes -= m_readBytes;
        m_readBytes = 0;
    }
    pump();
    m_acceptor.listener->bytesRead(size);
    // Now and then the rest comes a moment later, with other things in between.
    if (m_chunks != Chunks::Whole && m_random.chance(20'000))
        holdReading(m_network.time().now() + m_random.between(Nanoseconds(10us), Nanoseconds(3ms)));
    return true;
}

void Connection::holdReading(Instant until)
{
    m_heldUntil = std::max(m_heldUntil, until);
    m_network.time().at(until, [network = &m_network, number = m_number] {
        if (auto* self = network->find(number))
            self->deliver();
    });
}

void Connection::close(HostIndex end)
{
    auto& mine = endOf(end);
    mine.listener = nullptr;
    if (mine.closed)
        return;
    mine.closed = true;
    if (&mine == &m_acceptor)
        tellAcross(m_acceptor, m_maker, "connection reset by the peer");
    else if (!m_maker.told)
        add({0, 0, false, false, true});
    released();
}

void Connection::programEnded(HostIndex end, bool tells)
{
    auto& mine = endOf(end);
    if (tells)
        return close(end);
    mine.listener = nullptr;
    mine.closed = true;
    if (&mine == &m_maker)
        mine.told = true; // nothing is sent again
    released();
}

void Connection::reset()
{
    tellOver(m_maker, "connection reset");
    tellOver(m_acceptor, "connection reset");
}

void Connection::tellAcross(End& from, End& to, const char* detail)
{
    if (to.told || m_network.path(from.host, to.host).keepsEnds)
        return;
    if (const auto arrives = m_network.arrival(from.host, to.host, 60))
        m_network.time().at(*arrives, [network = &m_network, number = m_number, host = to.host, detail] {
            if (auto* self = network->find(number))
                self->tellOver(self->endOf(host), detail);
        });
}

void Connection::tellOver(End& end, const char* detail)
{
    if (std::exchange(end.told, true) || end.closed)
        return;
    end.detail = detail;
    speak(end.host);
}

void Connection::speak(HostIndex host)
{
    m_network.programs().whenRunning(host, [network = &m_network, number = m_number, host] {
        auto* self = network->find(number);
        if (self == nullptr)
            return;
        auto& mine = self->endOf(host);
        if (auto* listener = std::exchange(mine.listener, nullptr)) {
            mine.closed = true;
            self->released();
            listener->connectionLost(mine.detail);
        }
    });
}

void Connection::setListener(HostIndex end, Listener* listener)
{
    auto& mine = endOf(end);
    mine.listener = listener;
    if (listener != nullptr && mine.told && !mine.closed)
        m_network.time().after(0ns, [network = &m_network, number = m_number, end] {
            if (auto* self = network->find(number))
                self->speak(end);
        });
}

void Connection::released()
{
    if (m_maker.closed && m_acceptor.closed)
        m_network.forgetLater(m_number);
    else if (m_maker.closed)
        m_network.time().after(lingering, [network = &m_network, number = m_number] {
            if (auto* self = network->find(number); self != nullptr)
                self->tellOver(self->m_acceptor, "the peer went away long ago");
        });
}

} // namespace liena::simulation
