// lab: breaks what lies between and under real devices, and holds what they then do against what must hold.
#include "runner/campaign.hpp"
#include "runner/studies.hpp"

#include <CLI/CLI.hpp>

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <stdexcept>

namespace liena::lab {

std::vector<Fault> allFaults()
{
    std::vector<Fault> all;
    for (auto&& faults : {linkFaults(), qualityFaults(), processFaults(), resourceFaults()})
        all.insert(all.end(), faults.begin(), faults.end());
    return all;
}

namespace {

struct Options {
    CampaignOptions campaign;
    std::vector<std::string> faults;
    std::string json;
    StudyOptions study;
    bool list = false;
    bool spread = false;
    bool loss = false;
    bool memory = false;
    bool share = false;
    bool soak = false;
    int spin = 0; ///< ms

    bool all() const { return faults.empty() && !spread && !loss && !memory && !share && !soak; }
};

int listFaults()
{
    for (const auto& fault : allFaults())
        std::printf("%-15s %-4s %s\n", fault.name.c_str(), fault.row.c_str(), fault.sentence.c_str());
    return 0;
}

/// Empty for a fault's name; else what is said of it. A run of none would say that everything held.
std::string refuseUnknown(const std::string& name)
{
    std::string names;
    for (const auto& fault : allFaults()) {
        if (fault.name == name)
            return {};
        names += (names.empty() ? "" : ", ") + fault.name;
    }
    return "no fault is called " + name + "; there are " + names;
}

/// Looks at the clock itself: nothing that would stop it may need the processor that it takes.
int spin(int milliseconds)
{
    const auto end = nowNs() + std::int64_t{milliseconds} * 1'000'000;
    while (nowNs() < end) {
    }
    return 0;
}

std::vector<Fault> chosenFaults(const Options& options)
{
    auto faults = allFaults();
    if (!options.faults.empty())
        std::erase_if(faults, [&](const Fault& fault) {
            return std::find(options.faults.begin(), options.faults.end(), fault.name) == options.faults.end();
        });
    // Those of one system behind each other, in the order of the table else.
    std::stable_sort(faults.begin(), faults.end(), [](const Fault& a, const Fault& b) { return a.cast < b.cast; });
    return faults;
}

/// Asked before what takes long; what stands in the file is kept until there is something new.
bool canWrite(const std::string& file) { return static_cast<bool>(std::ofstream(file, std::ios::app)); }

bool runFaults(const Options& options)
{
    Campaign campaign(options.campaign);
    std::vector<Row> rows;
    printHead();
    for (const auto& fault : chosenFaults(options)) {
        rows.push_back(campaign.run(fault));
        printRow(rows.back());
    }
    if (!options.json.empty()) {
        std::ofstream file(options.json);
        if (!(file << toJson(rows) << std::flush))
            throw std::runtime_error(options.json + " was not written: " + std::strerror(errno));
    }
    return std::all_of(rows.begin(), rows.end(), [](const Row& row) { return row.holds(); });
}

bool runAll(const Options& options)
{
    bool holds = true;
    if (options.all() || !options.faults.empty())
        holds &= runFaults(options);
    if (options.all() || options.spread)
        holds &= studySpread(options.study);
    if (options.all() || options.loss)
        holds &= studyLoss(options.study);
    if (options.all() || options.memory)
        holds &= studyMemory(options.study);
    if (options.all() || options.share)
        holds &= studyShare(options.study);
    if (options.soak)
        holds &= soak(options.study);
    return holds;
}

void addOptions(CLI::App& app, Options& options)
{
    app.add_option("--fault", options.faults, "only these; see --list")->check(refuseUnknown);
    app.add_option("--repetitions", options.campaign.repetitions, "of each fault")->check(CLI::Range(1, 100'000));
    app.add_option("--seed", options.campaign.seed, "of every random decision");
    app.add_option("--json", options.json, "write the rows to this file as well");
    app.add_flag("--spread", options.spread, "how soon every live device of eight knows of a stand-by");
    app.add_flag("--loss", options.loss, "false alarms under loss");
    app.add_option("--loss-seconds", options.study.lossSeconds, "at each rate of loss")->check(CLI::Range(1, 86'400));
    app.add_flag("--memory", options.memory, "memory per idle session");
    app.add_flag("--share", options.share, "how two sessions of one device share a line");
    app.add_flag("--soak", options.soak, "a random fault every half minute");
    app.add_option("--hours", options.study.soakHours, "of the soak")->check(CLI::Range(0.01, 1000.0));
    app.add_option("--interval", options.study.soakInterval, "seconds from fault to fault of the soak")->check(CLI::Range(5, 3600));
    app.add_option("--spin", options.spin, "only keep a processor busy for some ms: what the fault `starve` starts")
        ->check(CLI::Range(1, 900));
    app.add_flag("--list", options.list, "say what the faults are");
    app.add_flag("--ordinary", options.campaign.ordinary, "without real-time priority for the devices, the wire and the canary");
    app.add_flag("--keep", options.campaign.keep, "keep the folders with topology, certificates and logs");
}

int run(const Options& options)
{
    if (options.list)
        return listFaults();
    if (options.spin > 0)
        return spin(options.spin);
    if (!options.json.empty() && !canWrite(options.json)) {
        std::fprintf(stderr, "lab: %s cannot be written: %s\n", options.json.c_str(), std::strerror(errno));
        return 2;
    }
    if (::geteuid() != 0) {
        std::fputs("lab: this must be run as root: it makes network namespaces and TAP devices of its own\n", stderr);
        return 2;
    }
    if (!options.campaign.ordinary)
        makeUrgent(runnerUrgency);
    const bool holds = runAll(options);
    std::printf("lab: %s\n", holds ? "everything that must hold held" : "BROKEN: see the lines above");
    return holds ? 0 : 1;
}

} // namespace

} // namespace liena::lab

int main(int argc, char** argv)
{
    CLI::App app("Breaks what lies between and under LiENa's devices, and prints what they do.");
    liena::lab::Options options;
    std::signal(SIGPIPE, SIG_IGN); // a device that has died says so by the end of its output
    try {
        liena::lab::addOptions(app, options);
        app.parse(argc, argv);
        options.campaign.repetitionsAsked = app.count("--repetitions") > 0;
        options.study.repetitions = options.campaign.repetitions;
        options.study.seed = options.campaign.seed;
        options.study.ordinary = options.campaign.ordinary;
        options.study.keep = options.campaign.keep;
        return liena::lab::run(options);
    } catch (const CLI::ParseError& error) {
        constexpr int wrongUse = 2;
        return app.exit(error) == 0 ? 0 : wrongUse;
    } catch (const std::exception& failure) {
        std::fprintf(stderr, "lab: %s\n", failure.what());
        return 1;
    }
}
