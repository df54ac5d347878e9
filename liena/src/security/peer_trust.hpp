// Whom a device believes, and until when: the authority's signature, the revocation list, and the ends of certificates.
#pragma once

#include "liena/certificates.hpp"
#include "liena/error.hpp"
#include "security/identity.hpp"
#include "security/revocations.hpp"

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>

namespace liena::security {

/// The wall clock. Only certificates are judged by it; timers are monotonic.
using WallClock = std::function<std::chrono::system_clock::time_point()>;

/// Lives as long as the TLS contexts and connections that ask it. One thread at a time.
class PeerTrust {
public:
    PeerTrust(const Identity& identity, std::filesystem::path certificateFile, Revocations revocations, WallClock clock);

    /// Has every connection of `context` judged here, and is kept alive by it.
    static bool install(std::shared_ptr<PeerTrust> trust, SSL_CTX* context);

    /// Whether a new session may begin, as far as this device knows by itself: its certificate was not revoked and does not end within
    /// leastRemaining, and the revocation list can be relied on. Sessions that are open are not asked.
    Result<void> admitSession();

    /// The same, and the certificate at the other end of `connection` does not end within leastRemaining either.
    Result<void> admitSession(SSL* connection);

    const Revocations& revocations() const { return m_revocations; }

private:
    static int judge(X509_STORE_CTX* chain, void* trust);
    bool holds(X509_STORE_CTX* chain);

    CertificatePtr m_own;
    std::chrono::system_clock::time_point m_ownEnd; ///< the earliest of our chain
    std::filesystem::path m_certificateFile;
    Revocations m_revocations;
    WallClock m_clock;
};

} // namespace liena::security
