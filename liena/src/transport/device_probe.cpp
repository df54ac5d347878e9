// The probe: resolve, route, connect, TLS, and then the certificates, each step by itself.
#include "liena/probe.hpp"

#include "security/certificate_fields.hpp"
#include "security/tls_identity.hpp"
#include "transport/connection_failure.hpp"
#include "transport/own_interfaces.hpp"

#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ssl/context.hpp>
#include <boost/asio/ssl/error.hpp>
#include <boost/asio/ssl/stream.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

namespace liena {

namespace asio = boost::asio;
using asio::ip::tcp;
using namespace std::chrono_literals;

namespace {

using Found = ProbeStep::Result;
using Clock = std::chrono::steady_clock;

/// Long enough for a refusal to travel back; the device waits 2 s for an Attach.
constexpr auto refusalWait = 400ms;

class Probe {
public:
    explicit Probe(const ProbeRequest& request)
        : m_request(request), m_place(fmt::format("{}:{}", request.target.host, request.target.port))
    {}

    std::vector<ProbeStep> run()
    {
        const bool secured = m_request.security == SecurityMode::Tls;
        const bool own = !secured || ownFiles();
        if (resolve() && route() && connect() && secured && own)
            judge();
        for (const auto* name : {"name", "route", "port", "tls", "identity", "certificate", "revocation", "acceptance"})
            if (std::none_of(m_steps.begin(), m_steps.end(), [&](const ProbeStep& step) { return step.name == name; }))
                note(name, Found::Skipped, secured ? "not reached" : "the topology says mode none: nothing is protected");
        return std::move(m_steps);
    }

private:
    using TlsStream = asio::ssl::stream<tcp::socket&>;

    bool note(std::string name, Found result, std::string text, std::string remedy = {})
    {
        m_steps.push_back({std::move(name), result, std::move(text), std::move(remedy), Clock::now() - m_begun});
        m_begun = Clock::now();
        return result == Found::Ok;
    }

    /// Runs until `done`; false when the limit passed first.
    bool wait(const std::optional<boost::system::error_code>& done, std::chrono::nanoseconds limit)
    {
        m_io.restart();
        const auto end = Clock::now() + limit;
        while (!done && Clock::now() < end)
            if (m_io.run_one_until(end) == 0)
                break;
        return done.has_value();
    }

    bool ownFiles()
    {
        security::TlsIdentity::Site site;
        site.revocations = m_request.revocations;
        auto loaded =
            security::TlsIdentity::load(m_request.certificate, m_request.key, m_request.authority, m_request.self, std::move(site));
        if (!loaded)
            return note("own-files", Found::Failed, loaded.error().what, "mend this first: no session can open from here without it");
        m_identity = loaded.value();
        if (const auto admitted = m_identity->trust().admitSession(); !admitted) {
            note("own-files", Found::Failed, admitted.error().what, "mend this first: no session can open from here without it");
            return true; // the rest can be looked at all the same
        }
        return note("own-files", Found::Ok,
                    fmt::format("certificate, key and authority belong together and name {}", m_request.self.toString()));
    }

    bool resolve()
    {
        boost::system::error_code notNumeric;
        const auto address = asio::ip::make_address(m_request.target.host, notNumeric);
        if (!notNumeric) {
            m_endpoints.emplace_back(address, m_request.target.port);
            return note("name", Found::Ok, fmt::format("{} is an address", m_request.target.host));
        }
        std::optional<boost::system::error_code> done;
        tcp::resolver resolver(m_io);
        resolver.async_resolve(m_request.target.host, std::to_string(m_request.target.port),
                               [&](const boost::system::error_code& error, const tcp::resolver::results_type& results) {
                                   done = error;
                                   m_endpoints.assign(results.begin(), results.end());
                               });
        const bool answered = wait(done, m_request.limit);
        resolver.cancel();
        m_io.restart();
        if (!answered)
            m_io.run(); // the handler refers to this frame
        if (answered && !*done && !m_endpoints.empty())
            return note("name", Found::Ok, fmt::format("{} is {}", m_request.target.host, m_endpoints.front().address().to_string()));
        return note("name", Found::Failed,
                    fmt::format("the name {} cannot be resolved{}", m_request.target.host,
                                answered ? fmt::format(" ({})", done->message()) : " in time"),
                    "write the device's address into the topology, or its name into /etc/hosts or the site's name server");
    }

    bool route()
    {
        boost::system::error_code error;
        const auto target = m_endpoints.front().address();
        const auto local = transport::addressTowards(target, error);
        if (local)
            return note("route", Found::Ok, fmt::format("from {} to {}", local->to_string(), target.to_string()));
        const auto found = transport::explainConnect(error, target.to_string(), target);
        return note("route", Found::Failed, found.detail, std::string(explain(found.probe)));
    }

    bool connect()
    {
        std::optional<boost::system::error_code> done;
        asio::async_connect(m_socket, m_endpoints, [&](const boost::system::error_code& error, const tcp::endpoint&) { done = error; });
        const bool answered = wait(done, m_request.limit);
        if (answered && !*done)
            return note("port", Found::Ok, fmt::format("{} accepts connections", m_place));
        boost::system::error_code ignored;
        m_socket.close(ignored);
        m_io.restart();
        m_io.run();
        const auto target = m_endpoints.back().address();
        const auto found = answered ? transport::explainConnect(*done, m_place, target) : transport::explainSilence(m_place, target);
        if (!answered && found.probe == ProbeResult::HostUnreachable)
            return note("port", Found::Failed, fmt::format("{} does not answer", m_place),
                        "power and cable of the device's computer, the line between, and a firewall that drops silently");
        return note("port", Found::Failed, found.detail, std::string(explain(found.probe)));
    }

