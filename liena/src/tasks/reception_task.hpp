// Reads one lane: datagrams judged by their headers, messages put together, handed on whole.
#pragma once

#include "liena/message.hpp"
#include "protocol/datagram_decoder.hpp"
#include "protocol/reassembler.hpp"
#include "transport/tcp_channel.hpp"

#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace liena::tasks {

/// What a header means before its body is awaited.
struct Judgement {
    protocol::HeaderVerdict verdict = protocol::HeaderVerdict::Take;
    std::size_t maximum = 0; ///< of the whole message, in bytes
};

/// Whoever owns a lane of the peer. It may close the task in any of these calls.
class LaneSink {
public:
    virtual ~LaneSink() = default;
    /// The network thread turned: before anything that was read is acted on.
    virtual void turned() = 0;
    virtual Judgement judge(std::uint8_t lane, const protocol::DatagramHeader& header) = 0;
    /// `part` is valid during the call. `owned` holds the same bytes when the message came in several segments, else it is null.
    virtual void received(std::uint8_t lane, const protocol::DatagramHeader& header, std::span<const std::byte> part,
                          FieldBytes* owned) = 0;
    /// A segment is passed over, since the partial messages of the process hold too much.
    virtual void overBudget(const protocol::DatagramHeader& header, const protocol::Reassembler::OverBudget& passed) = 0;
    virtual void violated(std::uint8_t lane, const std::string& detail) = 0;
    virtual void laneLost(std::uint8_t lane, const std::string& detail) = 0;
};

/// Network thread. After close() nothing is handed on any more; its owner lets it die in a later turn.
class ReceptionTask : public transport::TcpChannel::Listener {
public:
    ReceptionTask(std::shared_ptr<transport::TcpChannel> channel, std::unique_ptr<protocol::DatagramDecoder> decoder,
                  protocol::PartialBudget& budget, std::uint8_t lane, LaneSink& sink);
    ~ReceptionTask() override;

    /// Begins with the bytes that are there already.
    void start();

    /// Reads no more until start(); the connection stays.
    void pause() { m_paused = true; }

    /// From now on another owner judges what this lane brings.
    void setSink(LaneSink& sink) { m_sink = &sink; }

    void abandon(std::uint16_t number, Timestamp timestamp) { m_reassembler.abandon(number, timestamp); }
    bool hasPartial() const { return m_reassembler.hasPartial(); }
    std::uint64_t abandoned() const { return m_reassembler.abandoned(); }
    std::uint64_t bytesReceived() const { return m_bytesReceived; }
    const transport::TcpChannel& channel() const { return *m_channel; }
    std::size_t backlog() const { return m_decoder->buffered(); }
    bool isClosed() const { return m_closed; }

    /// The connection stays until the task dies; nothing is read or handed on any more.
    void orphan();
    void close();

private:
    void bytesRead(std::size_t count) override;
    void bytesWritten() override {}
    void channelLost(const std::string& detail, bool identity) override;
    void process();
    void readOn();
    protocol::HeaderVerdict judge(const protocol::DatagramHeader& header);
    bool conclude(const protocol::DatagramHeader& header, protocol::Reassembler::Outcome outcome, std::span<const std::byte> body);

    std::shared_ptr<transport::TcpChannel> m_channel;
    std::shared_ptr<protocol::DatagramDecoder> m_decoder; ///< shared with a read in flight, whose bytes it takes
    protocol::Reassembler m_reassembler;
    std::uint8_t m_lane;
    LaneSink* m_sink;
    std::size_t m_maximum = 0; ///< of the datagram that was judged last
    std::uint64_t m_bytesReceived = 0;
    bool m_concluded = false; ///< the last message is whole, and not acknowledged for that yet
    bool m_paused = false;
    bool m_reading = false;
    bool m_closed = false;
};

} // namespace liena::tasks
