// One lane that a peer connected: the real decoder and reassembler on a simulated connection.
#pragma once

#include "connection.hpp"
#include "program.hpp"

#include "protocol/datagram_decoder.hpp"
#include "protocol/reassembler.hpp"

#include <map>
#include <memory>
#include <string>
#include <utility>

namespace liena::simulation {

struct Judgement {
    protocol::HeaderVerdict verdict = protocol::HeaderVerdict::Take;
    std::size_t maximum = 0;
};

/// Whoever owns a lane of the peer; it may close the reception in any of these calls.
class ReceptionOwner {
public:
    virtual ~ReceptionOwner() = default;
    virtual void turned() = 0;
    virtual Judgement judge(std::uint8_t lane, const protocol::DatagramHeader& header) = 0;
    virtual void received(std::uint8_t lane, const protocol::DatagramHeader& header, std::span<const std::byte> part) = 0;
    virtual void overBudget(const protocol::DatagramHeader&) {}
    /// A segment of a message that is not whole yet was put to those before it.
    virtual void kept(std::uint8_t /*lane*/, const protocol::DatagramHeader&, std::size_t /*bytes*/) {}
    virtual void violated(std::uint8_t lane, const std::string& detail) = 0;
    virtual void laneLost(std::uint8_t lane, const std::string& detail) = 0;
};

/// Plays tasks::ReceptionTask; each decision here is one of its.
class SimulatedReception : public Connection::Listener {
public:
    SimulatedReception(Program& program, ConnectionNumber connection, std::unique_ptr<protocol::DatagramDecoder> decoder,
                       protocol::PartialBudget& budget, std::uint8_t lane, ReceptionOwner& owner);
    ~SimulatedReception() override { close(); }
    SimulatedReception(const SimulatedReception&) = delete;
    SimulatedReception& operator=(const SimulatedReception&) = delete;

    ConnectionNumber connection() const { return m_connection; }
    void start();
    void pause() { m_paused = true; }
    void setOwner(ReceptionOwner& owner) { m_owner = &owner; }
    void abandon(std::uint16_t number, Timestamp timestamp)
    {
        m_reassembler.abandon(number, timestamp);
        m_kept.erase(number);
    }

    /// The connection stays until the object dies; nothing is handed on any more.
    void orphan();
    void close();

private:
    void bytesRead(std::size_t count) override;
    void bytesWritten() override {}
    void connectionLost(const char* detail) override;
    void process();
    bool take(const protocol::DatagramHeader& header, std::span<const std::byte> body);
    bool keep(const protocol::DatagramHeader& header, std::size_t bytes);

    Program& m_program;
    ConnectionNumber m_connection;
    std::unique_ptr<protocol::DatagramDecoder> m_decoder;
    protocol::Reassembler m_reassembler;
    std::uint8_t m_lane;
    ReceptionOwner* m_owner;
    std::size_t m_maximum = 0;
    std::map<std::uint16_t, std::pair<Timestamp, std::size_t>> m_kept; ///< of messages that are not whole, for the onlooker
    bool m_paused = false;
    bool m_reading = false;
    bool m_closed = false;
};

} // namespace liena::simulation
