// Accepting, and the short life of a connection before its Attach.
#include "transport/tcp_server.hpp"

#include "protocol/header_judge.hpp"
#include "transport/close_on_exec.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace liena::transport {

namespace asio = boost::asio;
using asio::ip::tcp;
using namespace std::chrono_literals;

/// From accept to Attach: bounded in time, in bytes, and in what it may say.
class TcpServer::Pending : public TcpChannel::Listener {
public:
    Pending(TcpServer& server, tcp::socket socket)
        : m_server(server),
          m_channel(std::make_shared<TcpChannel>(std::move(socket))),
          m_decoder(std::make_unique<protocol::DatagramDecoder>()),
          m_timer(server.m_io)
    {}
    ~Pending() override
    {
        if (m_channel) {
            m_channel->setListener(nullptr);
            m_channel->close();
        }
    }

    void start()
    {
        m_timer.after(2s, [this] { refuse("no Attach within 2 s"); });
        m_channel->setListener(this);
        if (!m_server.m_identity)
            return m_channel->read(m_decoder->writable());
        m_channel->secure(m_server.m_identity->serverContext(), true, [this](const Result<void>& result) { secured(result); });
    }

    asio::ip::address address() const { return m_channel->remote().address(); }

    void bytesRead(std::size_t count) override
    {
        m_decoder->commit(count);
        bool attached = false;
        bool wrong = false;
        const auto judge = [&](const protocol::DatagramHeader& header) {
            // What follows the Attach is not for this object; refusing stops the decoder before it, and the header is judged anew later.
            if (attached)
                return protocol::HeaderVerdict::Refuse;
            wrong = !protocol::isAttachHeader(m_server.m_self, m_authenticated, header);
            return wrong ? protocol::HeaderVerdict::Refuse : protocol::HeaderVerdict::Take;
        };
        const auto take = [&](const protocol::DatagramHeader& header, std::span<const std::byte> body) {
            const auto message = protocol::decodeSessionMessage(header.message.number, body);
            wrong = !message;
            attached = !wrong;
            if (attached) {
                m_peer = header.message.origin;
                m_attach = std::get<protocol::Attach>(*message);
            }
            return attached;
        };
        m_decoder->process(judge, take);
        if (wrong)
            refuse("its first words are no Attach to this device in its own name");
        else if (attached)
            handOver();
        else
            m_channel->read(m_decoder->writable());
    }
    void bytesWritten() override {}
    void channelLost(const std::string& /*detail*/, bool /*identity*/) override { m_server.forget(this); }

    void refuse(const std::string& cause)
    {
        auto& server = m_server;
        const auto from = m_channel->remote();
        const auto device = m_authenticated.value_or(DeviceId::broadcast());
        server.forget(this);
        server.m_handlers.refused(device, cause, from);
    }

private:
    void secured(const Result<void>& result)
    {
        if (!result)
            return refuse(result.error().what);
        const auto device = m_channel->peerDevice();
        if (!device)
            return refuse(device.error().what);
        m_authenticated = device.value();
        m_channel->read(m_decoder->writable());
    }

    void handOver()
    {
        m_timer.cancel();
        m_channel->setListener(nullptr);
        AttachedConnection connection{std::exchange(m_channel, nullptr), std::move(m_decoder), m_peer, m_attach};
        auto handler = m_server.m_handlers.attached;
        m_server.forget(this);
        handler(std::move(connection));
    }

    TcpServer& m_server;
    std::shared_ptr<TcpChannel> m_channel;
    std::unique_ptr<protocol::DatagramDecoder> m_decoder;
    Timer m_timer;
    std::optional<DeviceId> m_authenticated;
    DeviceId m_peer;
    protocol::Attach m_attach;
};

TcpServer::TcpServer(asio::io_context& io, DeviceId self, std::shared_ptr<security::TlsIdentity> identity, Handlers handlers, LogSink log)
    : m_io(io),
      m_self(self),
      m_identity(std::move(identity)),
      m_handlers(std::move(handlers)),
      m_log(std::move(log)),
      m_acceptor(io),
      m_retry(io)
{}

TcpServer::~TcpServer() { close(); }

Result<void> TcpServer::listen(const std::string& host, std::uint16_t port)
{
    const auto refuse = [&](const boost::system::error_code& error, std::string_view remedy) {
        return fail(Errc::AddressUnavailable, fmt::format("cannot listen on {}:{}: {}; {}", host, port, error.message(), remedy));
    };
    boost::system::error_code error;
    tcp::resolver resolver(m_io);
    const auto endpoints = resolver.resolve(host, std::to_string(port), tcp::resolver::passive, error);
    if (error || endpoints.empty())
        return refuse(error, "check the device's host in the topology");
    const tcp::endpoint endpoint = *endpoints.begin();
    m_acceptor.open(endpoint.protocol(), error);
    closeOnExec(m_acceptor.native_handle());
    if (!error)
        m_acceptor.set_option(tcp::acceptor::reuse_address(true), error);
    if (!error)
        m_acceptor.bind(endpoint, error);
    if (!error)
        m_acceptor.listen(asio::socket_base::max_listen_connections, error);
    if (error == asio::error::address_in_use)
        return refuse(error, "another program has this port: end it, or give the device another port in the topology");
    if (error)
        return refuse(error, "the device's host in the topology must be an address of this computer");
    return ok();
}

asio::ip::address TcpServer::address() const
{
    boost::system::error_code ignored;
    return m_acceptor.local_endpoint(ignored).address();
}

void TcpServer::start() { accept(); }

void TcpServer::close()
{
    *m_alive = false;
    boost::system::error_code ignored;
    m_acceptor.close(ignored);
    m_retry.cancel();
    m_pending.clear();
}

void TcpServer::accept()
{
    m_acceptor.async_accept([this, alive = m_alive](const boost::system::error_code& error, tcp::socket socket) {
        if (!*alive)
            return;
        if (!error) {
            m_acceptFailed = false;
            admit(std::move(socket));
            return accept();
        }
        if (!std::exchange(m_acceptFailed, true))
            m_log(LogLevel::Error, fmt::format("cannot accept connections: {}; trying again until it ends", error.message()));
        m_retry.after(100ms, [this] { accept(); });
    });
}

void TcpServer::admit(tcp::socket socket)
{
    boost::system::error_code error;
    const auto remote = socket.remote_endpoint(error);
    if (error)
        return;
    evictFor(remote.address());
    m_pending.push_back(std::make_unique<Pending>(*this, std::move(socket)));
    m_pending.back()->start();
}

void TcpServer::evictFor(const asio::ip::address& address)
{
    const auto same = [&](const std::unique_ptr<Pending>& pending) { return pending->address() == address; };
    if (static_cast<std::size_t>(std::count_if(m_pending.begin(), m_pending.end(), same)) >= mostPerAddress)
        (*std::find_if(m_pending.begin(), m_pending.end(), same))->refuse("too many connections of this address without an Attach");
    if (m_pending.size() >= mostPending)
        m_pending.front()->refuse("too many connections without an Attach");
}

void TcpServer::forget(Pending* pending)
{
    m_pending.remove_if([&](const std::unique_ptr<Pending>& candidate) { return candidate.get() == pending; });
}

} // namespace liena::transport
