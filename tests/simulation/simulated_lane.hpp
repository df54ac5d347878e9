// One lane of a simulated output channel: the real queue and encoder on a simulated connection.
#pragma once

#include "connection.hpp"
#include "program.hpp"

#include "protocol/datagram_encoder.hpp"
#include "tasks/output_queue.hpp"

#include <functional>
#include <list>
#include <memory>
#include <string>

namespace liena::simulation {

/// Plays tasks::OutputLane and TransmissionTask; each decision here is one of theirs.
class SimulatedLane {
public:
    struct Settings {
        std::size_t segment = 8192;
        std::size_t batch = 32768;
    };
    struct Handlers {
        std::function<void()> up;
        std::function<void(const ConnectFailure&)> failed;
        std::function<void(const std::string& detail)> lost;
        tasks::OutputQueue::Report dropped;
        tasks::OutputQueue::Abandoning abandoning;
        /// Every datagram before it becomes bytes; it may be changed, and others may be put behind it.
        std::function<void(std::vector<std::byte>& bytes, std::size_t begin)> leaving;
    };

    SimulatedLane(Program& program, HostIndex peer, Settings settings, Handlers handlers);
    ~SimulatedLane();
    SimulatedLane(const SimulatedLane&) = delete;
    SimulatedLane& operator=(const SimulatedLane&) = delete;

    void connect(const protocol::EncodedMessage& attach, Nanoseconds limit);
    bool isUp() const { return m_writer != nullptr; }
    ConnectionNumber connection() const { return m_connection; }
    bool isConnecting() const { return m_attempt != 0; }
    bool push(tasks::OutputQueue::Entry entry);
    tasks::OutputQueue& queue() { return *m_queue; }
    void close(Nanoseconds grace);

private:
    class Writer;

    void cancelAttempt();
    void established(ConnectionNumber connection);
    void lost(const std::string& detail);
    std::unique_ptr<tasks::OutputQueue> makeQueue() const;

    Program& m_program;
    HostIndex m_peer;
    Settings m_settings;
    Handlers m_handlers;
    std::unique_ptr<tasks::OutputQueue> m_queue;
    std::shared_ptr<Writer> m_writer;
    ConnectionNumber m_connection = 0; ///< of the writer
    std::uint64_t m_attempt = 0;
    protocol::EncodedMessage m_attach;

    /// A connection that may still bring what waited, for a while.
    struct Remains {
        std::unique_ptr<tasks::OutputQueue> queue;
        std::shared_ptr<Writer> writer;
        std::unique_ptr<Program::Timer> timer;
    };
    std::list<Remains> m_remains;
};

} // namespace liena::simulation
