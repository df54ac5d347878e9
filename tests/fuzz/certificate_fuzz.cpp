// Which device a certificate stands for: certificates of any bytes, certificates of chosen parts, and names alone.
#include "fuzz_input.hpp"
#include "fuzz_target.hpp"
#include "security/certificate_fields.hpp"
#include "security/device_uri.hpp"
#include "security/issuing.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

using namespace liena;
using namespace liena::security;
using namespace liena::fuzz;
using namespace std::chrono_literals;

namespace {

std::string textFrom(std::span<const std::byte> bytes) { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }

void checkUri(const std::string& uri)
{
    const auto device = deviceFromUri(uri);
    if (!device)
        return;
    expect(deviceUri(*device) == uri, "a name that is read is written again");
    expect(claimsDevice(uri), "a name that names a device claims to");
}

void checkCertificate(X509* certificate)
{
    const auto uris = urisOf(certificate);
    const auto device = deviceOf(certificate);
    nameText(X509_get_subject_name(certificate));
    dateText(timeOf(X509_get0_notAfter(certificate)));
    if (uris)
        for (const auto& uri : uris.value())
            checkUri(uri);
    if (!device) {
        expect(!device.error().what.empty(), "a refusal says why");
        return;
    }
    expect(uris.has_value(), "who stands for a device has names");
    expect(device.value().isValidDevice() && !device.value().isBroadcast(), "a certificate stands for a device that can be");
    const auto claims = std::count_if(uris.value().begin(), uris.value().end(), [](const std::string& u) { return claimsDevice(u); });
    expect(claims == 1, "a certificate stands for one device");
    const auto own = deviceUri(device.value());
    expect(std::find(uris.value().begin(), uris.value().end(), own) != uris.value().end(), "by its whole name, byte for byte");
    expect(X509_check_ca(certificate) == 0, "an authority stands for no device");
    const auto usage = X509_get_extended_key_usage(certificate);
    expect(usage != UINT32_MAX && (usage & XKU_SSL_SERVER) != 0 && (usage & XKU_SSL_CLIENT) != 0, "a device is client and server");
}

void checkBytes(std::span<const std::byte> bytes)
{
    const auto* at = reinterpret_cast<const unsigned char*>(bytes.data());
    const CertificatePtr certificate(d2i_X509(nullptr, &at, static_cast<long>(bytes.size())));
    if (certificate)
        checkCertificate(certificate.get());
    takeOpensslReason();
}

/// A device's certificate by an authority of ours, made once.
X509* sample()
{
    static const auto certificate = [] {
        auto authorityKey = makeKey();
        auto authority = makeAuthority(authorityKey.value().get(), "fuzz", 24h);
        auto made = makeDeviceCertificate(authorityKey.value().get(), DeviceId(0x40018208U), "cockpit", 24h, authority.value().get(),
                                          authorityKey.value().get());
        return std::move(made.value());
    }();
    return certificate.get();
}

void addName(GENERAL_NAMES* names, int type, const std::string& text)
{
    auto* name = GENERAL_NAME_new();
    auto* value = ASN1_IA5STRING_new();
    ASN1_STRING_set(value, text.data(), static_cast<int>(text.size()));
    GENERAL_NAME_set0_value(name, type, value);
    sk_GENERAL_NAME_push(names, name);
}

void replace(X509* certificate, int kind, const char* value)
{
    if (const int at = X509_get_ext_by_NID(certificate, kind, -1); at >= 0)
        X509_EXTENSION_free(X509_delete_ext(certificate, at));
    if (value == nullptr)
        return;
    const ExtensionPtr extension(X509V3_EXT_nconf_nid(nullptr, nullptr, kind, value));
    expect(extension != nullptr && X509_add_ext(certificate, extension.get(), -1) == 1, "an extension is added");
}

/// A device's name, one with another byte in it, or anything.
std::string chosenName(FuzzInput& input)
{
    const auto kind = input.below(4);
    if (kind == 0)
        return textFrom(input.take(input.below(24)));
    auto name = deviceUri(DeviceId(0x40018208U ^ input.number<std::uint32_t>()));
    if (kind == 1)
        name[input.below(name.size())] = static_cast<char>(input.number<std::uint8_t>());
    return name;
}

/// Names and usages as somebody with the authority's key could put them together.
void checkChosen(FuzzInput& input)
{
    const CertificatePtr certificate(X509_dup(sample()));
    constexpr std::array<const char*, 5> usages{"clientAuth,serverAuth", "serverAuth", "clientAuth", "codeSigning", nullptr};
    replace(certificate.get(), NID_ext_key_usage, usages[input.below(usages.size())]);
    constexpr std::array<const char*, 3> keyUsages{"critical,digitalSignature", "critical,digitalSignature,keyCertSign", nullptr};
    replace(certificate.get(), NID_key_usage, keyUsages[input.below(keyUsages.size())]);
    replace(certificate.get(), NID_basic_constraints, input.below(8) == 0 ? "critical,CA:TRUE" : "critical,CA:FALSE");
    replace(certificate.get(), NID_subject_alt_name, nullptr);
    const auto extensions = 1 + (input.below(8) == 0 ? 1 : 0);
    for (int i = 0; i < extensions; ++i) {
        const GeneralNamesPtr names(sk_GENERAL_NAME_new_null());
        const auto count = input.below(4);
        for (std::size_t name = 0; name < count; ++name)
            addName(names.get(), input.below(8) == 0 ? GEN_DNS : GEN_URI, chosenName(input));
        X509_add1_ext_i2d(certificate.get(), NID_subject_alt_name, names.get(), 0, X509V3_ADD_APPEND);
    }
    // The certificate must be read anew: OpenSSL remembers what it once understood of one.
    unsigned char* bytes = nullptr;
    const int length = i2d_re_X509_tbs(certificate.get(), nullptr) > 0 ? i2d_X509(certificate.get(), &bytes) : 0;
    if (length > 0)
        checkBytes(std::as_bytes(std::span(bytes, static_cast<std::size_t>(length))));
    OPENSSL_free(bytes);
    takeOpensslReason();
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    FuzzInput input(data, size);
    const auto kind = input.below(3);
    if (kind == 0)
        checkBytes(input.rest());
    else if (kind == 1)
        checkChosen(input);
    else
        checkUri(textFrom(input.rest()));
    return 0;
}
