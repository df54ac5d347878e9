// Reading certificates, with nothing taken for granted.
#include "security/certificate_fields.hpp"

#include "liena/log.hpp"
#include "security/device_uri.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <ctime>

namespace liena::security {

namespace {

auto refused(X509* certificate, std::string_view reason)
{
    return fail(Errc::CertificateInvalid, fmt::format("the certificate of \"{}\" {}; issue one with `liena pki issue`",
                                                      printable(nameText(X509_get_subject_name(certificate))), reason));
}

} // namespace

std::string nameText(const X509_NAME* name)
{
    const BioPtr bio(BIO_new(BIO_s_mem()));
    X509_NAME_print_ex(bio.get(), name, 0, (XN_FLAG_ONELINE & ~ASN1_STRFLGS_ESC_MSB) | XN_FLAG_DN_REV);
    char* data = nullptr;
    const auto size = BIO_get_mem_data(bio.get(), &data);
    return size > 0 ? std::string(data, static_cast<std::size_t>(size)) : std::string();
}

std::chrono::system_clock::time_point timeOf(const ASN1_TIME* time)
{
    std::tm parts{};
    if (ASN1_TIME_to_tm(time, &parts) != 1)
        return {};
    using Clock = std::chrono::system_clock;
    const auto cut = std::clamp(std::chrono::seconds(::timegm(&parts)), std::chrono::seconds(0),
                                std::chrono::floor<std::chrono::seconds>(Clock::time_point::max()).time_since_epoch());
    return Clock::time_point(cut);
}

std::string dateText(std::chrono::system_clock::time_point time)
{
    return fmt::format("{:%Y-%m-%d %H:%M} UTC", fmt::gmtime(std::chrono::system_clock::to_time_t(time)));
}

Result<std::vector<std::string>> urisOf(X509* certificate)
{
    int critical = 0; // -1: no such extension, -2: more than one
    const GeneralNamesPtr names(static_cast<GENERAL_NAMES*>(X509_get_ext_d2i(certificate, NID_subject_alt_name, &critical, nullptr)));
    if (!names && critical != -1) {
        takeOpensslReason();
        return refused(certificate, "has damaged or repeated alternative names");
    }
    std::vector<std::string> uris;
    for (int i = 0; names && i < sk_GENERAL_NAME_num(names.get()); ++i) {
        const auto* name = sk_GENERAL_NAME_value(names.get(), i);
        if (name->type != GEN_URI)
            continue;
        const auto* text = name->d.uniformResourceIdentifier;
        uris.emplace_back(reinterpret_cast<const char*>(ASN1_STRING_get0_data(text)), static_cast<std::size_t>(ASN1_STRING_length(text)));
    }
    return uris;
}

Result<DeviceId> deviceOf(X509* certificate)
{
    if ((X509_get_extension_flags(certificate) & EXFLAG_INVALID) != 0)
        return refused(certificate, "has damaged extensions");
    if (X509_check_ca(certificate) != 0)
        return refused(certificate, "is an authority's, not a device's");
    constexpr auto bothUsages = static_cast<std::uint32_t>(XKU_SSL_SERVER | XKU_SSL_CLIENT);
    // Without the extension OpenSSL answers "every usage".
    const bool limited = (X509_get_extension_flags(certificate) & EXFLAG_XKUSAGE) != 0;
    if (!limited || (X509_get_extended_key_usage(certificate) & bothUsages) != bothUsages)
        return refused(certificate, "does not carry the extended key usages of both client and server");
    const auto uris = urisOf(certificate);
    if (!uris)
        return uris.as_failure();
    std::vector<std::string> claims;
    for (const auto& uri : uris.value())
        if (claimsDevice(uri))
            claims.push_back(uri);
    if (claims.empty())
        return refused(certificate, "names no device (no alternative name urn:liena:device:…)");
    if (claims.size() > 1)
        return refused(certificate, "names more than one device");
    const auto device = deviceFromUri(claims.front());
    if (!device || !device->isValidDevice())
        return refused(certificate, fmt::format("names a device that cannot be: {}", printable(claims.front())));
    return *device;
}

} // namespace liena::security
