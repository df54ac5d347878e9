// What a site does with certificates: init, issue, show; revoking is in revoke_command.cpp.
#include "pki_command.hpp"
#include "refusal.hpp"
#include "revoke_command.hpp"

#include "liena/certificates.hpp"
#include "liena/log.hpp"
#include "liena/system_topology.hpp"

#include <CLI/CLI.hpp>
#include <fmt/chrono.h>
#include <fmt/format.h>

#include <chrono>
#include <memory>
#include <string>
#include <vector>

namespace liena::tools {

namespace {

constexpr int mostDays = 36500;

struct InitOptions {
    std::string folder;
    std::string site = "LiENa site";
    int days = 3650;
};

struct IssueOptions {
    std::string folder;
    std::string topology;
    std::string device;
    std::string id;
    int days = 365;
    bool replace = false;
};

struct NamedDevice {
    std::string name;
    DeviceId id;
};

std::chrono::hours hoursOf(int days) { return std::chrono::hours(24) * days; }

int init(const InitOptions& options)
{
    const auto authority = CertificateAuthority::create(options.folder, options.site, hoursOf(options.days));
    if (!authority)
        return refuse("pki", authority.error().what);
    fmt::print("{0}/ca.crt  give this to every device\n{0}/ca.key  keep this where certificates are issued, and nowhere else\n",
               options.folder);
    return 0;
}

Result<std::vector<NamedDevice>> devicesOf(const IssueOptions& options)
{
    if (options.topology.empty()) {
        const auto id = DeviceId::fromString(options.id);
        if (!id)
            return fail(Errc::InvalidArgument,
                        fmt::format("--id {} is no device id; write 0x and eight hex digits", printable(options.id)));
        return std::vector<NamedDevice>{{options.device, *id}};
    }
    const auto topology = SystemTopology::load(options.topology);
    if (!topology)
        return topology.as_failure();
    std::vector<NamedDevice> devices;
    for (const auto& device : topology.value().devices())
        devices.push_back({device.name, device.id});
    return devices;
}

/// All of a topology's devices or none: what is in the way of one is found before the first is issued.
Result<void> requireFree(const std::filesystem::path& folder, const std::vector<NamedDevice>& devices, bool replace)
{
    for (const auto& device : devices)
        if (device.name == "ca")
            return fail(Errc::InvalidArgument,
                        "a device cannot be called ca, since its files would be the authority's; give it another name");
    for (const auto& device : devices)
        for (const char* ending : {".crt", ".key"})
            if (const auto file = folder / (device.name + ending); !replace && std::filesystem::exists(file))
                return fail(Errc::FileUnwritable, fmt::format("{} exists already; give --replace to issue it anew", file.string()));
    return ok();
}

std::string remedyFor(const std::filesystem::path& folder)
{
    return std::filesystem::exists(folder / "ca.crt") ? "" : "; `liena pki init` makes an authority";
}

int issue(const IssueOptions& options)
{
    const auto devices = devicesOf(options);
    if (!devices)
        return refuse("pki", devices.error().what);
    const auto authority = CertificateAuthority::open(options.folder);
    if (!authority)
        return refuse("pki", authority.error().what + remedyFor(options.folder));
    if (const auto free = requireFree(options.folder, devices.value(), options.replace); !free)
        return refuse("pki", free.error().what);
    for (const auto& device : devices.value()) {
        const auto former = options.replace ? authority.value().issuedSerial(options.folder + "/" + device.name + ".crt")
                                            : Result<std::string>(fail(Errc::FileUnreadable, ""));
        if (const auto issued = authority.value().issue(device.id, device.name, hoursOf(options.days), options.replace); !issued)
            return refuse("pki", issued.error().what);
        fmt::print("{0}/{1}.crt {0}/{1}.key  {2} {1}\n", options.folder, device.name, device.id.toString());
        if (former)
            fmt::print("  the certificate it replaces stays good until its end; if its key may be in other hands:\n"
                       "  liena pki revoke --dir {} --serial {}\n",
                       options.folder, former.value());
    }
    return 0;
}

struct Standing {
    std::string words;
    bool inDate = false;
};

Standing standingOf(const CertificateInfo& info)
{
    const auto now = std::chrono::system_clock::now();
    if (now < info.notBefore)
        return {"NOT YET VALID", false};
    if (now > info.notAfter)
        return {"EXPIRED", false};
    const auto hours = std::chrono::duration_cast<std::chrono::hours>(info.notAfter - now).count();
    return {hours < 48 ? fmt::format("{} hours left", hours) : fmt::format("{} days left", hours / 24), true};
}

std::string dayOf(std::chrono::system_clock::time_point time)
{
    return fmt::format("{:%Y-%m-%d %H:%M} UTC", fmt::gmtime(std::chrono::system_clock::to_time_t(time)));
}

std::string roleOf(const CertificateInfo& info)
{
    if (info.isAuthority)
        return "certificate authority";
    if (info.devices.size() == 1)
        return info.devices.front().toString();
    return info.devices.empty() ? "none: no session can be opened with it" : "several: no session can be opened with it";
}

bool showList(const std::string& file, const RevocationListInfo& list)
{
    const bool inDate = std::chrono::system_clock::now() < list.ends;
    fmt::print("{}\n  revocation list of  {}\n  number              {}\n  valid               {} to {}{}\n", file,
               printable(list.issuer, 200), list.number, dayOf(list.made), dayOf(list.ends), inDate ? "" : " (ENDED)");
    for (const auto& one : list.revoked)
        fmt::print("  revoked             {} on {} ({})\n", one.serial, dayOf(one.since), toString(one.reason));
    return inDate;
}

/// Whether the file holds a certificate or a revocation list that is in date.
bool show(const std::string& file)
{
    const auto described = describeCertificate(file);
    if (const auto list = described ? Result<RevocationListInfo>(fail(Errc::CertificateInvalid, "")) : describeRevocations(file))
        return showList(file, list.value());
    if (!described) {
        refuse("pki", described.error().what);
        return false;
    }
    const auto& info = described.value();
    const auto standing = standingOf(info);
    fmt::print("{}\n  subject      {}\n  issuer       {}\n  device       {}\n", file, printable(info.subject, 200),
               printable(info.issuer, 200), roleOf(info));
    fmt::print("  valid        {} to {} ({})\n", dayOf(info.notBefore), dayOf(info.notAfter), standing.words);
    fmt::print("  serial       {}\n  fingerprint  {}\n", info.serial, info.fingerprint);
    for (const auto& uri : info.uris)
        fmt::print("  name         {}\n", printable(uri, 200));
    return standing.inDate;
}

int showAll(const std::vector<std::string>& files)
{
    bool sound = true;
    for (const auto& file : files)
        sound = show(file) && sound;
    return sound ? 0 : 1;
}

void addInit(CLI::App& pki, int& exitCode)
{
    const auto options = std::make_shared<InitOptions>();
    auto* command = pki.add_subcommand("init", "Make a new certificate authority in a folder that holds none");
    command->add_option("--dir", options->folder, "The authority's folder")->required();
    command->add_option("--site", options->site, "The site's name, at most 64 bytes")->capture_default_str();
    command->add_option("--days", options->days, "How long it is valid")->check(CLI::Range(1, mostDays))->capture_default_str();
    command->callback([options, &exitCode] { exitCode = init(*options); });
}

void addIssue(CLI::App& pki, int& exitCode)
{
    const auto options = std::make_shared<IssueOptions>();
    auto* command = pki.add_subcommand("issue", "Issue keys and certificates for one device, or for all of a topology");
    command->add_option("--dir", options->folder, "The authority's folder")->required();
    auto* topology = command->add_option("--topology", options->topology, "Issue for each device of this file");
    auto* device = command->add_option("--device", options->device, "Issue for one device: the name of its files");
    auto* id = command->add_option("--id", options->id, "The device's id, as 0x40018208");
    device->needs(id)->excludes(topology);
    id->needs(device)->excludes(topology);
    command->add_option("--days", options->days, "How long they are valid; in its last day no session opens with a certificate")
        ->check(CLI::Range(2, mostDays))
        ->capture_default_str();
    command->add_flag("--replace", options->replace, "Issue anew what exists already");
    command->callback([options, &exitCode] {
        if (options->topology.empty() && options->device.empty())
            throw CLI::RequiredError("--topology, or --device with --id,");
        exitCode = issue(*options);
    });
}

void addShow(CLI::App& pki, int& exitCode)
{
    const auto files = std::make_shared<std::vector<std::string>>();
    auto* command = pki.add_subcommand("show", "Say what certificates and revocation lists say; status 1 if one is out of date or none");
    command->add_option("files", *files, "PEM files")->required();
    command->callback([files, &exitCode] { exitCode = showAll(*files); });
}

} // namespace

void addPkiCommand(CLI::App& app, int& exitCode)
{
    auto* pki = app.add_subcommand("pki", "Certificates of a site and its devices");
    pki->require_subcommand(1);
    pki->footer("A site makes its authority once, issues a certificate per device, and revokes the one whose key is lost:\n"
                "  liena pki init --dir pki --site \"Hospital, lab 2\"\n"
                "  liena pki issue --dir pki --topology topologies/cerebrovascular.xml\n"
                "  liena pki revoke --dir pki xray --reason key-compromise\n"
                "  liena pki show pki/*.crt pki/ca.crl\n\n"
                "Each device gets its own .crt and .key (mode 0600, its own user's), and ca.crt and ca.crl. ca.key stays where\n"
                "certificates are issued. No session opens with a certificate in its last 24 hours.");
    addInit(*pki, exitCode);
    addIssue(*pki, exitCode);
    addRevokeCommand(*pki, exitCode);
    addShow(*pki, exitCode);
}

} // namespace liena::tools
