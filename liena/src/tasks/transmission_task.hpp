// Sends what waits on one lane, one write at a time.
#pragma once

#include "tasks/interface_shares.hpp"
#include "tasks/output_batch.hpp"
#include "tasks/output_queue.hpp"
#include "tasks/path_rate.hpp"
#include "transport/tcp_channel.hpp"
#include "transport/timer.hpp"

#include <array>
#include <functional>
#include <memory>
#include <string>

namespace liena::tasks {

/// Network thread. The queue outlives the task, so that a lane can be connected again. An output lane never brings bytes; reading it
/// shows when it ends.
class TransmissionTask : public transport::TcpChannel::Listener, public PathRate::Sender {
public:
    struct Settings {
        std::size_t segment = 8192; ///< largest body
        std::size_t batch = 32768;  ///< bytes per write, about; fewer on lane 0 to another computer, more where workers write
        transport::TcpChannel::Traffic traffic = transport::TcpChannel::Traffic::Prompt;
        std::uint8_t dscp = 0;
        transport::WorkerThreads* workers = nullptr; ///< that may do the work; null: the network thread does
        InterfaceShares* interfaces = nullptr;       ///< of a lane that is paced; outlives it
    };
    using Lost = std::function<void(const std::string& detail, bool identity)>;

    /// `rate` paces what is sent, and learns from it; null: as fast as the kernel takes it. It outlives the task, as the queue does.
    TransmissionTask(std::shared_ptr<transport::TcpChannel> channel, OutputQueue& queue, Settings settings, PathRate* rate, Lost lost);
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
    void roomMade() override;
    void channelLost(const std::string& detail, bool identity) override;
    void rateChanged() override;

    bool mayBePassed() const;
    void watchPatience(std::chrono::steady_clock::time_point now);
    void fill(std::chrono::steady_clock::time_point now, bool isPassable, bool urgentOnly);
    void keepPace(std::chrono::steady_clock::time_point now);
    void watchPace(std::chrono::steady_clock::time_point now);
    std::uint32_t unsent() const;

    /// A worker may still use them when the task is gone.
    struct Buffers {
        Buffers(std::size_t room, bool refers) : batch(room, refers) {}
        OutputBatch batch; ///< what is being written
        std::array<std::byte, 16> unexpected{};
    };

    std::shared_ptr<transport::TcpChannel> m_channel;
    std::shared_ptr<Buffers> m_buffers;
    OutputQueue* m_queue;
    Settings m_settings;
    PathRate* m_rate;
    double m_paced = 0; ///< bytes per second that the kernel was told with the last write
    transport::Timer m_look;
    bool m_looking = false;
    transport::Timer m_patience;
    bool m_watchesPatience = false;
    bool m_isOverdue = false;                              ///< what is patient waited too long for room
    std::chrono::steady_clock::time_point m_lastPatient{}; ///< write of it
    Lost m_lost;
    bool m_writing = false;
    std::uint64_t m_bytesSent = 0;
};

} // namespace liena::tasks
