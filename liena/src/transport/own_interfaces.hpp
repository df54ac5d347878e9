// Whether this computer has a network at all on the way to a peer: the plainest cause of a lost link, which no error code names.
#pragma once

#include <boost/asio/ip/address.hpp>
#include <boost/system/error_code.hpp>

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace liena::transport {

/// An address of an interface, or none: each interface is there at least once.
struct OwnInterface {
    std::string name;
    bool loopback = false;
    bool running = false; ///< set up, and with a carrier
    std::optional<boost::asio::ip::address> address;
};

/// From the kernel; empty when it does not say.
std::vector<OwnInterface> ownInterfaces();

/// From which this computer would send to `target`; none, and why, where it knows no way. Nothing is sent.
std::optional<boost::asio::ip::address> addressTowards(const boost::asio::ip::address& target, boost::system::error_code& error);

/// Pure. What is without a network, in words: the interface that has the address `from`, or where there is no such address, all of them
/// when none runs. Nothing where the network is up as far as can be seen here.
std::optional<std::string> missingNetwork(std::span<const OwnInterface> interfaces, const std::optional<boost::asio::ip::address>& from);

} // namespace liena::transport
