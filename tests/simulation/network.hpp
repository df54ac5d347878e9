// The simulated network: paths between hosts that delay, lose, hold and cut, and the connections and packets on them.
#pragma once

#include "seeded_random.hpp"
#include "virtual_time.hpp"

#include "liena/session_state.hpp"

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace liena::simulation {

class Connection;
using HostIndex = std::uint8_t;
using ConnectionNumber = std::uint64_t;

/// One direction between two hosts.
struct Path {
    Nanoseconds delay = std::chrono::milliseconds(1);
    Nanoseconds jitter{};
    std::uint32_t loss = 0; ///< of a wire packet, in parts per million
    std::uint32_t cut = 0;  ///< how many causes cut it now
    bool keepsEnds = false; ///< swallows what tells of a connection's end
    bool noDatagrams = false;
    std::uint64_t rate = 0; ///< bytes a second; 0: unbounded
    Instant heldUntil;      ///< everything waits until then, and comes at once
    Instant free;           ///< when the bottleneck has sent what it holds
};

/// How a host answers whoever connects to it.
enum class Reception : std::uint8_t { Listens, Refuses, Silent };

/// The hosts' programs, as far as the network must know them.
class HostPrograms {
public:
    virtual ~HostPrograms() = default;
    /// Runs it when the host's program runs: now, or after a pause; never when the program that runs now has ended by then.
    virtual void whenRunning(HostIndex host, VirtualTime::Event event) = 0;
    virtual Reception reception(HostIndex host) const = 0;
    virtual void accepted(HostIndex host, HostIndex from, ConnectionNumber connection) = 0;
    virtual void datagramArrived(HostIndex host, HostIndex from, std::span<const std::byte> bytes) = 0;
};

struct ConnectFailure {
    ProbeResult probe = ProbeResult::NotProbed;
    const char* detail = "";
};

class Network {
public:
    /// The connection, or 0 and why not.
    using Connected = std::function<void(ConnectionNumber, ConnectFailure)>;

    Network(VirtualTime& time, HostPrograms& programs, SeededRandom random, std::size_t hosts);
    ~Network();

    void setSendBuffer(std::size_t bytes) { m_sendBuffer = bytes; }
    std::size_t sendBuffer() const { return m_sendBuffer; }

    Path& path(HostIndex from, HostIndex to) { return m_paths[from * m_hosts + to]; }

    /// TCP and TLS within `limit`; the number names the attempt.
    std::uint64_t connect(HostIndex from, HostIndex to, Nanoseconds limit, Connected done);
    void cancel(std::uint64_t attempt) { m_attempts.erase(attempt); }

    void sendDatagram(HostIndex from, HostIndex to, std::vector<std::byte> bytes);

    Connection* find(ConnectionNumber number);

    /// Every connection of that host ends: with a word to the other end (the program died), or without (the power failed).
    void hostEnded(HostIndex host, bool tells);

    /// Some connection between the two is reset for both ends; false when there is none.
    bool reset(HostIndex a, HostIndex b, std::uint64_t which);
    /// Until `until` the program at the reading end takes nothing from it.
    bool holdReading(HostIndex a, HostIndex b, std::uint64_t which, Instant until);

    // For connections.
    VirtualTime& time() { return m_time; }
    HostPrograms& programs() { return m_programs; }
    /// When that many bytes arrive, if they do.
    std::optional<Instant> arrival(HostIndex from, HostIndex to, std::size_t bytes);
    bool isCut(HostIndex from, HostIndex to) { return path(from, to).cut != 0; }
    void forgetLater(ConnectionNumber number);

    std::uint64_t packetsLost() const { return m_lost; }

private:
    struct Attempt {
        HostIndex from = 0;
        HostIndex to = 0;
        int step = 0;
        Instant deadline;
        Connected done;
        ConnectionNumber made = 0;
    };

    void advance(std::uint64_t number);
    void stepArrived(std::uint64_t number);
    void finish(std::uint64_t number, ConnectionNumber made, ConnectFailure failure);
    ConnectionNumber make(HostIndex from, HostIndex to);
    std::vector<Connection*> between(HostIndex a, HostIndex b);

    VirtualTime& m_time;
    HostPrograms& m_programs;
    SeededRandom m_random;
    std::size_t m_hosts;
    std::vector<Path> m_paths;
    std::map<ConnectionNumber, std::unique_ptr<Connection>> m_connections;
    std::map<std::uint64_t, Attempt> m_attempts;
    std::size_t m_sendBuffer = 64 << 10; ///< of every connection
    std::uint64_t m_numbers = 0;
    std::uint64_t m_lost = 0;
};

} // namespace liena::simulation
