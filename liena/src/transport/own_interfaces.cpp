// Interfaces as getifaddrs(3) tells them.
#include "transport/own_interfaces.hpp"

#include <boost/asio/ip/udp.hpp>

#include <ifaddrs.h>
#include <net/if.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstring>
#include <memory>

namespace liena::transport {

namespace asio = boost::asio;

namespace {

std::optional<asio::ip::address> addressOf(const sockaddr* found)
{
    if (found != nullptr && found->sa_family == AF_INET) {
        sockaddr_in four{};
        std::memcpy(&four, found, sizeof four);
        return asio::ip::address_v4(ntohl(four.sin_addr.s_addr));
    }
    if (found != nullptr && found->sa_family == AF_INET6) {
        sockaddr_in6 six{};
        std::memcpy(&six, found, sizeof six);
        return asio::ip::address_v6(std::bit_cast<asio::ip::address_v6::bytes_type>(six.sin6_addr), six.sin6_scope_id);
    }
    return std::nullopt;
}

} // namespace

std::vector<OwnInterface> ownInterfaces()
{
    ifaddrs* first = nullptr;
    if (::getifaddrs(&first) != 0)
        return {};
    const std::unique_ptr<ifaddrs, decltype(&::freeifaddrs)> list(first, &::freeifaddrs);
    std::vector<OwnInterface> interfaces;
    for (const auto* one = list.get(); one != nullptr; one = one->ifa_next) {
        const bool running = (one->ifa_flags & IFF_UP) != 0 && (one->ifa_flags & IFF_RUNNING) != 0;
        interfaces.push_back({one->ifa_name, (one->ifa_flags & IFF_LOOPBACK) != 0, running, addressOf(one->ifa_addr)});
    }
    return interfaces;
}

std::optional<asio::ip::address> addressTowards(const asio::ip::address& target, boost::system::error_code& error)
{
    // No socket of Asio's: that needs a context, which cannot be made where descriptors are short, and throws.
    const int descriptor = ::socket(target.is_v4() ? AF_INET : AF_INET6, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    const asio::ip::udp::endpoint meant(target, 9); // any port: the kernel chooses the way, and no packet leaves
    asio::ip::udp::endpoint local;
    auto size = static_cast<socklen_t>(local.capacity());
    const bool found = descriptor >= 0 && ::connect(descriptor, meant.data(), static_cast<socklen_t>(meant.size())) == 0 &&
                       ::getsockname(descriptor, local.data(), &size) == 0;
    error = found ? boost::system::error_code() : boost::system::error_code(errno, boost::system::system_category());
    if (descriptor >= 0)
        ::close(descriptor);
    if (!found)
        return std::nullopt;
    local.resize(size);
    return local.address();
}

std::optional<std::string> missingNetwork(std::span<const OwnInterface> interfaces, const std::optional<asio::ip::address>& from)
{
    if (from) {
        const auto found = std::ranges::find_if(interfaces, [&from](const OwnInterface& one) { return one.address == from; });
        if (found == interfaces.end() || found->running)
            return std::nullopt;
        return "the interface " + found->name + " is down or its cable is out";
    }
    const bool someRun = std::ranges::any_of(interfaces, [](const OwnInterface& one) { return !one.loopback && one.running; });
    if (interfaces.empty() || someRun)
        return std::nullopt;
    return "no network interface is up";
}

} // namespace liena::transport
