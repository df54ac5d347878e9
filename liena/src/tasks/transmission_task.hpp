// Sends what waits on one lane, one write at a time.
#pragma once

#include "tasks/output_queue.hpp"
#include "transport/tcp_channel.hpp"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace liena::tasks {

/// Network thread. The queue outlives the task, so that a lane can be connected again. An output lane never brings bytes; reading it
/// shows when it ends.
class TransmissionTask : public transport::TcpChannel::Listener {
public:
    struct Settings {
        std::size_t segment = 8192; ///< largest body
        std::size_t batch = 32768;  ///< bytes per write, about
    };
    using Lost = std::function<void(const std::string& detail, bool identity)>;

    TransmissionTask(std::shared_ptr<transport::TcpChannel> channel, OutputQueue& queue, Settings settings, Lost lost);
    ~TransmissionTask() override;

    /// Something was pushed.
    void wake();

    bool isIdle() const { return !m_writing && m_queue->empty(); }
    std::uint64_t bytesSent() const { return m_bytesSent; }
    const transport::TcpChannel& channel() const { return *m_channel; }

    /// Bytes to be sent before everything that is queued: the Attach of a fresh connection.
    void sendFirst(const protocol::EncodedMessage& message);

    /// Nobody is told any more how it ends.
    void orphan()
    {
        m_lost = [](const std::string&, bool) {};
    }

    void close();

private:
    void bytesRead(std::size_t count) override;
    void bytesWritten() override;
    void channelLost(const std::string& detail, bool identity) override;

    std::shared_ptr<transport::TcpChannel> m_channel;
    OutputQueue* m_queue;
    Settings m_settings;
    Lost m_lost;
    std::vector<std::byte> m_buffer;
    std::array<std::byte, 16> m_unexpected{};
    bool m_writing = false;
    std::uint64_t m_bytesSent = 0;
};

} // namespace liena::tasks
