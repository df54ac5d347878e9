// A connection with a fresh token: one handshake has to follow, or nothing will (ruling B7).
#pragma once

#include "protocol/session_messages.hpp"
#include "tasks/reception_task.hpp"
#include "transport/tcp_server.hpp"
#include "transport/timer.hpp"

#include <functional>
#include <memory>

namespace liena::system {

/// Network thread.
class FreshConnection : public tasks::LaneSink {
public:
    struct Handlers {
        std::function<void()> turned;
        std::function<void(const protocol::SessionMessage&)> handshake; ///< a Handshake or DiagnosisHandshake with the Attach's token
        std::function<void()> ended;                                    ///< it brought something else, nothing in time, or broke
    };

    FreshConnection(boost::asio::io_context& io, transport::AttachedConnection connection, DeviceId self, protocol::PartialBudget& budget,
                    Handlers handlers);

    void start();

    /// Wait no longer; the peer will withdraw it, or `limit` passes.
    void ignore();

    /// The lane goes on with another owner.
    std::unique_ptr<tasks::ReceptionTask> release();
    void close();

    std::uint64_t token() const { return m_token; }

private:
    void turned() override { m_handlers.turned(); }
    tasks::Judgement judge(std::uint8_t lane, const protocol::DatagramHeader& header) override;
    void received(std::uint8_t lane, const protocol::DatagramHeader& header, std::span<const std::byte> part, FieldBytes* owned) override;
    // One segment is all it takes.
    void overBudget(const protocol::DatagramHeader& /*header*/, const protocol::Reassembler::OverBudget& /*passed*/) override {}
    void violated(std::uint8_t lane, const std::string& detail) override;
    void laneLost(std::uint8_t lane, const std::string& detail) override;

    std::uint64_t m_token;
    DeviceId m_peer;
    DeviceId m_self;
    Handlers m_handlers;
    transport::Timer m_timer;
    std::unique_ptr<tasks::ReceptionTask> m_task;
    bool m_heard = false;
};

} // namespace liena::system
