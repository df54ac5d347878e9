// The rows of the matrix and their signatures.
#include "support/certificate_matrix.hpp"

#include "security/device_uri.hpp"

namespace liena::test {

using security::deviceUri;

Recipe goodRecipe(DeviceId device) { return {.uris = {deviceUri(device)}, .commonName = "device", .endHours = 48}; }

Recipe changed(DeviceId device, const Change& change)
{
    auto recipe = goodRecipe(device);
    change(recipe);
    return recipe;
}

namespace {

std::vector<CertificateRow> certificateRows(DeviceId device, DeviceId other)
{
    const auto uri = deviceUri(device);
    const auto good = [&] { return goodRecipe(device); };
    const auto naming = [&](std::vector<std::string> uris) { return changed(device, [&](Recipe& r) { r.uris = std::move(uris); }); };
    const auto with = [&](const Change& change) { return changed(device, change); };
    const auto none = "names no device";
    const auto impossible = "names a device that cannot be";
    const auto unknown = "unknown authority";
    const auto both = "both client and server";
    const auto weak = "too weak";
    return {
        {.name = "self-signed", .recipe = good(), .signer = Signer::Itself, .serverSays = unknown, .clientSays = unknown},
        {.name = "another authority", .recipe = good(), .signer = Signer::OtherSite, .serverSays = unknown, .clientSays = unknown},
        {.name = "two authorities between", .recipe = good(), .signer = Signer::TwoBelow, .serverSays = unknown, .clientSays = unknown},
        {.name = "another device's id", .recipe = naming({deviceUri(other)}), .serverSays = "was meant", .clientSays = "was meant"},
        {.name = "two devices", .recipe = naming({uri, deviceUri(other)}), .serverSays = "more than one", .clientSays = "more than one"},
        {.name = "the same device twice", .recipe = naming({uri, uri}), .serverSays = "more than one", .clientSays = "more than one"},
        {.name = "NUL after the id", .recipe = naming({uri + '\0'}), .serverSays = impossible, .clientSays = impossible},
        {.name = "NUL and more after the id",
         .recipe = naming({uri + std::string("\0.example", 9)}),
         .serverSays = impossible,
         .clientSays = impossible},
        {.name = "NUL before the id", .recipe = naming({std::string("\0", 1) + uri}), .serverSays = none, .clientSays = none},
        {.name = "wildcard", .recipe = naming({"urn:liena:device:*"}), .serverSays = impossible, .clientSays = impossible},
        {.name = "wildcard digit", .recipe = naming({"urn:liena:device:0000820?"}), .serverSays = impossible, .clientSays = impossible},
        {.name = "upper case digits", .recipe = naming({"urn:liena:device:0000820A"}), .serverSays = impossible, .clientSays = impossible},
        {.name = "upper case prefix", .recipe = naming({"URN:LIENA:DEVICE:00008208"}), .serverSays = impossible, .clientSays = impossible},
        {.name = "0x before the digits",
         .recipe = naming({"urn:liena:device:0x00008208"}),
         .serverSays = impossible,
         .clientSays = impossible},
        {.name = "seven digits", .recipe = naming({"urn:liena:device:0008208"}), .serverSays = impossible, .clientSays = impossible},
        {.name = "the broadcast id", .recipe = naming({"urn:liena:device:ffffffff"}), .serverSays = impossible, .clientSays = impossible},
        {.name = "the reserved index 7",
         .recipe = naming({"urn:liena:device:0000820f"}),
         .serverSays = impossible,
         .clientSays = impossible},
        {.name = "a reserved class", .recipe = naming({"urn:liena:device:80008208"}), .serverSays = impossible, .clientSays = impossible},
        {.name = "nine digits", .recipe = naming({uri + "0"}), .serverSays = impossible, .clientSays = impossible},
        {.name = "a space after the id", .recipe = naming({uri + " "}), .serverSays = impossible, .clientSays = impossible},
        {.name = "good id beside a bad one",
         .recipe = naming({uri, "urn:liena:device:*"}),
         .serverSays = "more than one",
         .clientSays = "more than one"},
        {.name = "id in the common name only",
         .recipe = with([&](Recipe& r) { r.uris.clear(), r.commonName = uri; }),
         .serverSays = none,
         .clientSays = none},
        {.name = "id in a DNS name only",
         .recipe = with([&](Recipe& r) { r.uris.clear(), r.dnsNames = {uri}; }),
         .serverSays = none,
         .clientSays = none},
        {.name = "no names at all",
         .recipe = with([](Recipe& r) { r.uris.clear(), r.commonName.clear(); }),
         .serverSays = none,
         .clientSays = none},
        {.name = "expired",
         .recipe = with([](Recipe& r) { r.startHours = -2, r.endHours = -1; }),
         .serverSays = "expired",
         .clientSays = "expired"},
        {.name = "not yet valid",
         .recipe = with([](Recipe& r) { r.startHours = 1; }),
         .serverSays = "not valid yet",
         .clientSays = "not valid yet"},
        {.name = "usage server only", .recipe = with([](Recipe& r) { r.usage = "serverAuth"; }), .serverSays = both, .clientSays = both},
        {.name = "usage client only", .recipe = with([](Recipe& r) { r.usage = "clientAuth"; }), .serverSays = both, .clientSays = both},
        {.name = "usage code signing", .recipe = with([](Recipe& r) { r.usage = "codeSigning"; }), .serverSays = both, .clientSays = both},
        {.name = "no usage", .recipe = with([](Recipe& r) { r.usage.clear(); }), .serverSays = both, .clientSays = both},
        {.name = "an authority of its own",
         .recipe = with([](Recipe& r) { r.authority = true; }),
         .serverSays = "an authority's",
         .clientSays = "an authority's"},
        {.name = "RSA of 1024 bits", .recipe = with([](Recipe& r) { r.key = KeyKind::Rsa1024; }), .serverSays = weak, .clientSays = weak},
        {.name = "elliptic curve of 224 bits",
         .recipe = with([](Recipe& r) { r.key = KeyKind::P224; }),
         .serverSays = "no",
         .clientSays = "in common"},
        {.name = "signed with SHA-1", .recipe = with([](Recipe& r) { r.sha1 = true; }), .serverSays = weak, .clientSays = weak},
    };
}

std::vector<CertificateRow> connectionRows(DeviceId device)
{
    const auto good = [&] { return goodRecipe(device); };
    const auto with = [&](const Change& change) { return changed(device, change); };
    const auto version = "no TLS version in common";
    const auto protocol = "application protocol";
    return {
        {.name = "TLS 1.2", .recipe = good(), .highestVersion = TLS1_2_VERSION, .serverSays = version, .clientSays = version},
        {.name = "no ALPN", .recipe = good(), .alpn = "", .serverSays = protocol, .clientSays = protocol},
        {.name = "another ALPN", .recipe = good(), .alpn = "h2", .serverSays = protocol, .clientSays = protocol},
        {.name = "a later version in ALPN", .recipe = good(), .alpn = "liena/12", .serverSays = protocol, .clientSays = protocol},
        {.name = "costly key exchange only", .recipe = good(), .groups = "ffdhe8192", .serverSays = "in common", .clientSays = "in common"},
        {.name = "certificate of 20 KiB",
         .recipe = with([](Recipe& r) { r.dnsNames.assign(100, std::string(200, 'x')); }),
         .serverSays = "too long",
         .clientSays = "too long"},
        {.name = "no certificate",
         .recipe = good(),
         .showsCertificate = false,
         .serverSays = "showed no certificate",
         .clientSays = ""}, // a TLS 1.3 server cannot do without one; see refusesServerWithoutCertificate
    };
}

} // namespace

std::vector<CertificateRow> certificateMatrix(DeviceId device, DeviceId other)
{
    auto rows = certificateRows(device, other);
    for (auto& row : connectionRows(device))
        rows.push_back(std::move(row));
    rows.push_back({.name = "as it should be", .recipe = goodRecipe(device)});
    return rows;
}

MatrixSigners::MatrixSigners(const std::filesystem::path& authority, const std::filesystem::path& key)
    : m_site(loadForged(authority, key)),
      m_other(forge({.commonName = "LiENa certificate authority", .usage = "", .authority = true})),
      m_between(forge({.commonName = "between", .usage = "", .authority = true}, &m_site)),
      m_below(forge({.commonName = "below", .usage = "", .authority = true}, &m_between))
{}

Forged MatrixSigners::made(const CertificateRow& row) const
{
    switch (row.signer) {
    case Signer::Itself:
        return forge(row.recipe);
    case Signer::OtherSite:
        return forge(row.recipe, &m_other);
    case Signer::OneBelow:
        return forge(row.recipe, &m_between);
    case Signer::TwoBelow:
        return forge(row.recipe, &m_below);
    case Signer::Site:
        break;
    }
    return forge(row.recipe, &m_site);
}

} // namespace liena::test
