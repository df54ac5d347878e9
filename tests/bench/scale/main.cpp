// scale_bench: what sessions cost as devices grow in number, all joined with all, on one computer. Prints; judges only the counts.
#include "scale/awake_processors.hpp"
#include "scale/mesh_device.hpp"
#include "scale/scale_table.hpp"

#include <CLI/CLI.hpp>

#include <csignal>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <memory>

namespace {

using namespace liena::bench;

int measureAll(const ScaleOptions& options, const std::string& json)
{
    const auto mostFiles = raiseFileLimit();
    const auto awake = options.keepAwake ? std::make_unique<AwakeProcessors>() : nullptr;
    std::vector<ScaleRow> rows;
    bool whole = true;
    for (const auto devices : options.devices) {
        if (const auto refusal = meshRefusal(devices, mostFiles); !refusal.empty()) {
            std::cerr << "scale_bench: " << refusal << '\n';
            whole = false;
            break;
        }
        rows.push_back(measureScale(devices, options));
        whole = whole && rows.back().faults.empty();
        std::cerr << scaleTable({rows.back()}, options) << std::flush; // a long run shows where it is
    }
    std::cout << scaleTable(rows, options);
    if (!json.empty() && !(std::ofstream(json) << scaleJson(rows, options) << '\n' << std::flush)) {
        std::cerr << "scale_bench: cannot write " << json << '\n';
        return 1;
    }
    return whole ? 0 : 1;
}

} // namespace

int main(int argc, char** argv)
{
    std::signal(SIGPIPE, SIG_IGN);
    CLI::App app("Measures devices that are all joined with all, on this computer. Fails when sessions or messages are missing.");
    ScaleOptions options;
    MeshDeviceOptions device;
    int heartbeat = 20;
    std::string json;
    app.add_option("--devices", options.devices, "how many: one size after the other")->delimiter(',')->check(CLI::Range(2, 64));
    app.add_option("--heartbeat", heartbeat, "ms")->capture_default_str()->check(CLI::Range(1, 10'000));
    app.add_option("--seconds", options.seconds, "of each interval")->capture_default_str()->check(CLI::PositiveNumber);
    app.add_option("--rounds", options.rounds)->capture_default_str()->check(CLI::Range(1, 100));
    app.add_option("--rate", options.rate, "round trips per second, of all devices together")->capture_default_str();
    app.add_flag("--keep-awake", options.keepAwake, "no processor sleeps: costs without those of waking one");
    app.add_option("--json", json, "write the figures there as well");
    auto* one = app.add_subcommand("device", "one of the devices; started by scale_bench");
    one->add_option("--folder", device.folder)->required();
    one->add_option("--index", device.index)->required();
    one->add_option("--of", device.devices)->required();
    one->add_option("--rate", device.rate)->required();
    one->add_flag("--plain", device.plain, "sockets instead of LiENa");
    CLI11_PARSE(app, argc, argv);
    options.heartbeat = std::chrono::milliseconds(heartbeat);
    options.program = std::filesystem::read_symlink("/proc/self/exe");
    try {
        return *one ? runMeshDevice(device) : measureAll(options, json);
    } catch (const std::exception& failure) {
        std::fprintf(stderr, "scale_bench: %s\n", failure.what());
        return 1;
    }
}
