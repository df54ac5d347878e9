// A switch between TAP devices: implementation.
#include "wire/wire.hpp"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <span>
#include <utility>

namespace liena::lab {

namespace {

constexpr std::size_t longestFrame = 66 * 1024;
constexpr int framesPerTurn = 8; // what is due waits for them
constexpr std::size_t ethernetHeader = 14;

SteadyTime steadyNow() { return std::chrono::steady_clock::now(); }

Protocol protocolOf(std::span<const std::byte> frame)
{
    constexpr std::size_t protocolByte = ethernetHeader + 9;
    const bool ipv4 = frame.size() > protocolByte && frame[12] == std::byte{0x08} && frame[13] == std::byte{0x00};
    if (!ipv4)
        return Protocol::Any; // ARP belongs to neither; only a loss of everything concerns it
    if (frame[protocolByte] == std::byte{6})
        return Protocol::Tcp;
    return frame[protocolByte] == std::byte{17} ? Protocol::Udp : Protocol::Any;
}

/// Nothing for a frame to all or to nobody we know.
std::optional<std::size_t> targetOf(std::span<const std::byte> frame, std::size_t ports)
{
    for (std::size_t port = 0; port < ports; ++port) {
        const auto mac = macOfPort(port);
        if (frame.size() > ethernetHeader && std::memcmp(frame.data(), mac.data(), mac.size()) == 0)
            return port;
    }
    return std::nullopt;
}

void answer(int output, const std::string& text)
{
    const std::string line = std::to_string(steadyNow().time_since_epoch().count()) + " " + text + "\n";
    if (::write(output, line.data(), line.size()) < 0)
        ::_exit(1); // nobody listens any more
}

} // namespace

Wire::Wire(std::vector<Tap> taps, std::uint64_t seed) : m_taps(std::move(taps)), m_ports(m_taps.size()), m_buffer(longestFrame)
{
    const auto count = m_taps.size();
    for (std::size_t i = 0; i < count * count; ++i)
        m_pairs.emplace_back(seed * 1'000'003 + i);
}

void Wire::run(int input, int output)
{
    std::vector<pollfd> watched;
    watched.push_back({input, POLLIN, 0});
    for (const auto& tap : m_taps)
        watched.push_back({tap.descriptor(), POLLIN, 0});
    for (;;) {
        timespec wait{};
        if (!m_waiting.empty()) {
            const auto left = std::max(Nanoseconds::zero(), Nanoseconds(m_waiting.top().due - steadyNow()));
            wait = {left.count() / 1'000'000'000, left.count() % 1'000'000'000};
        }
        ::ppoll(watched.data(), watched.size(), m_waiting.empty() ? nullptr : &wait, nullptr);
        deliverDue(steadyNow());
        for (std::size_t port = 0; port < m_taps.size(); ++port)
            if ((watched[port + 1].revents & POLLIN) != 0)
                readFrames(port);
        if (watched[0].revents != 0 && !readOrders(input, output))
            return;
    }
}

bool Wire::readOrders(int input, int output)
{
    std::array<char, 4096> buffer{};
    const auto count = ::read(input, buffer.data(), buffer.size());
    if (count <= 0)
        return false;
    m_unread.append(buffer.data(), static_cast<std::size_t>(count));
    for (auto end = m_unread.find('\n'); end != std::string::npos; end = m_unread.find('\n')) {
        answer(output, obey(parseWireOrder(std::string_view(m_unread).substr(0, end), m_taps.size())));
        m_unread.erase(0, end + 1);
    }
    return true;
}

std::string Wire::obey(const WireOrder& order)
{
    if (const auto* bad = std::get_if<BadOrder>(&order))
        return "error " + bad->why;
    if (const auto* link = std::get_if<LinkOrder>(&order))
        return obeyLink(*link);
    if (const auto* port = std::get_if<PortOrder>(&order)) {
        m_ports[port->port].rate = port->rate;
        m_ports[port->port].queueLimit = port->queue;
        m_ports[port->port].free = steadyNow();
        return "ok";
    }
    if (const auto* carrier = std::get_if<CarrierOrder>(&order)) {
        m_ports[carrier->port].plugged = carrier->on; // a TAP takes frames without a carrier, a network card does not
        m_taps[carrier->port].setCarrier(carrier->on);
        return "ok";
    }
    if (std::holds_alternative<LateOrder>(order))
        return late();
    return counts();
}

std::string Wire::obeyLink(const LinkOrder& order)
{
    const auto has = [](const std::vector<std::size_t>& ports, std::size_t port) {
        return ports.empty() || std::find(ports.begin(), ports.end(), port) != ports.end();
    };
    for (std::size_t from = 0; from < m_taps.size(); ++from)
        for (std::size_t to = 0; to < m_taps.size(); ++to)
            if (from != to && has(order.from, from) && has(order.to, to)) {
                pair(from, to).impairment = order.impairment;
                pair(from, to).impairment.since = steadyNow();
            }
    return "ok";
}

std::string Wire::counts()
{
    std::uint64_t passed = 0;
    std::uint64_t lost = 0;
    for (auto& pair : m_pairs) {
        passed += std::exchange(pair.passed, 0);
        lost += std::exchange(pair.lost, 0);
    }
    return "ok passed=" + std::to_string(passed) + " lost=" + std::to_string(lost);
}

std::string Wire::late()
{
    const auto milliseconds = [](SteadyTime at) {
        return std::to_string(std::chrono::duration<double, std::milli>(at.time_since_epoch()).count());
    };
    std::string text = "ok";
    for (const auto& span : m_late.take())
        text += ' ' + milliseconds(span.begin) + '-' + milliseconds(span.end);
    return text;
}

void Wire::readFrames(std::size_t port)
{
    for (int i = 0; i < framesPerTurn; ++i) {
        const auto size = m_taps[port].read(m_buffer);
        if (size == 0)
            return;
        const auto frame = std::make_shared<std::vector<std::byte>>(m_buffer.begin(), m_buffer.begin() + static_cast<std::ptrdiff_t>(size));
        const auto bare = std::span<const std::byte>(*frame).subspan(std::min(size, m_taps[port].prefix()));
        const auto protocol = protocolOf(bare);
        const auto target = targetOf(bare, m_taps.size());
        const auto now = steadyNow();
        for (std::size_t to = 0; to < m_taps.size(); ++to)
            if (to != port && (!target || *target == to))
                forward(port, to, frame, protocol, now);
    }
}

void Wire::forward(std::size_t from, std::size_t to, const Frame& frame, Protocol protocol, SteadyTime now)
{
    Pair& way = pair(from, to);
    const auto decision = way.draw.decide(way.impairment, protocol, frame->size(), now);
    if (decision.drop || !m_ports[from].plugged || !m_ports[to].plugged) {
        ++way.lost;
        return;
    }
    ++way.passed;
    Frame sent = frame;
    if (decision.turnedBit) {
        sent = std::make_shared<std::vector<std::byte>>(*frame);
        (*sent)[*decision.turnedBit / 8] ^= std::byte{1} << (*decision.turnedBit % 8);
    }
    auto due = now + decision.delay;
    if (!decision.overtaken)
        way.lastDue = due = std::max(due, way.lastDue);
    for (int copy = 0; copy < (decision.duplicate ? 2 : 1); ++copy) {
        if (due <= now)
            enqueue(to, sent, now);
        else
            m_waiting.push({due, m_order++, to, false, sent});
    }
}

void Wire::enqueue(std::size_t to, const Frame& frame, SteadyTime now)
{
    Port& port = m_ports[to];
    if (!port.plugged)
        return;
    if (port.rate == 0)
        return m_taps[to].write(*frame);
    if (port.queued + frame->size() > port.queueLimit)
        return;
    const auto onTheCable = lengthOnTheCable(*frame, m_taps[to].prefix());
    const auto length = Nanoseconds(static_cast<std::int64_t>(static_cast<double>(onTheCable) * 8e9 / static_cast<double>(port.rate)));
    port.free = std::max(port.free, now) + length;
    port.queued += frame->size();
    m_waiting.push({port.free, m_order++, to, true, frame});
}

void Wire::deliverDue(SteadyTime now)
{
    while (!m_waiting.empty() && m_waiting.top().due <= now) {
        const Waiting next = m_waiting.top();
        m_waiting.pop();
        if (!next.leaving) {
            enqueue(next.port, next.frame, next.due); // as the line would, however late this program is
            continue;
        }
        m_late.note(next.due, steadyNow());
        m_ports[next.port].queued -= next.frame->size();
        if (m_ports[next.port].plugged)
            m_taps[next.port].write(*next.frame);
    }
}

} // namespace liena::lab
