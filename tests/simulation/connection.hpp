// One TCP connection as its two ends see it: bytes from its maker to its acceptor, in order, in chunks, late, or never.
#pragma once

#include "network.hpp"

#include <deque>

namespace liena::simulation {

/// A lost packet holds back everything after it: it is sent again when a later one arrives, or after TCP's time-out, which doubles. An end
/// that closed answers what still comes with a reset. What an end is told waits while its program does not run.
class Connection {
public:
    class Listener {
    public:
        virtual ~Listener() = default;
        virtual void bytesRead(std::size_t count) = 0;
        virtual void bytesWritten() = 0;
        virtual void connectionLost(const char* detail) = 0;
    };

    Connection(Network& network, ConnectionNumber number, HostIndex maker, HostIndex acceptor, SeededRandom random);

    HostIndex maker() const { return m_maker.host; }
    HostIndex acceptor() const { return m_acceptor.host; }

    /// Who comes late is still told how it ended.
    void setListener(HostIndex end, Listener* listener);

    /// The maker's: false when the send buffer is full now; bytesWritten() follows then.
    bool write(std::span<const std::byte> bytes);

    /// The acceptor's: one bytesRead() follows, of 1 byte to all of `where`.
    void read(std::span<std::byte> where);

    /// The maker's bytes still arrive; what the acceptor closes is gone at once.
    void close(HostIndex end);

    void programEnded(HostIndex end, bool tells);
    void reset();
    void holdReading(Instant until);

private:
    struct End {
        HostIndex host = 0;
        Listener* listener = nullptr;
        bool closed = false;
        bool told = false; ///< that it is over
        const char* detail = "";
    };
    struct Packet {
        std::size_t bytes = 0;
        int tries = 0;
        bool arrived = false;
        bool lost = false; ///< as it was sent last
        bool ends = false;
    };
    enum class Chunks : std::uint8_t { Whole, Mixed, Small };

    End& endOf(HostIndex host) { return host == m_maker.host ? m_maker : m_acceptor; }
    void pump();
    void add(Packet packet);
    void transmit(std::uint64_t id);
    void retry(std::uint64_t id, int tries);
    void retryLater(std::uint64_t id, int tries, Nanoseconds wait);
    void arrived(std::uint64_t id);
    void repairAround(std::uint64_t id);
    void deliver();
    bool deliverOnce();
    void tellOver(End& end, const char* detail);
    void speak(HostIndex host);
    void tellAcross(End& from, End& to, const char* detail);
    void released();
    Packet* packet(std::uint64_t id);

    Network& m_network;
    ConnectionNumber m_number;
    End m_maker;
    End m_acceptor;
    SeededRandom m_random;
    Chunks m_chunks;

    std::vector<std::byte> m_stream; ///< from the first byte that was not read
    std::size_t m_readBytes = 0;     ///< of m_stream
    std::size_t m_sentBytes = 0;     ///< of m_stream: in packets
    std::size_t m_arrivedBytes = 0;  ///< of m_stream: without a gap
    std::deque<Packet> m_packets;    ///< from the first that did not arrive without a gap
    std::uint64_t m_firstPacket = 0;
    bool m_writerWaits = false;
    bool m_endArrived = false;

    std::span<std::byte> m_where;
    bool m_reading = false;
    bool m_delivering = false;
    Instant m_heldUntil;
};

} // namespace liena::simulation
