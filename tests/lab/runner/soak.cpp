// The soak: a random fault every half minute for hours, and nothing may grow.
#include "runner/studies.hpp"

#include "runner/canary.hpp"
#include "runner/faults.hpp"
#include "runner/judge.hpp"
#include "runner/process_facts.hpp"
#include "runner/trend.hpp"

#include <algorithm>
#include <cstdio>
#include <map>
#include <random>
#include <set>

namespace liena::lab {

namespace {

constexpr double warmUp = 0.2;      // part of the whole that is left out: caches and pools fill
constexpr double mostGrowth = 1024; // KiB/h that memory may not surely exceed
constexpr Milliseconds rest{3000};  // before a sample: sessions open, commands and pictures flowing
constexpr auto pictures = "pictures 50000 200";

/// Of one process since it was started; a device that is killed begins a new series.
struct Series {
    pid_t process = -1;
    Trend memory; ///< KiB
    Trend descriptors;
    Trend threads;
    Trend timers;
};

/// Those that leave the cockpit and the X-ray system alive, so that their series run from end to end.
std::vector<Fault> soakFaults()
{
    const std::set<std::string> wanted{"cut",        "unplug",    "interface-down", "replug-50",     "replug-90",      "replug-300",
                                       "flap",       "half-open", "deaf-robot",     "deaf-cockpit",  "udp-lost",       "tcp-lost",
                                       "loss-5",     "bursts-10", "disorder",       "growing-delay", "freeze-cockpit", "freeze-robot",
                                       "kill-robot", "both-open", "reset",          "descriptors"};
    auto faults = allFaults();
    std::erase_if(faults, [&](const Fault& fault) { return !wanted.contains(fault.name); });
    return faults;
}

class Soak {
public:
    explicit Soak(const StudyOptions& options)
        : m_options(options),
          m_random(options.seed),
          m_faults(soakFaults()),
          m_rig(plans::withPictures(), {options.seed, options.ordinary, options.keep}),
          m_judge(m_rig)
    {}

    bool run();

private:
    void repeat();
    void sample(double hours);
    void report(double hours);
    bool judgeSeries();
    double hoursSinceStart() const { return static_cast<double>(nowNs() - m_start) / 3.6e12; }

    StudyOptions m_options;
    std::mt19937_64 m_random;
    std::vector<Fault> m_faults;
    Rig m_rig;
    Judge m_judge;
    Canary m_canary;
    std::map<std::string, Series> m_series;
    std::vector<std::string> m_broken;
    Tally m_tally;
    int m_repetitions = 0;
    std::int64_t m_start = nowNs();
};

bool Soak::run()
{
    m_rig.startAll();
    m_start = nowNs();
    const double sampling = std::max(0.02, m_options.soakHours / 60);
    double nextReport = sampling;
    while (hoursSinceStart() < m_options.soakHours && m_broken.size() < 20) {
        const auto next = nowNs() + std::int64_t{m_options.soakInterval} * 1'000'000'000;
        repeat();
        const auto left = Milliseconds((next - nowNs()) / 1'000'000);
        m_rig.settle(std::max(rest, left));
        sample(hoursSinceStart());
        m_tally.add(m_judge.judge(m_broken));
        if (hoursSinceStart() >= nextReport) {
            report(hoursSinceStart());
            nextReport = hoursSinceStart() + sampling;
        }
    }
    report(hoursSinceStart());
    const bool constant = judgeSeries();
    for (const auto& line : m_broken)
        std::printf("    BROKEN: %s\n", line.c_str());
    return constant && m_broken.empty() && m_tally.broken() == 0;
}

void Soak::repeat()
{
    const auto& fault = m_faults[m_random() % m_faults.size()];
    ++m_repetitions;
    Scene scene(m_rig, m_random);
    try {
        fault.run(scene);
        scene.engage();
    } catch (const Stuck& reason) {
        scene.fails(reason.what);
    }
    for (const auto& line : scene.outcome().broken)
        m_broken.push_back(fault.name + ": " + line);
    m_rig.say("xray", pictures);
}

void Soak::sample(double hours)
{
    for (const auto& device : m_rig.devices()) {
        const pid_t process = device->process->id();
        Series& series = m_series[device->name];
        if (series.process != process)
            series = Series{process, {}, {}, {}, {}};
        if (hours < m_options.soakHours * warmUp)
            continue;
        series.memory.add(hours, static_cast<double>(anonymousKiB(process)));
        series.descriptors.add(hours, static_cast<double>(countDescriptors(process)));
        series.threads.add(hours, static_cast<double>(countThreads(process)));
        series.timers.add(hours, static_cast<double>(countTimers(process)));
    }
}

void Soak::report(double hours)
{
    std::printf("%6.2f h  %4d faults  %llu commands applied, %llu broken rules  stall %.0f ms ", hours, m_repetitions,
                static_cast<unsigned long long>(m_tally.applied), static_cast<unsigned long long>(m_tally.broken()),
                m_canary.takeLargest());
    for (const auto& device : m_rig.devices()) {
        const pid_t process = device->process->id();
        std::printf(" | %s %llu KiB %zu fd %zu thr %zu tmr", device->name.c_str(), static_cast<unsigned long long>(anonymousKiB(process)),
                    countDescriptors(process), countThreads(process), countTimers(process));
    }
    std::printf("\n");
    std::fflush(stdout);
}

bool Soak::judgeSeries()
{
    constexpr std::size_t fewest = 10;
    bool constant = true;
    std::printf("constant means: descriptors, threads and timers are never more in the second half than in the first, and memory does not\n"
                "surely (slope less two standard errors) grow by more than %.0f KiB/h; the first %.0f %% of the time are left out\n",
                mostGrowth, warmUp * 100);
    for (auto& [name, series] : m_series) {
        if (series.memory.size() < fewest) {
            std::printf("%-8s was started anew too late to be judged (%zu samples)\n", name.c_str(), series.memory.size());
            continue;
        }
        const auto grew = [](const Trend& trend) { return trend.largestOf(0.5, 1) > trend.largestOf(0, 0.5); };
        const bool holds = series.memory.slope() - 2 * series.memory.uncertainty() <= mostGrowth && !grew(series.descriptors) &&
                           !grew(series.threads) && !grew(series.timers);
        std::printf(
            "%-8s %3zu samples: memory %.0f -> %.0f KiB, slope %+.0f +- %.0f KiB/h; descriptors at most %.0f then %.0f; threads %.0f "
            "then %.0f; timers %.0f then %.0f: %s\n",
            name.c_str(), series.memory.size(), series.memory.first(), series.memory.last(), series.memory.slope(),
            series.memory.uncertainty(), series.descriptors.largestOf(0, 0.5), series.descriptors.largestOf(0.5, 1),
            series.threads.largestOf(0, 0.5), series.threads.largestOf(0.5, 1), series.timers.largestOf(0, 0.5),
            series.timers.largestOf(0.5, 1), holds ? "constant" : "BROKEN: grows");
        constant = constant && holds;
    }
    return constant;
}

} // namespace

bool soak(const StudyOptions& options) { return Soak(options).run(); }

} // namespace liena::lab
