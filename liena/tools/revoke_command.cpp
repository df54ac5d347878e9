// From devices, files and serial numbers to a new revocation list.
#include "revoke_command.hpp"

#include "refusal.hpp"

#include "liena/certificates.hpp"
#include "liena/log.hpp"

#include <CLI/CLI.hpp>
#include <fmt/chrono.h>
#include <fmt/format.h>

#include <chrono>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace liena::tools {

namespace {

struct RevokeOptions {
    std::string folder;
    std::vector<std::string> names;
    std::vector<std::string> files;
    std::vector<std::string> serials;
    RevocationReason reason = RevocationReason::Unspecified;
    int days = 365;
    bool renew = false;
};

constexpr auto revokeFooter =
    "NAME is a device whose NAME.crt is in the authority's folder; name the certificate itself with --certificate or --serial when\n"
    "it is not there any more. The list is DIR/ca.crl. Copy it to every device, beside its ca.crt: running programs read it at\n"
    "their next handshake, and no restart is needed. A session that is open stays open: close it at one of its devices.\n\n"
    "The list has an end as well. From then on no new session opens until a renewed one is there:\n"
    "  liena pki revoke --dir pki --renew --days 365\n\n"
    "Examples:\n"
    "  liena pki revoke --dir pki xray --reason key-compromise\n"
    "  liena pki issue  --dir pki --device xray --id 0x20010208 --replace     a new key and certificate for it\n"
    "  liena pki revoke --dir pki --serial 5A0C...E1 --reason superseded";

/// All or none: what cannot be revoked is found before the list is written.
Result<std::vector<std::string>> serialsOf(const CertificateAuthority& authority, const RevokeOptions& options)
{
    auto serials = options.serials;
    auto files = options.files;
    for (const auto& name : options.names) {
        if (name.find('/') != std::string::npos || name == "ca")
            return fail(Errc::InvalidArgument, fmt::format("{} is no device's name; for a file there is --certificate", printable(name)));
        files.push_back((authority.folder() / (name + ".crt")).string());
    }
    for (const auto& file : files) {
        const auto serial = authority.issuedSerial(file);
        if (!serial)
            return serial.as_failure();
        serials.push_back(serial.value());
    }
    return serials;
}

int revoke(const RevokeOptions& options)
{
    const auto authority = CertificateAuthority::open(options.folder);
    if (!authority)
        return refuse("pki revoke", authority.error().what);
    const auto serials = serialsOf(authority.value(), options);
    if (!serials)
        return refuse("pki revoke", serials.error().what);
    const auto list = authority.value().revoke(serials.value(), options.reason, std::chrono::hours(24) * options.days);
    if (!list)
        return refuse("pki revoke", list.error().what);
    const auto& made = list.value();
    fmt::print("{}/ca.crl  number {}, {} revoked, good until {:%Y-%m-%d %H:%M} UTC\n", options.folder, made.number, made.revoked.size(),
               fmt::gmtime(std::chrono::system_clock::to_time_t(made.ends)));
    for (const auto& serial : serials.value())
        fmt::print("  revoked {}\n", serial);
    fmt::print("copy it to every device, beside its ca.crt; it holds there from the next handshake on\n");
    return 0;
}

} // namespace

void addRevokeCommand(CLI::App& pki, int& exitCode)
{
    const auto options = std::make_shared<RevokeOptions>();
    auto* command = pki.add_subcommand("revoke", "Take certificates back before their end, or renew the list of those");
    command->footer(revokeFooter);
    command->add_option("--dir", options->folder, "The authority's folder")->required();
    command->add_option("NAME", options->names, "Devices whose certificates are to be revoked");
    command->add_option("--certificate", options->files, "A certificate's file; may be repeated");
    command->add_option("--serial", options->serials, "A certificate's serial number in hex, as `liena pki show` says it; may be repeated");
    const std::map<std::string, RevocationReason> reasons{{"unspecified", RevocationReason::Unspecified},
                                                          {"key-compromise", RevocationReason::KeyCompromise},
                                                          {"superseded", RevocationReason::Superseded},
                                                          {"out-of-service", RevocationReason::OutOfService}};
    command->add_option("--reason", options->reason, "unspecified, key-compromise, superseded or out-of-service")
        ->transform(CLI::CheckedTransformer(reasons))
        ->option_text("WHY");
    command->add_option("--days", options->days, "How long the list is good")->check(CLI::Range(2, 36500))->capture_default_str();
    command->add_flag("--renew", options->renew, "Only renew the list, or make the first, empty one");
    command->callback([options, &exitCode] {
        if (options->names.empty() && options->files.empty() && options->serials.empty() && !options->renew)
            throw CLI::RequiredError("NAME, --certificate, --serial or --renew,");
        exitCode = revoke(*options);
    });
}

} // namespace liena::tools
