// From options to a plan, from a measurement to a verdict and its reports.
#include "bench_command.hpp"

#include "bench_plan.hpp"
#include "bench_run.hpp"
#include "latency_plot.hpp"
#include "network_options.hpp"
#include "refusal.hpp"
#include "register_folder.hpp"
#include "report_file.hpp"

#include <liena/log.hpp>
#include <liena/status.hpp>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

namespace liena::tools {

namespace {

struct BenchOptions {
    Settings settings;
    std::string to;
    std::string pki;
    bool local = false;
    bool live = false;
    std::string folder = statusFolder().string();
    std::string profile = "vascular-robot";
    int seconds = 0;     ///< 0: as long as the profile's limits need
    double commands = 0; ///< 0: as the profile says
    double frames = 0;
    std::string image;
    std::uint32_t commandBytes = 64;
    bool json = false;
    std::string svg;
};

constexpr int caution = 3;
constexpr int noGo = 4;

constexpr auto benchFooter =
    "Three ways:\n"
    "  (no flag)  takes the place of A, with A's certificate, and opens a session with the running device B. For before a procedure:\n"
    "             A's own program must not run, here or elsewhere; other devices that are linked to A may open sessions with it. All are\n"
    "             closed in order at the end and on Ctrl-C; but a line that breaks meanwhile is a loss for B, and it stands by.\n"
    "             Where others use B, its budget holds as with --live, and --seconds 32 is the most.\n"
    "             Name the marks and what the network thread is to have as A's program does (--mark-commands, --realtime-priority,\n"
    "             ...), or another class of the network is measured. B's answers have those of B.\n"
    "  --live     asks the running device A of this user to measure inside its own session with B, within the budget of both devices\n"
    "             (when commands or images flow: 200 probes and 4 MB a second, at most a tenth of what the path is known to carry\n"
    "             now, and 250 kB a second until that is known; 120 s at most, which is --seconds 59; one measurement of a device at a\n"
    "             time).\n"
    "             Of commands and images at a rate beyond that it gives no go: ask with --commands, --frames and --image for what the\n"
    "             budget allows. A must have been started with --measure-on-request.\n"
    "  --local    runs A and B here, on loopback: what this computer and the software cost without a line. Needs no certificates.\n\n"
    "Measured are, in this order: commands in their rhythm, beside packets (loss, jitter); commands back to back; both rhythms while\n"
    "images flow in theirs; as many images as go; as many commands as go, 256 under way. --live leaves out the three that fill the line.\n"
    "Commands are there and back; images are timed until the word that they were heard whole is back. What is sent is no command: it\n"
    "waits behind every real one, and no application sees it.\n\n"
    "PROFILE is vascular-robot, telesurgery, observation, or a file of your own: copy one of resources/profiles and change it. Its\n"
    "limits have two numbers, for go and for caution. A percentile needs echoes, 99 % 100 of them, 99.9 % 1000 and 99.99 % 10000: where\n"
    "there are fewer it is -, and its figure caution. By default it is measured until there are enough for each limit; for 99.99 %, of\n"
    "which there is none, 500 commands a second take --seconds 21. While a device is in use there are 100 a second: --seconds 16 is "
    "enough\n"
    "then, and 99.99 % is out of reach.\n\n"
    "Examples:\n"
    "  liena bench --topology t.xml --from cockpit --to robot --pki pki\n"
    "  liena bench --topology t.xml --from xray --to cockpit --pki pki --image 2MiB --frames 30 --svg line.svg\n"
    "  liena bench --topology t.xml --from cockpit --to robot --live --seconds 20 --json | jq .verdict\n"
    "  liena bench --topology topologies/cerebrovascular.xml --from cockpit --to robot --local\n\n"
    "Exit codes: 0 go, 3 caution, 4 no-go, 1 no verdict (what failed is said), 2 wrong use of the command line.";

/// What the user names goes before what the profile says.
Result<LineProfile> loadFor(const BenchOptions& options)
{
    auto profile = LineProfile::load(options.profile);
    if (!profile)
        return profile;
    auto& asked = profile.value();
    if (options.commands > 0)
        asked.commandsPerSecond = options.commands;
    if (options.frames > 0)
        asked.framesPerSecond = options.frames;
    if (!options.image.empty())
        asked.imageBytes = *imageBytesFrom(options.image);
    return profile;
}

void fillFrom(BenchOptions& options, const std::string& name)
{
    if (options.pki.empty())
        return;
    const std::filesystem::path pki(options.pki);
    auto& settings = options.settings;
    if (settings.certificate.empty())
        settings.certificate = pki / (name + ".crt");
    if (settings.key.empty())
        settings.key = pki / (name + ".key");
    if (settings.authority.empty())
        settings.authority = pki / "ca.crt";
}

struct Subjects {
    SystemTopology topology;
    TopologyDevice from;
    TopologyDevice to;
};

Result<Subjects> subjectsOf(const BenchOptions& options)
{
    auto topology = SystemTopology::load(options.settings.topology);
    if (!topology)
        return topology.as_failure();
    auto from = topology.value().device(options.settings.device);
    if (!from)
        return from.as_failure();
    auto to = topology.value().device(options.to);
    if (!to)
        return to.as_failure();
    if (topology.value().link(from.value().id, to.value().id) == nullptr)
        return fail(Errc::NoLink,
                    fmt::format("topology {} has no link between {} and {}: they never open a session; choose two that have one",
                                topology.value().name(), from.value().name, to.value().name));
    return Subjects{std::move(topology.value()), std::move(from.value()), std::move(to.value())};
}

/// Errors, and that packets leave without their marks: then another class of the network is measured.
LogSink logOfBench()
{
    return [write = stderrLog(LogLevel::Warning)](const LogLine& line) {
        if (line.level == LogLevel::Error || line.event == "packets-unmarked")
            write(line);
    };
}

Result<Measurement> measure(BenchOptions& options, const Subjects& subjects, const LineProfile& profile)
{
    const auto whole = options.seconds > 0 ? std::chrono::seconds(options.seconds) : enoughFor(profile, options.live);
    if (options.live) {
        const auto socket = statusSocket(options.folder, subjects.from.id);
        return measureLive({socket, subjects.from.name, liveOrder(subjects.to.id, profile, whole, options.commandBytes), whole});
    }
    const auto plan = benchPlan(profile, whole, options.commandBytes);
    if (options.local)
        return measureLocally(subjects.topology, subjects.from, subjects.to, options.settings.registry, plan);
    fillFrom(options, subjects.from.name);
    auto& settings = options.settings;
    settings.software = "liena bench";
    settings.log = logOfBench();
    // What comes from the peer's side must not limit this end; of a path in use it takes its share as ever.
    settings.measuring.inUse = settings.measuring.atRest;
    settings.measuring.inUse.longest = std::chrono::hours(1);
    settings.measuring.atRest.longest = std::chrono::hours(1);
    auto measured = measureAsDevice({settings, subjects.to.name, std::chrono::seconds(10)}, plan);
    if (!measured && measured.error().code == Errc::AddressUnavailable)
        return fail(Errc::AddressUnavailable,
                    measured.error().what + "; if the program of " + subjects.from.name + " runs here, measure with --live");
    return measured;
}

std::string wayOf(const BenchOptions& options)
{
    return options.live ? "inside its session" : options.local ? "both on this computer" : "a session for the measurement";
}

int bench(BenchOptions& options)
{
    const auto subjects = subjectsOf(options);
    if (!subjects)
        return refuse("bench", subjects.error().what);
    const auto profile = loadFor(options);
    if (!profile)
        return refuse("bench", profile.error().what);
    if (!options.svg.empty())
        if (const auto writable = tryReport(options.svg); !writable)
            return refuse("bench", writable.error().what);
    const auto measured = measure(options, subjects.value(), profile.value());
    if (!measured)
        return refuse("bench", measured.error().what);
    const auto& measurement = measured.value();
    if (!measurement.failure.empty())
        return refuse("bench",
                      fmt::format("{}{}", measurement.failure,
                                  measurement.phases.empty() ? "" : fmt::format("; it got as far as {}", measurement.phases.back().name)));
    const auto verdict = judge(measurement, profile.value());
    const BenchSubject subject{subjects.value().topology.name(), subjects.value().from.name, subjects.value().to.name, wayOf(options)};
    const auto report = options.json ? benchJson(subject, profile.value(), verdict, measurement) + "\n"
                                     : benchText(subject, profile.value(), verdict, measurement);
    const auto printed = printReport(report); // first: the plot's place may be a pipe that nobody reads
    const auto drawn = options.svg.empty() ? ok() : writeReport(options.svg, latencyPlot(subject, profile.value(), verdict, measurement));
    if (!printed)
        return refuse("bench", printed.error().what);
    if (!drawn)
        return refuse("bench", drawn.error().what);
    return verdict.verdict == Verdict::Go ? 0 : verdict.verdict == Verdict::Caution ? caution : noGo;
}

/// They are settings of this program's own device, which only the way without a flag has on the line.
void refuseNetworkOptions(const CLI::App& network, const BenchOptions& options)
{
    if (!options.live && !options.local)
        return;
    for (const auto* option : network.get_options())
        if (option->count() > 0)
            throw CLI::ValidationError(
                option->get_name(),
                options.live
                    ? "not with --live, which measures inside the session of the running device: that is started with such options"
                    : "not with --local: nothing on loopback looks at marks, and of two devices on one computer neither runs as it "
                      "would alone");
}

void addIdentityOptions(CLI::App& command, BenchOptions& options)
{
    auto& settings = options.settings;
    command.add_option("--pki", options.pki, "Folder with A.crt, A.key and ca.crt");
    command.add_option("--certificate", settings.certificate, "A's certificate, PEM");
    command.add_option("--key", settings.key, "The certificate's key, PEM");
    command.add_option("--authority", settings.authority, "The site's authority, PEM");
    command.add_option("--revocations", settings.revocations, "The revocation list, PEM; default: beside the authority's file");
    command
        .add_option("--registry", settings.registry,
                    "Folder with the message sets; may be repeated. Not named: resources/devices, or what is installed")
        ->capture_default_str();
    command.add_option("--store", settings.store, "Folder for message sets learnt from peers; default ~/.local/state/liena/sets");
    command.add_flag("--allow-insecure-network", settings.allowInsecureNetwork,
                     "With security mode none: listen on other than loopback addresses, without any protection");
}

} // namespace

void addBenchCommand(CLI::App& app, int& exitCode)
{
    const auto options = std::make_shared<BenchOptions>();
    options->settings.registry = {registerFolder()};
    auto* command = app.add_subcommand("bench", "Measure the line between two devices, and say whether it is good enough");
    command->footer(benchFooter);
    command->add_option("--topology", options->settings.topology, "The topology file")->required();
    command->add_option("--from", options->settings.device, "Device A of this computer: its name or id in the topology")->required();
    command->add_option("--to", options->to, "Device B, to which commands and images are sent")->required();
    auto* live = command->add_flag("--live", options->live, "Inside the session of the running device A");
    command->add_flag("--local", options->local, "Both devices on this computer")->excludes(live);
    command->add_option("--folder", options->folder, "With --live: where the device offers its status")->capture_default_str();
    command->add_option("--profile", options->profile, "What the procedure asks: a name, or a file")->capture_default_str();
    command
        ->add_option("--seconds", options->seconds,
                     "Of the paced phases; the others take half of it. Default as long as the profile's limits need, 7 at least")
        ->check(CLI::Range(1, mostSeconds));
    command->add_option("--commands", options->commands, "Commands a second; default as the profile says")->check(CLI::Range(1.0, 10000.0));
    command->add_option("--command-bytes", options->commandBytes, "Bytes of a command")->check(CLI::Range(0, 1024))->capture_default_str();
    command->add_option("--frames", options->frames, "Images a second; default as the profile says")->check(CLI::Range(0.1, 1000.0));
    command->add_option("--image", options->image, "Size of an image, as 512KiB or 2MiB; default as the profile says")
        ->check([](const std::string& text) {
            return imageBytesFrom(text) ? std::string() : std::string("write a size as 512KiB or 2MiB, at most 8MiB");
        });
    command->add_flag("--json", options->json, "One JSON object instead of tables");
    command->add_option("--svg", options->svg, "Draw the round trips into this file");
    addIdentityOptions(*command, *options);
    auto* network = command->add_option_group("Marks and network thread", "As the programs of A have them; without --live and --local");
    addMarkOptions(*network, options->settings.marks);
    addRealTimeOptions(*network, options->settings.realTime);
    command->callback([options, network, &exitCode] {
        refuseNetworkOptions(*network, *options);
        exitCode = bench(*options);
    });
}

} // namespace liena::tools
