// Makes one connection to a peer and makes sure of who is there.
#pragma once

#include "liena/system_topology.hpp"
#include "security/tls_identity.hpp"
#include "transport/connection_failure.hpp"
#include "transport/tcp_channel.hpp"

#include <chrono>
#include <functional>
#include <memory>
#include <variant>
#include <vector>

namespace liena::transport {

/// Network thread only. The destructor cancels.
class TcpClient {
public:
    using Outcome = std::variant<std::shared_ptr<TcpChannel>, ConnectionFailure>;
    using Handler = std::function<void(Outcome)>;

    /// `identity` is null in mode `none`. `handler` is called once, within `limit` and never from here. With `known`, the addresses() of a
    /// connection before, nobody is asked for those of its host: a name server may take seconds.
    TcpClient(boost::asio::io_context& io, const TopologyDevice& peer, std::shared_ptr<security::TlsIdentity> identity,
              std::chrono::nanoseconds limit, Handler handler, const std::vector<boost::asio::ip::address>& known = {});
    ~TcpClient();
    TcpClient(const TcpClient&) = delete;
    TcpClient& operator=(const TcpClient&) = delete;

    /// All of the peer's host, in the order in which they are tried; after the end, in which they should be next: the one where it was
    /// reached first, one that did not answer in time last. None while nobody said them.
    std::vector<boost::asio::ip::address> addresses() const;

    /// No callback from now on.
    void cancel();

private:
    struct Attempt;
    std::shared_ptr<Attempt> m_attempt; ///< shared with its operations in flight
};

} // namespace liena::transport
