// The unreliable path beside lane 0, as one session sees it: numbers its packets, and takes each number once (protocol section 6).
#pragma once

#include "virtual_time.hpp"

#include <bitset>
#include <cstdint>
#include <cstring>
#include <deque>
#include <optional>
#include <span>
#include <vector>

namespace liena::simulation {

class DatagramPath {
public:
    static constexpr std::size_t prefix = 16;

    /// A new session: both ends count from the start.
    void begin(std::uint64_t token)
    {
        *this = DatagramPath();
        m_token = token;
    }

    std::uint64_t token() const { return m_token; }

    std::vector<std::byte> packet(std::span<const std::byte> datagram)
    {
        std::vector<std::byte> bytes(prefix + datagram.size());
        const auto number = ++m_sent;
        std::memcpy(bytes.data(), &m_token, sizeof m_token);
        std::memcpy(bytes.data() + 8, &number, sizeof number);
        std::memcpy(bytes.data() + prefix, datagram.data(), datagram.size());
        return bytes;
    }

    static std::uint64_t tokenOf(std::span<const std::byte> packet) { return word(packet, 0); }

    /// The datagram of a packet of this session that did not come before.
    std::optional<std::span<const std::byte>> open(std::span<const std::byte> packet, Instant now, Nanoseconds heartbeat)
    {
        if (packet.size() < prefix || word(packet, 0) != m_token || m_token == 0 || !isNew(word(packet, 8)))
            return std::nullopt;
        m_arrivals.push_back(now);
        forget(now, heartbeat);
        return packet.subspan(prefix);
    }

    /// For our heartbeats: packets of the peer in the last 8 periods.
    std::uint8_t heard(Instant now, Nanoseconds heartbeat)
    {
        forget(now, heartbeat);
        return static_cast<std::uint8_t>(std::min<std::size_t>(m_arrivals.size(), 255));
    }

    /// What the peer's newest heartbeat says of the way there.
    void peerHears(std::uint8_t count) { m_works = count > 0; }
    bool works() const { return m_works; }

private:
    static constexpr std::size_t window = 1024;

    static std::uint64_t word(std::span<const std::byte> packet, std::size_t at)
    {
        std::uint64_t value = 0;
        std::memcpy(&value, packet.data() + at, sizeof value);
        return value;
    }

    bool isNew(std::uint64_t number)
    {
        if (number == 0 || number + window <= m_newest)
            return false;
        if (number > m_newest) {
            for (auto between = m_newest + 1; between <= number && between <= m_newest + window; ++between)
                m_seen.reset(between % window);
            m_newest = number;
        } else if (m_seen.test(number % window)) {
            return false;
        }
        m_seen.set(number % window);
        return true;
    }

    void forget(Instant now, Nanoseconds heartbeat)
    {
        while (!m_arrivals.empty() && m_arrivals.front() + 8 * heartbeat < now)
            m_arrivals.pop_front();
    }

    std::uint64_t m_token = 0;
    std::uint64_t m_sent = 0;
    std::uint64_t m_newest = 0;
    std::bitset<window> m_seen;
    std::deque<Instant> m_arrivals;
    bool m_works = false;
};

} // namespace liena::simulation
