// How often a session that lives is taken for lost when single frames are lost.
#include "runner/studies.hpp"

#include "runner/judge.hpp"
#include "runner/many.hpp"
#include "support/canary.hpp"

#include <cstdio>
#include <map>

namespace liena::lab {

namespace {

constexpr std::size_t devices = 4;
constexpr double ratioWithoutEvents = 3.0; // 95 % bound of a Poisson rate when none was seen

struct Counts {
    int suspect = 0;
    int interrupted = 0;
    int standBy = 0;
    int stalls = 0; ///< processes that found they had not run
};

/// Both ends may notice one silence: a link's count is that of the end that noticed more.
Counts count(Rig& rig)
{
    std::map<std::string, std::map<std::string, int>> seen; ///< by "device peer", by state
    Counts counts;
    for (const auto& device : rig.devices())
        for (const auto& record : device->records) {
            if (record.kind() == "state")
                ++seen[device->name + " " + record.word(1)][record.word(3)];
            counts.stalls += record.kind() == "event" && record.word(1) == "local-stall";
        }
    for (const auto& link : rig.plan().links) {
        const auto [a, b] = endsOf(link);
        auto& here = seen[a + " " + b];
        auto& there = seen[b + " " + a];
        counts.suspect += std::max(here["suspect"], there["suspect"]);
        counts.interrupted += std::max(here["interrupted"], there["interrupted"]);
        counts.standBy += std::max(here["stand-by"], there["stand-by"]);
    }
    return counts;
}

std::string rate(int events, double hours)
{
    char text[64];
    if (events == 0)
        std::snprintf(text, sizeof text, "0 (below %.0f/h at 95 %%)", ratioWithoutEvents / hours);
    else
        std::snprintf(text, sizeof text, "%d (%.0f/h)", events, events / hours);
    return text;
}

bool studyOne(Rig& rig, Judge& judge, const std::string& title, const std::string& order, const StudyOptions& options)
{
    std::vector<std::string> broken;
    test::Canary canary;
    openEveryLink(rig);
    rig.settle(Milliseconds(500));
    auto tally = judge.judge(broken);
    (void)rig.wire("link *>* " + order);
    (void)canary.takeLargest();
    rig.settle(std::chrono::seconds(options.lossSeconds));
    const auto stall = canary.takeLargest();
    const auto counts = count(rig);
    (void)rig.wire("link *>*");
    rig.settle(Milliseconds(1200));
    openEveryLink(rig);
    tally.add(judge.judge(broken));
    const double hours = options.lossSeconds * static_cast<double>(rig.plan().links.size()) / 3600;
    std::printf("%-26s %zu links x %d s = %.3f link hours: suspect %s, interrupted %s, stand-by %s; processes stalled %d; stall %.1f ms\n",
                title.c_str(), rig.plan().links.size(), options.lossSeconds, hours, rate(counts.suspect, hours).c_str(),
                rate(counts.interrupted, hours).c_str(), rate(counts.standBy, hours).c_str(), counts.stalls, stall);
    return concludes(tally, broken);
}

} // namespace

bool studyLoss(const StudyOptions& options)
{
    std::printf("\nFalse alarms under loss, 2 ms round trip; the machine's own stalls are among them\n");
    Rig rig(plans::mesh(devices), {options.seed, options.ordinary, options.keep});
    Judge judge(rig);
    rig.startAll();
    bool holds = studyOne(rig, judge, "no loss", "delay=1", options);
    holds &= studyOne(rig, judge, "1 % of all frames", "delay=1 drop=0.01", options);
    holds &= studyOne(rig, judge, "5 % of all frames", "delay=1 drop=0.05", options);
    return holds;
}

} // namespace liena::lab
