// Resolve, connect, TLS, identity: each with one deadline over all.
#include "transport/tcp_client.hpp"

#include "transport/close_on_exec.hpp"
#include "transport/timer.hpp"

#include <boost/asio/post.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace liena::transport {

namespace asio = boost::asio;
using asio::ip::tcp;

struct TcpClient::Attempt : std::enable_shared_from_this<Attempt> {
    Attempt(asio::io_context& context, const TopologyDevice& device, std::shared_ptr<security::TlsIdentity> tlsIdentity, Handler done)
        : io(context),
          peer(device),
          place(fmt::format("{}:{}", device.host, device.port)),
          identity(std::move(tlsIdentity)),
          handler(std::move(done)),
          resolver(context),
          socket(context),
          timer(context)
    {}

    void start(std::chrono::nanoseconds limit, const std::vector<asio::ip::address>& known)
    {
        timer.after(limit, [this] { expire(); });
        if (!known.empty())
            return startAt(known);
        boost::system::error_code notNumeric;
        const auto address = asio::ip::make_address(peer.host, notNumeric);
        if (!notNumeric)
            return startAt({address});
        resolver.async_resolve(
            peer.host, std::to_string(peer.port),
            [self = shared_from_this()](const boost::system::error_code& error, const tcp::resolver::results_type& results) {
                if (self->ended)
                    return;
                if (error)
                    return self->finish(explainConnect(error, self->place));
                self->connect({results.begin(), results.end()});
            });
    }

    /// In a turn of its own: a socket that cannot be had fails at once, and the owner does not have the client yet.
    void startAt(const std::vector<asio::ip::address>& addresses)
    {
        std::vector<tcp::endpoint> endpoints;
        for (const auto& address : addresses)
            endpoints.emplace_back(address, peer.port);
        asio::post(io, [self = shared_from_this(), endpoints = std::move(endpoints)]() mutable {
            if (!self->ended)
                self->connect(std::move(endpoints));
        });
    }

    void connect(std::vector<tcp::endpoint> endpoints)
    {
        candidates = std::move(endpoints);
        tryNext(0, asio::error::host_not_found);
    }

    /// One after the other, and `last` is why the one before failed.
    void tryNext(std::size_t candidate, const boost::system::error_code& last)
    {
        boost::system::error_code error = last;
        socket.close(error);
        if (candidate == candidates.size())
            return finish(explainConnect(last, place, candidates.empty() ? std::nullopt : std::optional(candidates.back().address())));
        inHand = candidate;
        socket.open(candidates[candidate].protocol(), error);
        if (error)
            return tryNext(candidate + 1, error);
        closeOnExec(socket.native_handle());
        socket.async_connect(candidates[candidate], [self = shared_from_this(), candidate](const boost::system::error_code& refused) {
            if (self->ended)
                return;
            if (refused)
                return self->tryNext(candidate + 1, refused);
            self->begin();
        });
    }

    void begin()
    {
        connected = true;
        channel = std::make_shared<TcpChannel>(std::move(socket));
        if (!identity)
            return succeed();
        channel->secure(identity->clientContext(), false,
                        [self = shared_from_this()](const Result<void>& result) { self->secured(result); });
    }

    void secured(const Result<void>& result)
    {
        if (ended)
            return;
        if (!result)
            return finish(ConnectionFailure{ProbeResult::TlsFailure, place + ": " + result.error().what});
        const auto device = channel->peerDevice();
        if (!device)
            return finish(ConnectionFailure{ProbeResult::TlsFailure, place + ": " + device.error().what});
        if (device.value() != peer.id)
            return finish(ConnectionFailure{ProbeResult::TlsFailure,
                                            fmt::format("{} is device {}, not {} ({}): check the topology and the certificates there",
                                                        place, device.value()->toString(), peer.id.toString(), peer.name)});
        succeed();
    }

    void succeed()
    {
        const auto reached = candidates.begin() + static_cast<std::ptrdiff_t>(inHand);
        std::rotate(candidates.begin(), reached, reached + 1);
        finish(std::exchange(channel, nullptr));
    }

    void expire()
    {
        if (connected)
            return finish(ConnectionFailure{ProbeResult::PeerSilent, place + ": connected, and then silence"});
        if (candidates.empty())
            return finish(explainSilence(place, std::nullopt));
        const auto tried = candidates[inHand].address();
        // Another attempt begins with the next one: this one takes seconds to be known as gone.
        std::rotate(candidates.begin(), candidates.begin() + static_cast<std::ptrdiff_t>(inHand) + 1, candidates.end());
        finish(explainSilence(place, tried));
    }

    void finish(Outcome outcome)
    {
        end();
        if (const auto done = std::exchange(handler, nullptr))
            done(std::move(outcome));
    }

    void end()
    {
        ended = true;
        timer.cancel();
        resolver.cancel();
        boost::system::error_code ignored;
        socket.close(ignored);
        if (channel)
            channel->close();
        channel.reset();
    }

    asio::io_context& io;
    TopologyDevice peer;
    std::string place;
    std::shared_ptr<security::TlsIdentity> identity;
    Handler handler;
    tcp::resolver resolver;
    tcp::socket socket;
    Timer timer;
    std::vector<tcp::endpoint> candidates;
    std::size_t inHand = 0; ///< of these, the one that is tried, or was reached
    std::shared_ptr<TcpChannel> channel;
    bool connected = false;
    bool ended = false;
};

TcpClient::TcpClient(asio::io_context& io, const TopologyDevice& peer, std::shared_ptr<security::TlsIdentity> identity,
                     std::chrono::nanoseconds limit, Handler handler, const std::vector<asio::ip::address>& known)
    : m_attempt(std::make_shared<Attempt>(io, peer, std::move(identity), std::move(handler)))
{
    m_attempt->start(limit, known);
}

TcpClient::~TcpClient() { cancel(); }

std::vector<asio::ip::address> TcpClient::addresses() const
{
    std::vector<asio::ip::address> addresses;
    for (const auto& candidate : m_attempt->candidates)
        addresses.push_back(candidate.address());
    return addresses;
}

void TcpClient::cancel()
{
    m_attempt->handler = nullptr;
    m_attempt->end();
}

} // namespace liena::transport
