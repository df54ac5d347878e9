// One lane of our output channel: its queue, its connection, and how both are made anew.
#pragma once

#include "liena/system_topology.hpp"
#include "tasks/output_queue.hpp"
#include "tasks/transmission_task.hpp"
#include "transport/tcp_client.hpp"

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace liena::tasks {

/// Network thread. A new connection replaces the old one only when it stands.
class OutputLane {
public:
    struct Handlers {
        std::function<void()> up; ///< the Attach is on its way
        std::function<void(const transport::ConnectionFailure&)> failed;
        std::function<void(const std::string& detail, bool identity)> lost;
        OutputQueue::Report dropped;
        OutputQueue::Abandoning abandoning;
        /// Asked when a connection is made, before anything is said on it; an error ends it. May be null.
        std::function<Result<void>(transport::TcpChannel&)> admit;
    };

    OutputLane(boost::asio::io_context& io, TopologyDevice peer, std::shared_ptr<security::TlsIdentity> identity,
               TransmissionTask::Settings settings, Handlers handlers);
    ~OutputLane();
    OutputLane(const OutputLane&) = delete;
    OutputLane& operator=(const OutputLane&) = delete;

    /// Replaces an attempt in hand. `attach` is the first message on the connection; `known` as in TcpClient.
    void connect(protocol::EncodedMessage attach, std::chrono::nanoseconds limit, const std::vector<boost::asio::ip::address>& known = {});

    bool isUp() const { return m_task != nullptr; }
    bool isConnecting() const { return m_client != nullptr; }

    /// Of the peer's host, the one of the newest connection first; where that did not answer to an attempt with known ones, the next. None
    /// before there was a connection.
    const std::vector<boost::asio::ip::address>& addresses() const { return m_addresses; }

    /// The connection; null while there is none.
    const transport::TcpChannel* channel() const { return m_task ? &m_task->channel() : nullptr; }

    /// False when the queue is full.
    bool push(OutputQueue::Entry&& entry);

    /// Of what waits; what had begun is abandoned, and the peer told.
    void discardApplication();

    /// From its beginning to its end what is pushed only waits.
    void gather(bool begins);

    /// Nothing waits, nothing is being written, and the peer's kernel has all that was.
    bool isDelivered() const;

    /// Application messages that left whole since the lane was made, by connections that are closed, too; the largest is of the queue as
    /// it is now.
    OutputQueue::Left left() const { return {m_leftBefore + m_queue->left().bytes, m_queue->left().largest}; }

    OutputQueue& queue() { return *m_queue; }
    const OutputQueue& queue() const { return *m_queue; }

    /// That the path carries; nothing on a lane that is not paced, or before it was filled once.
    std::optional<KnownRate> knownRate() const;

    /// Of a lane that is paced: what the path seems to carry, and not more than this of it.
    double steadyRate() const { return m_task && m_paced ? m_rate.steady() : 0; }
    void limitRate(std::optional<double> bytesPerSecond) { m_rate.limit(bytesPerSecond); }

    /// Before its first connection, where others tell something of the path; see PathRate::beginAt().
    void beginAt(double bytesPerSecond) { m_rate.beginAt(bytesPerSecond); }

    /// The addresses of the newest connection, as text; empty before the first.
    struct Way {
        std::string local;
        std::string remote;
    };
    const Way& way() const { return m_way; }

    std::uint64_t bytesSent() const { return m_bytesSent + (m_task ? m_task->bytesSent() : 0); }

    /// Ends the connection and any attempt. Session management that waits may still leave within `grace`; nothing else does.
    void close(std::chrono::nanoseconds grace);

private:
    void cancelAttempt();
    void established(std::shared_ptr<transport::TcpChannel> channel);
    void lost(const std::string& detail, bool identity);
    void bury(std::shared_ptr<void> ended);
    std::unique_ptr<OutputQueue> makeQueue() const;
    std::unique_ptr<OutputQueue> exchangeQueue();

    boost::asio::io_context& m_io;
    TopologyDevice m_peer;
    std::shared_ptr<security::TlsIdentity> m_identity;
    TransmissionTask::Settings m_settings;
    Handlers m_handlers;
    std::unique_ptr<OutputQueue> m_queue;
    std::unique_ptr<TransmissionTask> m_task;
    std::unique_ptr<transport::TcpClient> m_client;
    std::vector<boost::asio::ip::address> m_addresses;
    Way m_way;
    protocol::EncodedMessage m_attach;
    PathRate m_rate; ///< kept from one connection to the next, which mostly takes the same path
    bool m_paced = false;
    bool m_gathers = false;
    std::uint64_t m_bytesSent = 0;
    std::uint64_t m_leftBefore = 0; ///< of queues that were exchanged
};

} // namespace liena::tasks
