// The soak: a random fault every half minute for hours, and nothing may grow.
#include "runner/studies.hpp"

#include "runner/faults.hpp"
#include "runner/judge.hpp"
#include "runner/process_facts.hpp"
#include "runner/trend.hpp"
#include "support/canary.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <random>
#include <set>
#include <utility>

namespace liena::lab {

namespace {

constexpr double warmUp = 0.2;        // part of a series that is left out: caches and pools fill
constexpr double mostPerFault = 256;  // bytes of heap that one may surely keep: the bounded book of ended incidents
constexpr double mostResident = 1024; // KiB/h that the system may surely have given more
constexpr Milliseconds rest{3000};    // before a sample: sessions open, commands and pictures flowing
constexpr auto pictures = "pictures 50000 200";

/// Of one process since it was started; a device that is killed begins a new one.
struct Series {
    pid_t process = -1;
    Trend heap;     ///< KiB in use
    Trend resident; ///< KiB had from the system; never less than what the worst moment took
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
    bool judgeSeries() const;
    bool judge(const std::string& name, const Series& series) const;
    double hoursSinceStart() const { return static_cast<double>(nowNs() - m_start) / 3.6e12; }

    StudyOptions m_options;
    std::mt19937_64 m_random;
    std::vector<Fault> m_faults;
    Rig m_rig;
    Judge m_judge;
    test::Canary m_canary;
    std::map<std::string, std::vector<Series>> m_series; ///< of each device, one a life
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
        auto& lives = m_series[device->name];
        if (lives.empty() || lives.back().process != process)
            lives.push_back(Series{process, {}, {}, {}, {}, {}});
        Series& series = lives.back();
        if (const auto bytes = device->takeHeap(); bytes != 0)
            series.heap.add(hours, static_cast<double>(bytes) / 1024);
        series.resident.add(hours, static_cast<double>(anonymousKiB(process)));
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

bool Soak::judgeSeries() const
{
    std::printf(
        "judged is the longest life of each device without its first %.0f %%; constant means: descriptors, threads and timers are\n"
        "never more in its second half than in its first, the heap in use does not surely (slope less two standard errors) grow by\n"
        "more than %.0f bytes a fault, nor what was had from the system by more than %.0f KiB/h\n",
        warmUp * 100, mostPerFault, mostResident);
    bool constant = true;
    for (const auto& [name, lives] : m_series)
        constant &= judge(name, *std::max_element(lives.begin(), lives.end(), [](const Series& one, const Series& other) {
                              return one.resident.size() < other.resident.size();
                          }));
    return constant;
}

bool Soak::judge(const std::string& name, const Series& series) const
{
    constexpr std::size_t fewest = 10;
    const auto judged = [](const Trend& trend) { return trend.between(warmUp, 1); };
    const Trend heap = judged(series.heap);
    const Trend resident = judged(series.resident);
    if (heap.size() < fewest || resident.size() < fewest) {
        std::printf("%-8s did not live long enough to be judged (%zu samples)\n", name.c_str(), std::min(heap.size(), resident.size()));
        return true;
    }
    bool holds = true;
    std::string counts;
    for (const auto& [what, trend] :
         {std::pair("descriptors", &series.descriptors), std::pair("threads", &series.threads), std::pair("timers", &series.timers)}) {
        const Trend whole = judged(*trend);
        holds &= whole.largestOf(0.5, 1) <= whole.largestOf(0, 0.5);
        counts += "; " + std::string(what) + " at most " + std::to_string(std::lround(whole.largestOf(0, 0.5))) + " then " +
                  std::to_string(std::lround(whole.largestOf(0.5, 1)));
    }
    const double faultsAnHour = m_repetitions / hoursSinceStart();
    const double perFault = heap.slope() * 1024 / faultsAnHour;
    const double uncertainty = heap.uncertainty() * 1024 / faultsAnHour;
    holds &= perFault - 2 * uncertainty <= mostPerFault && resident.slope() - 2 * resident.uncertainty() <= mostResident;
    std::printf("%-8s %3zu samples: heap %.0f -> %.0f KiB, %+.0f +- %.0f bytes a fault; from the system %.0f -> %.0f KiB, slope %+.0f +- "
                "%.0f then %+.0f +- %.0f KiB/h%s: %s\n",
                name.c_str(), heap.size(), heap.first(), heap.last(), perFault, uncertainty, resident.first(), resident.last(),
                resident.between(0, 0.5).slope(), resident.between(0, 0.5).uncertainty(), resident.between(0.5, 1).slope(),
                resident.between(0.5, 1).uncertainty(), counts.c_str(), holds ? "constant" : "BROKEN: grows");
    return holds;
}

} // namespace

bool soak(const StudyOptions& options) { return Soak(options).run(); }

} // namespace liena::lab