    void judge()
    {
        SSL_CTX_up_ref(m_identity->clientContext()); // the wrapper gives this reference back
        asio::ssl::context context(m_identity->clientContext());
        TlsStream tls(m_socket, context);
        std::optional<boost::system::error_code> done;
        tls.async_handshake(asio::ssl::stream_base::client, [&](const boost::system::error_code& error) { done = error; });
        if (!wait(done, m_request.limit)) {
            note("tls", Found::Failed, fmt::format("{} accepts connections and does not answer the TLS handshake", m_place),
                 std::string(explain(ProbeResult::PeerSilent)));
        } else if (*done) {
            handshakeFailed(*done, SSL_get_verify_result(tls.native_handle()));
        } else {
            note("tls", Found::Ok, fmt::format("{}, {}", SSL_get_version(tls.native_handle()), SSL_get_cipher_name(tls.native_handle())));
            judgePeer(tls.native_handle());
            awaitRefusal(tls);
        }
        boost::system::error_code ignored;
        m_socket.close(ignored);
        m_io.restart();
        m_io.run(); // what is in flight refers to this frame
    }

    void handshakeFailed(const boost::system::error_code& error, long verified)
    {
        const bool tls = error.category() == asio::error::get_ssl_category();
        const auto words = tls ? security::explainTlsFailure(static_cast<unsigned long>(error.value()), verified)
                               : "the connection ended during the TLS handshake: " + error.message();
        if (verified == X509_V_OK)
            return (void)note("tls", Found::Failed, words, std::string(explain(ProbeResult::TlsFailure)));
        note("tls", Found::Ok, "the device speaks TLS 1.3 and shows a certificate");
        if (verified == X509_V_ERR_CERT_REVOKED)
            note("revocation", Found::Failed, words,
                 "find out why; if it is meant to work here, issue it a new certificate and start it again");
        else if (verified == X509_V_ERR_CERT_HAS_EXPIRED || verified == X509_V_ERR_CERT_NOT_YET_VALID)
            note("certificate", Found::Failed, words, "compare the clocks, then issue the device a new certificate and start it again");
        else
            note("identity", Found::Failed, words, std::string(explain(ProbeResult::TlsFailure)));
    }

    void judgePeer(SSL* connection)
    {
        const auto meant = security::requirePeer(connection, m_request.target.id);
        if (!meant)
            return (void)note("identity", Found::Failed, meant.error().what,
                              "another device has this address: compare addresses and certificates");
        note("identity", Found::Ok, fmt::format("{} ({})", m_request.target.name, m_request.target.id.toString()));
        auto end = std::chrono::system_clock::time_point::max();
        const auto* chain = SSL_get0_verified_chain(connection);
        for (int i = 0; i < sk_X509_num(chain); ++i)
            end = std::min(end, security::timeOf(X509_get0_notAfter(sk_X509_value(chain, i))));
        const auto text = fmt::format("the device's certificate ends on {}", security::dateText(end));
        if (end <= std::chrono::system_clock::now() + leastRemaining)
            note("certificate", Found::Failed, text + ", and no session begins in its last 24 hours",
                 "issue the device a new certificate (`liena pki issue --replace`) and start it again");
        else
            note("certificate", Found::Ok, text);
        revocation();
    }

    void revocation()
    {
        const auto& list = m_identity->trust().revocations();
        if (const auto reliable = list.requireReliable(std::chrono::system_clock::now()); !reliable)
            return (void)note("revocation", Found::Failed, reliable.error().what, "copy the newest ca.crl here");
        if (!list.hasList())
            return (void)note("revocation", Found::Ok, fmt::format("nobody is revoked: there is no list {}", list.file().string()));
        const auto info = list.info();
        note("revocation", Found::Ok,
             fmt::format("not among the {} of list {} (number {}, until {})", info.revoked.size(), list.file().string(), info.number,
                         security::dateText(info.ends)));
    }

    /// In TLS 1.3 the other end judges our certificate after the handshake: its refusal is the first thing that can be read.
    void awaitRefusal(TlsStream& tls)
    {
        std::array<char, 1> byte{};
        std::optional<boost::system::error_code> done;
        tls.async_read_some(asio::buffer(byte), [&](const boost::system::error_code& error, std::size_t) { done = error; });
        if (!wait(done, refusalWait))
            note("acceptance", Found::Ok, "the device lets this identity in");
        else if (*done && done->category() == asio::error::get_ssl_category() && *done != asio::ssl::error::stream_truncated)
            note("acceptance", Found::Failed, security::explainTlsFailure(static_cast<unsigned long>(done->value()), X509_V_OK),
                 "the device refuses this computer's certificate; its log says why as well");
        else if (*done)
            note("acceptance", Found::Failed, "the device closed the connection", "its log says why");
        else
            note("acceptance", Found::Failed, "the other end speaks first, which no LiENa device does", "look what program listens there");
        boost::system::error_code ignored;
        m_socket.close(ignored);
        m_io.restart();
        m_io.run(); // the handler refers to this frame
    }

    ProbeRequest m_request;
    std::string m_place;
    std::vector<ProbeStep> m_steps;
    Clock::time_point m_begun = Clock::now();
    asio::io_context m_io{1};
    tcp::socket m_socket{m_io};
    std::vector<tcp::endpoint> m_endpoints;
    std::shared_ptr<security::TlsIdentity> m_identity;
};

} // namespace

std::string_view toString(ProbeStep::Result result)
{
    switch (result) {
    case Found::Ok:
        return "ok";
    case Found::Failed:
        return "failed";
    case Found::Skipped:
        return "skipped";
    }
    return "unknown";
}

std::vector<ProbeStep> probeDevice(const ProbeRequest& request) { return Probe(request).run(); }

} // namespace liena
