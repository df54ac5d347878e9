// lab_device: one device of the lab's system on liena's public headers; obeys lines on its input and tells what happens on its output.
#include "device/cockpit_part.hpp"
#include "device/fluoroscopy_part.hpp"
#include "device/heap_watch.hpp"
#include "device/line_log.hpp"
#include "device/robot_part.hpp"
#include "device/wall_clock.hpp"
#include "device/xray_part.hpp"

#include "liena/distributed_system.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <iostream>
#include <memory>
#include <sstream>
#include <string>

namespace liena::lab {

namespace {

using Kind = SessionEvent::Kind;

struct Options {
    Settings settings;
    bool quiet = false; ///< sessions only
    bool hoard = false;
    bool fluoroscopy = false;
};

Options readOptions(CLI::App& app, int argc, char** argv)
{
    Options options;
    auto& settings = options.settings;
    app.add_option("--topology", settings.topology)->required();
    app.add_option("--device", settings.device)->required();
    app.add_option("--registry", settings.registry)->required();
    app.add_option("--store", settings.store)->required();
    app.add_option("--certificate", settings.certificate)->required();
    app.add_option("--key", settings.key)->required();
    app.add_option("--authority", settings.authority)->required();
    app.add_flag("--quiet", options.quiet, "sessions only: no commands, no reports");
    app.add_flag("--hoard-pictures", options.hoard, "a cockpit that never drains its cache");
    app.add_flag("--fluoroscopy", options.fluoroscopy, "an X-ray system with a pedal and a ladder");
    app.parse(argc, argv);
    settings.software = "lab";
    settings.log = [](LogLevel level, std::string_view line) { tell({"log", toString(level), line}); };
    return options;
}

std::string nameOf(const DistributedSystem& system, DeviceId id)
{
    const auto* device = system.topology().find(id);
    return device == nullptr ? id.toString() : device->name;
}

/// The library's word as one word of a line.
template <typename T>
std::string wordOf(T value)
{
    std::string text(toString(value));
    std::replace(text.begin(), text.end(), ' ', '-');
    return text;
}

/// `state PEER FROM TO`, and `event KIND PEER …` for all others.
void tellEvent(const DistributedSystem& system, const SessionEvent& event)
{
    const auto peer = nameOf(system, event.peer);
    if (event.kind == Kind::StateChanged)
        return tell(event.at, {"state", peer, wordOf(event.from), wordOf(event.to)});
    const auto cause = event.kind == Kind::Lost || event.kind == Kind::Diagnosed ? event.diagnosis.cause : event.incident.cause;
    const auto microseconds = std::chrono::duration_cast<std::chrono::microseconds>(event.duration).count();
    tell(event.at, {"event", wordOf(event.kind), peer, microseconds, wordOf(cause), wordOf(event.reason), event.incident.id,
                    nameOf(system, event.incident.a) + "-" + nameOf(system, event.incident.b), event.count, wordOf(event.diagnosis.probe),
                    event.message + "|" + event.detail});
}

std::unique_ptr<DevicePart> partOf(DistributedSystem& system, const Options& options)
{
    if (options.quiet)
        return std::make_unique<DevicePart>();
    if (system.report("RobotStatus"))
        return std::make_unique<RobotPart>(system);
    if (options.fluoroscopy)
        return std::make_unique<FluoroscopyPart>(system);
    if (system.report("XrayFrame"))
        return std::make_unique<XrayPart>(system);
    return std::make_unique<CockpitPart>(system, CockpitPart::Options{options.hoard});
}

Result<void> obeyAboutSession(DistributedSystem& system, const std::string& verb, DeviceId peer)
{
    if (verb == "open")
        return system.openChannel(peer);
    if (verb == "close")
        return system.closeChannel(peer, "the lab");
    if (verb == "reopen")
        return system.reopenChannel(peer);
    for (const auto& link : system.links()) // dismiss
        if (link.peer == peer && link.incident != 0)
            return system.dismissIncident(link.incident, "the lab");
    return fail(Errc::NoIncident, "no incident");
}

/// The person at this device. On the network thread.
void obey(DistributedSystem& system, DevicePart& part, const std::string& line)
{
    std::istringstream words(line);
    std::string verb, name;
    words >> verb;
    if (verb == "clock") {
        long step = 0;
        words >> step;
        stepWallClock(std::chrono::milliseconds(step));
        return tell({"clock", step});
    }
    if (part.obey(verb, words))
        return tell({"obeyed", line});
    words >> name;
    const auto* peer = system.topology().find(name);
    if (peer == nullptr)
        return tell({"not-understood", line});
    tell({"person", verb, name});
    if (const auto done = obeyAboutSession(system, verb, peer->id); !done)
        tell({"refused", wordOf(done.error().code), done.error().what});
}

/// A gap in a 2 ms timer is this process's own standing still, whatever the reason.
void tellGap(SteadyTime& last, SteadyTime now)
{
    constexpr std::chrono::milliseconds worthTelling{15};
    if (last != SteadyTime{} && now - last > worthTelling)
        tell(now, {"late", std::chrono::duration_cast<std::chrono::microseconds>(now - last).count()});
    last = now;
}

int run(const Options& options)
{
    auto created = DistributedSystem::create(options.settings);
    if (!created) {
        tell({"failed", created.error().what});
        return 1;
    }
    auto& system = *created.value();
    const auto part = partOf(system, options);
    if (options.quiet || system.report("RobotStatus")) // robots hear each other's reports; nobody needs them
        (void)system.subscribe("RobotStatus", [](const Message&) {});
    system.subscribe([&](const SessionEvent& event) {
        tellEvent(system, event);
        part->handle(event);
    });
    SteadyTime last{};
    HeapWatch heap;
    system.every(std::chrono::milliseconds(2), [&] {
        const auto now = std::chrono::steady_clock::now();
        tellGap(last, now);
        heap.tick(now);
        part->tick(now);
    });
    if (!options.hoard)
        system.cache().setNotification([&] { system.post([&] { (void)system.cache().drain(); }); });
    system.start();
    tell({"ready"});
    for (std::string line; std::getline(std::cin, line) && line != "quit";)
        system.post([&, line] { obey(system, *part, line); });
    system.stop();
    tell({"stopped"});
    return 0;
}

} // namespace

} // namespace liena::lab

int main(int argc, char** argv)
{
    CLI::App app("One device of the lab; started by `lab`.");
    try {
        return liena::lab::run(liena::lab::readOptions(app, argc, argv));
    } catch (const CLI::ParseError& error) {
        return app.exit(error);
    } catch (const std::exception& failure) {
        liena::lab::tell({"failed", failure.what()});
        return 1;
    }
}
