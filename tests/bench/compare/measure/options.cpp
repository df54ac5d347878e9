// Reading the command line.
#include "measure/options.hpp"

#include <CLI/CLI.hpp>

#include <map>

namespace liena::compare {

Options readOptions(int argc, char** argv, const std::string& transport)
{
    static const std::map<std::string, Role> roles{{"client", Role::Client}, {"echo", Role::Echo}};
    static const std::map<std::string, WorkloadKind> workloads{{"roundtrip", WorkloadKind::RoundTrip},
                                                               {"paced", WorkloadKind::Paced},
                                                               {"load", WorkloadKind::Load},
                                                               {"frames", WorkloadKind::Frames},
                                                               {"messages", WorkloadKind::Messages}};
    CLI::App app("One end of a measured link over " + transport + "; started by tests/bench/compare/run. Ends with its input.");
    Options options;
    app.add_option("--role", options.role)->required()->transform(CLI::CheckedTransformer(roles));
    app.add_option("--workload", options.workload)->required()->transform(CLI::CheckedTransformer(workloads));
    app.add_option("--host", options.host, "where the echo listens")->capture_default_str();
    app.add_option("--port", options.port)->capture_default_str();
    app.add_option("--pair", options.pair, "of those that run at once; DDS keeps them apart as domains")
        ->capture_default_str()
        ->check(CLI::Range(0, 99));
    app.add_option("--seconds", options.seconds, "that are measured")->capture_default_str();
    app.add_option("--warm-up", options.warmUp, "seconds before them")->capture_default_str();
    app.add_option("--command-rate", options.commandRate, "per second, of load and paced")->capture_default_str();
    app.add_option("--frame-rate", options.frameRate, "per second, of load; 0: commands alone")->capture_default_str();
    app.add_option("--second-rate", options.secondRate,
                   "per second, of a second stream of frames, of load; LiENa and raw TCP give it a way of its own")
        ->capture_default_str();
    app.add_option("--frame-bytes", options.frameBytes)->capture_default_str();
    app.add_flag("--status", options.status, "of load: frames as status messages, on the connection of the commands; LiENa only");
    app.add_flag("--timeline", options.timeline, "of load: tell every single latency");
    app.add_flag("--spin", options.spins, "never sleep while waiting; LiENa and raw TCP only");
    app.add_flag("--asleep", options.asleep, "sleep while waiting, also within a dialogue; LiENa only");
    app.add_flag("--packets", options.packets, "commands and echoes as UDP packets of their own; LiENa only");
    app.add_option("--workers", options.workers, "threads that may seal and open frames; LiENa only")->check(CLI::Range(0U, 4U));
    app.add_option("--files", options.files, "folder with topology.xml and pki/")->capture_default_str();
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        std::exit(app.exit(error));
    }
    return options;
}

} // namespace liena::compare
