// liena-device: the robot, the arm and the X-ray system of the reference system, as programs.
#include "arm_device.hpp"
#include "dicom_cine.hpp"
#include "fluoroscopy_generator.hpp"
#include "line_reader.hpp"
#include "network_options.hpp"
#include "picture_folder.hpp"
#include "robot_device.hpp"
#include "xray_device.hpp"

#include "liena/certificates.hpp"
#include "liena/status.hpp"
#include "liena/version.hpp"

#include <CLI/CLI.hpp>

#include <csignal>
#include <iostream>

namespace {

using namespace liena;
using namespace liena::devices;

struct Options {
    Settings settings;
    std::filesystem::path vessels;
    std::filesystem::path dicom;
    std::filesystem::path images;
    std::string encoding = "raw";
    unsigned quality = 0;
    int size = 512;
    std::uint64_t seed = 1;
    bool noLossy = false;
    bool noReduction = false;
    std::optional<double> start;
    bool twoPersons = false;
    bool verbose = false;
    std::string logFormat = "text";
};

constexpr const char* footer = R"(
While it runs, the person beside the device may type a line, as long as its standard input is open:
  open NAME          open the channel to a device of the topology
  reopen NAME        re-open a lost channel; never gives permission to move
  close NAME         close a channel in order
  dismiss [NAME [REASON]]  give every incident up of which that device is an end, because it will not return;
                     without a name the only one there is
  stop [REASON]      EMERGENCY STOP: of the robot itself, or sent to the linked robot
  clear              clear to arm: the surgeon may arm the robot (robot with --two-person)
  wait               take that back; a robot that is armed holds
  status             one line per link and incident

The arm and the X-ray system open their link to the robot by themselves and try again every second. A lost
link is re-opened only after a person's command: typed here, or heard from the system when the surgeon
re-opens a channel to this device or to that robot. SIGTERM or Ctrl-C closes every session in order.

When the way to a viewer does not carry the pictures, the X-ray system steps down a ladder: half the rate, then
lossless, then lossy pictures. Each picture says so, and it steps up again by itself.

Examples:
  liena-device robot --topology topologies/cerebrovascular.xml --registry resources/devices \
      --certificate site/robot.crt --key site/robot.key --authority site/ca.crt
  liena-device xray  --topology topologies/cerebrovascular.xml --registry resources/devices \
      --certificate site/xray.crt --key site/xray.key --authority site/ca.crt --dicom run.dcm
  liena-device vessels > cerebral.swc)";

void addSystemOptions(CLI::App& role, Options& options)
{
    Settings& settings = options.settings;
    role.add_option("--topology", settings.topology, "The topology file, the same bytes on every device")->required();
    role.add_option("--device", settings.device, "This device: its name or id in the topology")->capture_default_str();
    role.add_option("--registry", settings.registry, "Folder with the message sets; may be repeated")->required();
    role.add_option("--certificate", settings.certificate, "This device's certificate, PEM; needed when the topology says tls");
    role.add_option("--key", settings.key, "The certificate's key, PEM");
    role.add_option("--authority", settings.authority, "The site's authority, PEM");
    role.add_option("--revocations", settings.revocations,
                    "The site's revocation list, PEM; default: beside the authority's file, with the ending .crl");
    role.add_option("--store", settings.store, "Folder for message sets learnt from peers; default ~/.local/state/liena/sets");
    role.add_flag("--allow-insecure-network", settings.allowInsecureNetwork,
                  "With security mode none: listen on other than loopback addresses, without any protection");
    addRealTimeOptions(role, settings.realTime);
    addMarkOptions(role, settings.marks);
    role.add_option("--seed", options.seed, "Of the simulation's noise")->capture_default_str();
    role.add_option("--audit", settings.audit, "Audit file: who did what to the sessions, tamper-evident; see `liena audit --help`");
    role.add_option("--status", settings.status, "Folder for the socket that `liena monitor` watches; empty for none")
        ->capture_default_str();
    role.add_flag("--measure-on-request", settings.measureOnRequest, "Let `liena bench --live` of this user measure lines of this device");
    role.add_option("--log-format", options.logFormat, "How the log is written to stderr: text, or json with one object per line")
        ->check(CLI::IsMember({"text", "json"}))
        ->capture_default_str();
    role.add_flag("--verbose", options.verbose, "Log details as well");
}

void addVesselOption(CLI::App& role, Options& options)
{
    role.add_option("--vessels", options.vessels,
                    "SWC file with the patient's vessels; default: the built-in cerebral tree. Give robot and X-ray the same");
}

void addPictureOptions(CLI::App& role, Options& options)
{
    auto* dicom =
        role.add_option("--dicom", options.dicom, "Play this DICOM XA or RF run while the pedal is down, instead of computed pictures");
    role.add_option("--images", options.images, "Play the .pgm and .jpg files of this folder instead")->excludes(dicom);
    role.add_option("--encoding", options.encoding, "How pictures travel")
        ->check(CLI::IsMember({"raw", "jpeg-ls", "jpeg"}))
        ->capture_default_str();
    role.add_option("--quality", options.quality, "jpeg-ls: the most a pixel may be off (0 = lossless); jpeg: 1 to 100 (default 90)")
        ->check(CLI::Range(0, 255));
    auto* noReduction = role.add_flag("--no-reduction", options.noReduction,
                                      "Never step down: pictures that the way to the viewers does not carry are withheld");
    role.add_flag("--no-lossy", options.noLossy, "Step down to lower rates and to lossless pictures at most, never to lossy ones")
        ->excludes(noReduction);
    role.add_option("--size", options.size, "Edge of the computed picture in pixels")
        ->check(CLI::IsMember({256, 512, 1024}))
        ->capture_default_str();
}

