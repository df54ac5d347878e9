// Asks for the probe's steps and prints them.
#include "probe_command.hpp"

#include "refusal.hpp"

#include <liena/json_line.hpp>
#include <liena/log.hpp>
#include <liena/probe.hpp>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

namespace liena::tools {

namespace {

struct ProbeOptions {
    std::string topology;
    std::string self;
    std::string target;
    ProbeRequest request;
    int seconds = 2;
    bool json = false;
};

constexpr auto probeFooter =
    "Each step is a line: own-files (certificate, key, authority of this computer), name (of the host), route, port, tls, identity (is it\n"
    "the device that was meant), certificate (its end), revocation, acceptance (does it let this computer in). Steps that need a failed\n"
    "one are skipped. The probe ends before a session could begin: a device is not disturbed by it, also in the middle of a procedure.\n\n"
    "Examples:\n"
    "  liena probe robot --topology topologies/cerebrovascular.xml --device cockpit \\\n"
    "      --certificate pki/cockpit.crt --key pki/cockpit.key --authority pki/ca.crt\n"
    "  liena probe robot --topology t.xml --device cockpit --pki pki          the same, by the names in the authority's folder\n"
    "  liena probe xray --topology t.xml --device cockpit --pki pki --json\n\n"
    "Exit codes: 0 every step is ok, 1 a step failed, 2 wrong use of the command line.";

void print(const ProbeOptions& options, const std::vector<ProbeStep>& steps)
{
    fmt::print("from {} to {} ({}:{})\n", options.self, options.request.target.name, options.request.target.host,
               options.request.target.port);
    for (const auto& step : steps) {
        fmt::print("  {:<8} {:<12} {}\n", toString(step.result), step.name, printable(step.text, 512));
        if (!step.remedy.empty())
            fmt::print("  {:<8} {:<12} -> {}\n", "", "", step.remedy);
    }
}

void printJson(const ProbeOptions& options, const std::vector<ProbeStep>& steps, bool good)
{
    std::string list;
    for (const auto& step : steps) {
        JsonLine json;
        json.add("step", step.name).add("result", toString(step.result)).add("text", step.text);
        if (!step.remedy.empty())
            json.add("remedy", step.remedy);
        json.add("took_ms", std::chrono::duration<double, std::milli>(step.took).count());
        list += (list.empty() ? "" : ",") + json.text();
    }
    const auto& target = options.request.target;
    JsonLine json;
    json.add("from", options.self).add("to", target.name).add("id", target.id.toString());
    json.add("address", fmt::format("{}:{}", target.host, target.port)).add("ok", good).put("steps", "[" + list + "]");
    fmt::print("{}\n", json.text());
}

int probe(ProbeOptions& options)
{
    const auto topology = SystemTopology::load(options.topology);
    if (!topology)
        return refuse("probe", topology.error().what);
    const auto self = topology.value().device(options.self);
    if (!self)
        return refuse("probe", self.error().what);
    const auto target = topology.value().device(options.target);
    if (!target)
        return refuse("probe", target.error().what);
    if (topology.value().link(self.value().id, target.value().id) == nullptr)
        return refuse(
            "probe", fmt::format("topology {} has no link between {} and {}: they never open a session; add a link, or probe from a device "
                                 "that has one",
                                 topology.value().name(), self.value().name, target.value().name));
    auto& request = options.request;
    request.target = target.value();
    request.self = self.value().id;
    request.security = topology.value().security();
    request.limit = std::chrono::seconds(options.seconds);
    const auto steps = probeDevice(request);
    const bool good =
        std::none_of(steps.begin(), steps.end(), [](const ProbeStep& step) { return step.result == ProbeStep::Result::Failed; });
    if (options.json)
        printJson(options, steps, good);
    else
        print(options, steps);
    return good ? 0 : 1;
}

/// The files as `liena pki issue` names them, where they were not named one by one.
void fillFrom(const std::string& folder, ProbeOptions& options)
{
    const std::filesystem::path pki(folder);
    auto& request = options.request;
    if (request.certificate.empty())
        request.certificate = pki / (options.self + ".crt");
    if (request.key.empty())
        request.key = pki / (options.self + ".key");
    if (request.authority.empty())
        request.authority = pki / "ca.crt";
}

} // namespace

void addProbeCommand(CLI::App& app, int& exitCode)
{
    const auto options = std::make_shared<ProbeOptions>();
    const auto folder = std::make_shared<std::string>();
    auto* command = app.add_subcommand("probe", "Say what stands between this computer and a device, in plain words");
    command->footer(probeFooter);
    command->add_option("TARGET", options->target, "The device to reach: its name or id in the topology")->required();
    command->add_option("--topology", options->topology, "The topology file")->required();
    command->add_option("--device", options->self, "The device of this computer: its name or id in the topology")->required();
    command->add_option("--pki", *folder, "Folder with DEVICE.crt, DEVICE.key and ca.crt");
    command->add_option("--certificate", options->request.certificate, "This device's certificate, PEM");
    command->add_option("--key", options->request.key, "The certificate's key, PEM");
    command->add_option("--authority", options->request.authority, "The site's authority, PEM");
    command->add_option("--revocations", options->request.revocations, "The revocation list, PEM; default: beside the authority's file");
    command->add_option("--timeout", options->seconds, "Seconds that each step may take")->check(CLI::Range(1, 60))->capture_default_str();
    command->add_flag("--json", options->json, "One JSON object instead of lines");
    command->callback([options, folder, &exitCode] {
        if (!folder->empty())
            fillFrom(*folder, *options);
        exitCode = probe(*options);
    });
}

} // namespace liena::tools
