// From Attach to the handshake.
#include "system/fresh_connection.hpp"

#include "protocol/header_judge.hpp"

namespace liena::system {

using namespace std::chrono_literals;

FreshConnection::FreshConnection(boost::asio::io_context& io, transport::AttachedConnection connection, DeviceId self,
                                 protocol::PartialBudget& budget, Handlers handlers)
    : m_token(connection.attach.token),
      m_peer(connection.peer),
      m_self(self),
      m_handlers(std::move(handlers)),
      m_timer(io),
      m_task(std::make_unique<tasks::ReceptionTask>(std::move(connection.channel), std::move(connection.decoder), budget, std::uint8_t{0},
                                                    *this))
{}

void FreshConnection::start()
{
    m_timer.after(1s, [this] { m_handlers.ended(); });
    m_task->start();
}

void FreshConnection::ignore()
{
    m_task->pause();
    m_timer.after(3s, [this] { m_handlers.ended(); });
}

std::unique_ptr<tasks::ReceptionTask> FreshConnection::release()
{
    m_timer.cancel();
    return std::move(m_task);
}

void FreshConnection::close()
{
    m_timer.cancel();
    if (m_task)
        m_task->close();
}

tasks::Judgement FreshConnection::judge(std::uint8_t /*lane*/, const protocol::DatagramHeader& header)
{
    if (m_heard || !protocol::isHandshakeHeader(m_self, m_peer, header)) {
        m_handlers.ended();
        return {protocol::HeaderVerdict::Refuse, 0};
    }
    return {protocol::HeaderVerdict::Take, *protocol::maximumSessionBody(header.message.number)};
}

void FreshConnection::received(std::uint8_t /*lane*/, const protocol::DatagramHeader& header, std::span<const std::byte> part,
                               FieldBytes* /*owned*/)
{
    const auto message = protocol::decodeSessionMessage(header.message.number, part);
    const auto tokenOf = [](const protocol::SessionMessage& m) {
        const auto* plain = std::get_if<protocol::Handshake>(&m);
        return plain != nullptr ? plain->token : std::get<protocol::DiagnosisHandshake>(m).handshake.token;
    };
    if (!message || tokenOf(*message) != m_token || m_token == 0)
        return m_handlers.ended();
    m_heard = true;
    m_timer.cancel();
    m_task->pause(); // whoever adopts it goes on reading
    m_handlers.handshake(*message);
}

void FreshConnection::violated(std::uint8_t /*lane*/, const std::string& /*detail*/) { m_handlers.ended(); }
void FreshConnection::laneLost(std::uint8_t /*lane*/, const std::string& /*detail*/) { m_handlers.ended(); }

} // namespace liena::system