[[noreturn]] void die(const std::string& what)
{
    std::cerr << "liena-device: " << what << '\n';
    std::exit(1);
}

template <typename T>
T orDie(Result<T> result)
{
    if (!result)
        die(result.error().what);
    return std::move(result.value());
}

VesselTree vesselsOf(const Options& options)
{
    return options.vessels.empty() ? VesselTree::cerebral() : orDie(VesselTree::load(options.vessels));
}

std::unique_ptr<ImageSource> pictureSource(const Options& options)
{
    if (!options.dicom.empty())
        return orDie(DicomCine::open(options.dicom));
    if (!options.images.empty())
        return orDie(PictureFolder::open(options.images));
    return std::make_unique<FluoroscopyGenerator>(vesselsOf(options), options.size, options.seed);
}

XrayOptions xrayOptions(const Options& options)
{
    const Encoding encoding = *encodingFrom(options.encoding);
    unsigned quality = options.quality;
    if (encoding == Encoding::Jpeg)
        quality = quality == 0 ? 90 : std::min(quality, 100U);
    const Reduction reduction = options.noReduction ? Reduction::None : options.noLossy ? Reduction::Lossless : Reduction::Lossy;
    return {pictureSource(options), encoding, quality, reduction, {}};
}

RobotOptions robotOptions(const Options& options)
{
    return {options.start, options.seed, options.twoPersons ? ArmingRule::TwoPersons : ArmingRule::OnePerson};
}

// Runs the device from here to SIGTERM or SIGINT.
template <typename Device>
void run(DistributedSystem& system, Device& device, const LogSink& log, const sigset_t& ends)
{
    system.start();
    const TopologyDevice& self = system.self();
    std::cout << "listening on " << self.host << ':' << self.port << std::endl;
    LineReader reader([&](std::string_view line) { device.obey(line); }, log);
    int signal = 0;
    sigwait(&ends, &signal);
    reader.stop();
    system.stop();
}

void runRole(const std::string& role, Options& options, const sigset_t& ends)
{
    options.settings.log = [write = stderrLog(options.verbose ? LogLevel::Debug : LogLevel::Info, *logFormatFrom(options.logFormat)),
                            device = options.settings.device](LogLine line) {
        line.device = device;
        write(line);
    };
    options.settings.software = std::string("liena-device ") + versionText;
    const LogSink log = options.settings.log;
    if (role == "xray") {
        XrayOptions pictures = xrayOptions(options); // a defective file is told before anything is opened
        const auto system = orDie(DistributedSystem::create(options.settings));
        const auto device = orDie(XrayDevice::create(*system, std::move(pictures), log));
        run(*system, *device, log, ends);
        return;
    }
    const VesselTree vessels = vesselsOf(options);
    const auto system = orDie(DistributedSystem::create(options.settings));
    if (role == "robot")
        run(*system, *orDie(RobotDevice::create(*system, vessels, robotOptions(options), log)), log, ends);
    else
        run(*system, *orDie(ArmDevice::create(*system, log)), log, ends);
}

sigset_t blockSignals()
{
    sigset_t ends;
    sigemptyset(&ends);
    sigaddset(&ends, SIGTERM);
    sigaddset(&ends, SIGINT);
    pthread_sigmask(SIG_BLOCK, &ends, nullptr); // before any thread exists, so that only sigwait gets them
    std::signal(SIGPIPE, SIG_IGN);
    return ends;
}

} // namespace

int main(int argc, char** argv)
{
    const sigset_t ends = blockSignals();
    keepKeysOutOfCoreDumps();
    Options options;
    options.settings.status = statusFolder();
    CLI::App program("The patient-side reference devices of LiENa: simulated, and behaving as the real ones would", "liena-device");
    program.set_version_flag("--version", std::string("liena-device ") + versionText);
    program.require_subcommand(1);
    program.footer(footer);
    auto* robot = program.add_subcommand("robot", "Vascular robot: guidewire, catheter, grippers, contrast, magnetic tracker");
    auto* arm = program.add_subcommand("arm", "Robotic arm that carries the robot; moves only while the robot holds");
    auto* xray = program.add_subcommand("xray", "C-arm X-ray system: computed fluoroscopy, or a recorded run");
    auto* vessels = program.add_subcommand("vessels", "Write the built-in vessel tree to standard output as SWC, and end");
    for (auto* role : {robot, arm, xray})
        addSystemOptions(*role, options);
    addVesselOption(*robot, options);
    addVesselOption(*xray, options);
    robot->add_option("--start", options.start, "Where the guidewire's tip is at the start, in mm along its way; default 65 % of it")
        ->check(CLI::Range(0.0, 1500.0));
    robot->add_flag(
        "--two-person", options.twoPersons,
        "The robot can be armed only after the person beside it has typed clear; again after each session, stand-by, stop and fault");
    addPictureOptions(*xray, options);
    try {
        program.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return program.exit(error) == 0 ? 0 : 2;
    }
    if (vessels->parsed()) {
        std::cout << VesselTree::cerebral().toSwc();
        return std::cout.flush() ? 0 : 1;
    }
    const std::string role = robot->parsed() ? "robot" : arm->parsed() ? "arm" : "xray";
    if (options.settings.device.empty())
        options.settings.device = role;
    runRole(role, options, ends);
    return 0;
}
