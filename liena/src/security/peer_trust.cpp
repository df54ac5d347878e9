// Judging a peer's chain during the handshake, and both ends' certificates before a session begins.
#include "security/peer_trust.hpp"

#include "security/certificate_fields.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace liena::security {

namespace {

using Time = std::chrono::system_clock::time_point;

void release(void*, void* held, CRYPTO_EX_DATA*, int, long, void*) { delete static_cast<std::shared_ptr<PeerTrust>*>(held); }

int contextPlace()
{
    static const int place = SSL_CTX_get_ex_new_index(0, nullptr, nullptr, nullptr, release);
    return place;
}

bool endsSoon(Time end, Time now) { return end <= now + leastRemaining; }

auto tooNearItsEnd(const std::string& whose, Time end, std::string_view remedy)
{
    return fail(Errc::CertificateInvalid, fmt::format("{} ends on {}, and no session begins with less than {} hours left; {}", whose,
                                                      dateText(end), leastRemaining.count(), remedy));
}

} // namespace

PeerTrust::PeerTrust(const Identity& identity, std::filesystem::path certificateFile, Revocations revocations, WallClock clock)
    : m_own(sharedCertificate(identity.certificates.front())),
      m_ownEnd(identity.end),
      m_certificateFile(std::move(certificateFile)),
      m_revocations(std::move(revocations)),
      m_clock(std::move(clock))
{}

bool PeerTrust::install(std::shared_ptr<PeerTrust> trust, SSL_CTX* context)
{
    auto* const raw = trust.get();
    auto held = std::make_unique<std::shared_ptr<PeerTrust>>(std::move(trust));
    if (SSL_CTX_set_ex_data(context, contextPlace(), held.get()) != 1)
        return false;
    static_cast<void>(held.release()); // the context's now
    SSL_CTX_set_cert_verify_callback(context, judge, raw);
    return true;
}

int PeerTrust::judge(X509_STORE_CTX* chain, void* trust)
{
    auto& self = *static_cast<PeerTrust*>(trust);
    X509_STORE_CTX_set_time(chain, 0, std::chrono::system_clock::to_time_t(self.m_clock()));
    return X509_verify_cert(chain) == 1 && self.holds(chain) ? 1 : 0;
}

bool PeerTrust::holds(X509_STORE_CTX* chain)
{
    m_revocations.refresh();
    const auto* links = X509_STORE_CTX_get0_chain(chain);
    for (int i = 0; i < sk_X509_num(links); ++i)
        if (m_revocations.revokes(sk_X509_value(links, i))) {
            X509_STORE_CTX_set_error_depth(chain, i);
            X509_STORE_CTX_set_error(chain, X509_V_ERR_CERT_REVOKED);
            return false;
        }
    return true;
}

Result<void> PeerTrust::admitSession()
{
    m_revocations.refresh();
    const auto now = m_clock();
    if (auto reliable = m_revocations.requireReliable(now); !reliable)
        return reliable;
    if (m_revocations.revokes(m_own.get()))
        return fail(Errc::CertificateInvalid,
                    fmt::format("this device's certificate {} was revoked; issue a new one and start again", m_certificateFile.string()));
    if (endsSoon(m_ownEnd, now))
        return tooNearItsEnd(fmt::format("this device's certificate {}", m_certificateFile.string()), m_ownEnd,
                             "issue a new one with `liena pki issue --replace` and start again");
    return ok();
}

Result<void> PeerTrust::admitSession(SSL* connection)
{
    if (auto own = admitSession(); !own)
        return own;
    const auto* links = SSL_get0_verified_chain(connection);
    if (sk_X509_num(links) < 1)
        return fail(Errc::CertificateInvalid, "the peer was not verified");
    auto end = Time::max();
    for (int i = 0; i < sk_X509_num(links); ++i)
        end = std::min(end, timeOf(X509_get0_notAfter(sk_X509_value(links, i))));
    const auto device = deviceOf(sk_X509_value(links, 0));
    if (endsSoon(end, m_clock()))
        return tooNearItsEnd(fmt::format("the certificate of {}", device ? device.value().toString() : "the peer"), end,
                             "issue a new one for it and start it again");
    return ok();
}

} // namespace liena::security
