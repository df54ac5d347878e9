// The bulk lanes of our output channel: added while streams would wait for each other, retired when they are idle (protocol section 6).
#pragma once

#include "tasks/arrival_limit.hpp"
#include "tasks/lane_shares.hpp"
#include "tasks/load_balancer.hpp"
#include "tasks/output_lane.hpp"
#include "tasks/stream_rates.hpp"
#include "transport/timer.hpp"

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace liena::tasks {

/// Network thread. A stream (message number) stays on its lane until it paused and the peer's kernel has all of it, so that its order is
/// kept. One that just measures goes where another one is, behind it: on a lane of its own it would have half of the path.
class BulkLanes {
public:
    /// What the bulk lanes to all peers have in common; outlives them.
    struct Commons {
        transport::WorkerThreads& workers;
        InterfaceShares& interfaces;
    };

    struct Handlers {
        std::function<protocol::EncodedMessage(std::uint8_t lane)> attach;
        std::function<bool()> mayConnect; ///< the session carries messages
        std::function<void(std::uint8_t lane, const std::string& detail)> lost;
        OutputQueue::Report dropped;
        OutputQueue::Abandoning abandoning;
        std::function<std::vector<boost::asio::ip::address>()> known; ///< as of lane 0, for OutputLane::connect()
    };

    BulkLanes(boost::asio::io_context& io, TopologyDevice peer, std::shared_ptr<security::TlsIdentity> identity, std::uint8_t dscp,
              Commons commons, Handlers handlers);

    /// False when the stream's queue is full.
    bool push(OutputQueue::Entry&& entry);

    /// Connects the lanes that have something to send.
    void connect();

    /// From time to time: a lane that nothing uses is closed when fewer are wanted for a while.
    void retire(std::chrono::steady_clock::time_point now);

    void discardApplication();
    void close();

    /// Lanes with a connection.
    std::size_t connected() const;
    std::size_t queuedMessages() const;
    std::uint64_t bytesSent() const;
    std::size_t queuedBytes() const;

    /// That the lanes in use together carry, as the one that was filled longest ago showed it; see togetherOf().
    std::optional<KnownRate> knownRate(std::chrono::steady_clock::time_point now) const;

    /// The streams that were used lately, each with what it can count on, as far as that is known.
    std::vector<BulkStream> streamRates(std::chrono::steady_clock::time_point now) const;

    /// Bulk of the application that has not left whole.
    bool waits() const;

    /// What left whole on all lanes, and the largest message of each, added.
    OutputQueue::Left left() const;

    /// Bytes that left for the peer on other ways, counted as in OutputQueue::Left.
    struct Elsewhere {
        std::uint64_t prompt = 0;  ///< on lane 0
        std::uint64_t packets = 0; ///< by UDP
    };

    /// The peer says what arrived, whichever way it came.
    void arrivalsReported(std::chrono::nanoseconds window, std::uint64_t received, Elsewhere sent, std::chrono::nanoseconds roundTrip);

    /// One of the peer's reports may not have been heard.
    void reportMissed() { m_arrivals.forgetWaiting(); }

private:
    static constexpr std::chrono::seconds pauseLimit{2}; ///< of a stream, before it may change its lane

    using Instant = std::chrono::steady_clock::time_point;
    struct Stream {
        std::size_t place = 0; ///< in m_lanes
        Instant lastUsed;
        bool measures = false;
    };

    std::size_t placeFor(std::uint16_t number, bool measures, Instant now);
    std::size_t choosePlace(Instant now);
    std::size_t placeBehindOthers(Instant now);
    std::size_t addLane(Instant now);
    void shareLimit();
    std::vector<LaneRate> laneRates(Instant now) const;
    static bool wasUsed(const Stream& stream, Instant now) { return now - stream.lastUsed < pauseLimit; }
    bool isInUse(std::size_t place, Instant now) const;
    bool isFree(std::size_t place, Instant now) const;
    std::size_t streamsInUse(Instant now) const;

    boost::asio::io_context& m_io;
    TopologyDevice m_peer;
    std::shared_ptr<security::TlsIdentity> m_identity;
    TransmissionTask::Settings m_settings;
    Handlers m_handlers;
    std::vector<std::unique_ptr<OutputLane>> m_lanes; ///< lane 1 first
    std::map<std::uint16_t, Stream> m_streams;        ///< by message number
    ElasticCount m_wanted = laneCount();
    ArrivalLimit m_arrivals;
    transport::Timer m_retry;
};

} // namespace liena::tasks
