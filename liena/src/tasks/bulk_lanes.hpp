// The bulk lanes of our output channel: added while streams would wait for each other, retired when they are idle (protocol section 6).
#pragma once

#include "tasks/output_lane.hpp"
#include "transport/timer.hpp"

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <vector>

namespace liena::tasks {

/// Network thread. A stream (message number) stays on its lane until it paused and the peer's kernel has all of it, so that its order is
/// kept.
class BulkLanes {
public:
    struct Handlers {
        std::function<protocol::EncodedMessage(std::uint8_t lane)> attach;
        std::function<bool()> mayConnect; ///< the session carries messages
        std::function<void(std::uint8_t lane, const std::string& detail)> lost;
        OutputQueue::Report dropped;
        OutputQueue::Abandoning abandoning;
    };

    BulkLanes(boost::asio::io_context& io, TopologyDevice peer, std::shared_ptr<security::TlsIdentity> identity, Handlers handlers);

    /// False when the stream's queue is full.
    bool push(OutputQueue::Entry entry);

    /// Connects the lanes that have something to send.
    void connect();

    /// From time to time: a lane beside the first that nothing uses any more is closed.
    void retire(std::chrono::steady_clock::time_point now);

    void discardApplication();
    void close();

    /// Lanes with a connection.
    std::size_t connected() const;
    std::size_t queuedMessages() const;
    std::uint64_t bytesSent() const;

private:
    static constexpr std::size_t most = 4; ///< a peer takes up to 8; more than a few streams at once do not gain from their own
    static constexpr std::chrono::seconds idleLimit{5};

    using Instant = std::chrono::steady_clock::time_point;
    struct Stream {
        std::size_t place = 0; ///< in m_lanes
        Instant lastUsed;
    };

    std::size_t placeFor(std::uint16_t number, Instant now);
    std::size_t choosePlace(Instant now);
    std::size_t addLane();
    bool isInUse(std::size_t place, Instant now) const;

    boost::asio::io_context& m_io;
    TopologyDevice m_peer;
    std::shared_ptr<security::TlsIdentity> m_identity;
    Handlers m_handlers;
    std::vector<std::unique_ptr<OutputLane>> m_lanes; ///< lane 1 first
    std::map<std::uint16_t, Stream> m_streams;        ///< by message number
    transport::Timer m_retry;
};

} // namespace liena::tasks
