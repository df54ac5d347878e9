// The UDP socket of a device: packets in, packets out, nothing promised (protocol section 6).
#pragma once

#include "liena/error.hpp"
#include "liena/log.hpp"
#include "protocol/packet.hpp"

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/address.hpp>
#include <boost/asio/ip/udp.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>

namespace liena::transport {

/// Network thread only.
class UdpSocket {
public:
    /// The packet's bytes may be changed by the handler and are valid during the call. Who sent it is not said: a source address proves
    /// nothing.
    using Handler = std::function<void(std::span<std::byte> packet)>;

    UdpSocket(boost::asio::io_context& io, Handler handler, LogSink log);
    ~UdpSocket();
    UdpSocket(const UdpSocket&) = delete;
    UdpSocket& operator=(const UdpSocket&) = delete;

    /// Takes the port; an error names the address, the reason and what to do.
    /// What is sent bears the mark.
    Result<void> listen(const boost::asio::ip::address& address, std::uint16_t port, std::uint8_t dscp);

    int descriptor() { return m_socket.native_handle(); }

    void start();
    void close();

    /// False when the packet did not leave: the socket is full, or there is no way to the receiver.
    bool send(const boost::asio::ip::udp::endpoint& to, std::span<const std::byte> packet);

private:
    void await();
    void receive();

    static constexpr int burst = 64; ///< packets taken before other work has its turn

    boost::asio::ip::udp::socket m_socket;
    Handler m_handler;
    LogSink m_log;
    std::array<std::byte, protocol::maximumPacket + 1> m_buffer{}; ///< a longer packet shows by filling it
    std::shared_ptr<bool> m_alive = std::make_shared<bool>(true);
};

} // namespace liena::transport
