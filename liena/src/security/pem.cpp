// PEM files read strictly and written in memory.
#include "security/pem.hpp"

#include "security/whole_file.hpp"

#include <openssl/crypto.h>
#include <openssl/err.h>
#include <openssl/pem.h>

#include <fmt/format.h>

namespace liena::security {

namespace {

constexpr std::size_t mostCertificates = 16;

BioPtr reader(const std::string& text) { return BioPtr(BIO_new_mem_buf(text.data(), static_cast<int>(text.size()))); }

/// OpenSSL would ask on the terminal otherwise.
int noPassphrase(char*, int, int, void* asked)
{
    *static_cast<bool*>(asked) = true;
    return -1;
}

Result<std::string> textOf(BIO* bio)
{
    char* data = nullptr;
    const auto size = BIO_get_mem_data(bio, &data);
    if (size <= 0)
        return fail(Errc::CertificateInvalid, fmt::format("OpenSSL cannot write PEM: {}", takeOpensslReason()));
    return std::string(data, static_cast<std::size_t>(size));
}

auto invalidPem(const std::filesystem::path& file, std::string_view reason)
{
    return fail(Errc::CertificateInvalid, fmt::format("{}: {}", file.string(), reason));
}

} // namespace

Result<std::vector<CertificatePtr>> readCertificates(const std::filesystem::path& file)
{
    const auto text = readFile(file);
    if (!text)
        return text.as_failure();
    const auto bio = reader(text.value());
    std::vector<CertificatePtr> certificates;
    bool asked = false;
    while (CertificatePtr certificate{PEM_read_bio_X509(bio.get(), nullptr, noPassphrase, &asked)}) {
        if (certificates.size() == mostCertificates)
            return invalidPem(file, "holds more than 16 certificates; keep only those of this site");
        certificates.push_back(std::move(certificate));
    }
    const bool ended = ERR_GET_REASON(ERR_peek_last_error()) == PEM_R_NO_START_LINE;
    const auto reason = takeOpensslReason();
    if (certificates.empty() && ended)
        return invalidPem(file, "holds no certificate; expected is PEM text with a line -----BEGIN CERTIFICATE-----");
    if (!ended)
        return invalidPem(file, fmt::format("holds a damaged certificate ({}); copy or issue it again", reason));
    return certificates;
}

Result<KeyPtr> readKey(const std::filesystem::path& file)
{
    auto text = readFile(file, Secrecy::Secret);
    if (!text)
        return text.as_failure();
    const auto bio = reader(text.value());
    bool asked = false;
    KeyPtr key(PEM_read_bio_PrivateKey(bio.get(), nullptr, noPassphrase, &asked));
    OPENSSL_cleanse(text.value().data(), text.value().size());
    const auto reason = takeOpensslReason();
    if (asked)
        return invalidPem(file, "the key is encrypted, and a device that starts by itself cannot be asked for a passphrase; "
                                "use a key without one, readable by its owner only");
    if (!key)
        return invalidPem(file, fmt::format("holds no private key in PEM form ({}); issue it again", reason));
    return key;
}

Result<void> requireMatch(X509* certificate, EVP_PKEY* key, const std::filesystem::path& certificateFile,
                          const std::filesystem::path& keyFile)
{
    if (X509_check_private_key(certificate, key) == 1)
        return ok();
    ERR_clear_error();
    return fail(Errc::CertificateInvalid, fmt::format("{} is not the key of {}; use the two files that were issued together",
                                                      keyFile.string(), certificateFile.string()));
}

Result<std::string> toPem(X509* certificate)
{
    const BioPtr bio(BIO_new(BIO_s_mem()));
    PEM_write_bio_X509(bio.get(), certificate);
    return textOf(bio.get());
}

Result<std::string> toPem(EVP_PKEY* key)
{
    const BioPtr bio(BIO_new(BIO_s_secmem()));
    PEM_write_bio_PKCS8PrivateKey(bio.get(), key, nullptr, nullptr, 0, nullptr, nullptr);
    return textOf(bio.get());
}

} // namespace liena::security
