// Binding, receiving in bursts, sending without waiting.
#include "transport/udp_socket.hpp"

#include "transport/close_on_exec.hpp"
#include "transport/packet_mark.hpp"

#include <fmt/format.h>

#include <utility>

namespace liena::transport {

namespace asio = boost::asio;
using asio::ip::udp;

UdpSocket::UdpSocket(asio::io_context& io, Handler handler, LogSink log)
    : m_socket(io), m_handler(std::move(handler)), m_log(std::move(log))
{}

UdpSocket::~UdpSocket() { close(); }

Result<void> UdpSocket::listen(const asio::ip::address& address, std::uint16_t port, std::uint8_t dscp)
{
    const udp::endpoint endpoint(address, port);
    boost::system::error_code error;
    m_socket.open(endpoint.protocol(), error);
    closeOnExec(m_socket.native_handle());
    if (!error)
        m_socket.non_blocking(true, error);
    if (!error)
        m_socket.bind(endpoint, error);
    if (error)
        return fail(Errc::AddressUnavailable,
                    fmt::format("cannot bind UDP {}:{}: {}; {}", address.to_string(), port, error.message(),
                                error == asio::error::address_in_use
                                    ? "another program has this port: end it, or give the device another port in the topology"
                                    : "the device's host in the topology must be an address of this computer"));
    markPackets(m_socket.native_handle(), address.is_v6(), dscp);
    return ok();
}

void UdpSocket::start() { await(); }

void UdpSocket::close()
{
    *m_alive = false;
    boost::system::error_code ignored;
    m_socket.close(ignored);
}

void UdpSocket::await()
{
    m_socket.async_wait(udp::socket::wait_read, [this, alive = m_alive](const boost::system::error_code& error) {
        if (!*alive)
            return;
        if (error)
            return m_log(LogLevel::Error, fmt::format("the UDP socket failed: {}; sessions go on over TCP alone", error.message()));
        receive();
    });
}

void UdpSocket::receive()
{
    const auto alive = m_alive;
    for (int i = 0; i < burst; ++i) {
        boost::system::error_code error;
        udp::endpoint from;
        const auto size = m_socket.receive_from(asio::buffer(m_buffer), from, 0, error);
        if (error == asio::error::would_block || error == asio::error::try_again)
            break;
        // What a packet of ours met on its way shows here; it says nothing about the next one.
        if (!error && size <= protocol::maximumPacket)
            m_handler(std::span(m_buffer).first(size));
        if (!*alive)
            return;
    }
    await();
}

bool UdpSocket::send(const udp::endpoint& to, std::span<const std::byte> packet)
{
    boost::system::error_code error;
    m_socket.send_to(asio::const_buffer(packet.data(), packet.size()), to, 0, error);
    return !error;
}

} // namespace liena::transport
