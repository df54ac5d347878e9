// How a device shows who it is, and makes sure of who its peers are: TLS 1.3, both ends verified (protocol section 6).
#pragma once

#include "liena/device_id.hpp"
#include "liena/error.hpp"
#include "security/openssl_types.hpp"
#include "security/peer_trust.hpp"

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

namespace liena::security {

/// The two contexts that all connections of a device are made from. They do not change after load(); connections keep what they need of
/// them alive, so this may go before they do.
class TlsIdentity {
public:
    /// What a site decides besides the device's own three files.
    struct Site {
        std::filesystem::path revocations{}; ///< empty: revocationsBeside() the authority
        WallClock clock = std::chrono::system_clock::now;
        LogSink log = [](LogLevel, std::string_view) {};
    };

    /// Everything that can be known to be wrong with the files is an error. A certificate that is too near its end for new sessions is not:
    /// trust().admitSession() says that.
    static Result<std::shared_ptr<TlsIdentity>> load(const std::filesystem::path& certificate, const std::filesystem::path& key,
                                                     const std::filesystem::path& authority, DeviceId self, Site site);
    static Result<std::shared_ptr<TlsIdentity>> load(const std::filesystem::path& certificate, const std::filesystem::path& key,
                                                     const std::filesystem::path& authority, DeviceId self)
    {
        return load(certificate, key, authority, self, Site());
    }

    DeviceId self() const { return m_self; }

    /// Whom this device believes; the contexts ask it in every handshake.
    PeerTrust& trust() { return *m_trust; }

    /// For accepted connections: a peer without a certificate or without ALPN `liena/1` does not get through the handshake.
    SSL_CTX* serverContext() const { return m_server.get(); }

    /// For connections we make; offers ALPN `liena/1`.
    SSL_CTX* clientContext() const { return m_client.get(); }

private:
    TlsIdentity(DeviceId self, std::shared_ptr<PeerTrust> trust, ContextPtr server, ContextPtr client);

    DeviceId m_self;
    std::shared_ptr<PeerTrust> m_trust; ///< shared with the contexts, which may outlive this
    ContextPtr m_server;
    ContextPtr m_client;
};

/// Who is at the other end of a connection whose handshake is complete. Ask this before anything is read or written: an answer means that
/// the connection is TLS 1.3 with a fresh handshake and ALPN `liena/1`, and that the certificate names exactly this device. The side that
/// connected completes the handshake first: if the other end refuses our certificate, the alert comes with the first read.
Result<DeviceId> peerDevice(SSL* connection);

/// As peerDevice(), for the side that connected and means a certain device.
Result<void> requirePeer(SSL* connection, DeviceId meant);

/// Why a handshake failed, in words for a person. `opensslError` is of ERR_get_error() or the value of an Asio SSL error code,
/// `verifyResult` of SSL_get_verify_result().
std::string explainTlsFailure(unsigned long opensslError, long verifyResult);

} // namespace liena::security
