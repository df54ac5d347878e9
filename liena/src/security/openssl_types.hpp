// Owners of OpenSSL objects, and the text of OpenSSL's last error.
#pragma once

#include "liena/error.hpp"

#include <openssl/bio.h>
#include <openssl/bn.h>
#include <openssl/evp.h>
#include <openssl/ssl.h>
#include <openssl/x509.h>
#include <openssl/x509v3.h>

#include <memory>
#include <string>
#include <string_view>

namespace liena::security {

template <auto release>
struct Released {
    template <typename T>
    void operator()(T* object) const
    {
        release(object);
    }
};

inline void releaseChain(STACK_OF(X509) * chain) { sk_X509_free(chain); }

using BioPtr = std::unique_ptr<BIO, Released<BIO_free_all>>;
using BignumPtr = std::unique_ptr<BIGNUM, Released<BN_free>>;
using KeyPtr = std::unique_ptr<EVP_PKEY, Released<EVP_PKEY_free>>;
using CertificatePtr = std::unique_ptr<X509, Released<X509_free>>;
using RevocationListPtr = std::unique_ptr<X509_CRL, Released<X509_CRL_free>>;
using ExtensionPtr = std::unique_ptr<X509_EXTENSION, Released<X509_EXTENSION_free>>;
using GeneralNamesPtr = std::unique_ptr<GENERAL_NAMES, Released<GENERAL_NAMES_free>>;
using StorePtr = std::unique_ptr<X509_STORE, Released<X509_STORE_free>>;
using StoreContextPtr = std::unique_ptr<X509_STORE_CTX, Released<X509_STORE_CTX_free>>;
using ContextPtr = std::unique_ptr<SSL_CTX, Released<SSL_CTX_free>>;
using SslPtr = std::unique_ptr<SSL, Released<SSL_free>>;
/// Owns the stack; the certificates in it belong to others.
using ChainPtr = std::unique_ptr<STACK_OF(X509), Released<releaseChain>>;

/// A further owner of the same certificate.
inline CertificatePtr sharedCertificate(const CertificatePtr& certificate)
{
    X509_up_ref(certificate.get());
    return CertificatePtr(certificate.get());
}

/// The reason of this thread's last OpenSSL error in OpenSSL's words; empties the error queue.
std::string takeOpensslReason();

/// A failure with that reason.
inline auto cannotMake(std::string_view what)
{
    return fail(Errc::CertificateInvalid, "OpenSSL cannot make " + std::string(what) + ": " + takeOpensslReason());
}

} // namespace liena::security
