// How long it takes until every live device of eight knows of a stand-by.
#include "runner/studies.hpp"

#include "runner/judge.hpp"
#include "runner/many.hpp"
#include "runner/statistics.hpp"
#include "support/canary.hpp"

#include <algorithm>
#include <cstdio>

namespace liena::lab {

namespace {

constexpr std::size_t devices = 8;
constexpr Milliseconds cutTime{1200};

bool beganStandBy(const Record& record) { return record.kind() == "event" && record.word(1) == "stand-by-began"; }

struct Spread {
    Sample fromFirst; ///< ms from the first device that knew to the last
    Sample fromCut;
    int unaware = 0; ///< devices that never heard
};

/// `dead` is a device that the cut parts from all others; it is not asked.
void measure(Rig& rig, std::int64_t cut, const std::string& dead, Spread& spread)
{
    std::int64_t first = INT64_MAX;
    std::int64_t last = 0;
    for (const auto& device : rig.devices()) {
        const auto* began = device->first(cut, beganStandBy);
        if (device->name == dead)
            continue;
        if (began == nullptr) {
            ++spread.unaware;
            continue;
        }
        first = std::min(first, began->at);
        last = std::max(last, began->at);
    }
    spread.fromFirst.add(static_cast<double>(last - first) / 1e6);
    spread.fromCut.add(static_cast<double>(last - cut) / 1e6);
}

bool studyOne(const std::string& title, SystemPlan plan, const std::string& order, const std::string& dead, const StudyOptions& options)
{
    Rig rig(std::move(plan), {options.seed, options.ordinary, options.keep});
    Judge judge(rig);
    test::Canary canary;
    Spread spread;
    Tally tally;
    std::vector<std::string> broken;
    rig.startAll();
    openEveryLink(rig);
    rig.settle(Milliseconds(500));
    (void)canary.takeLargest();
    for (int i = 0; i < options.repetitions; ++i) {
        tally.add(judge.judge(broken));
        const auto cut = rig.wire("link " + order + " cut");
        if (order == "1>2")
            (void)rig.wire("link 2>1 cut");
        if (!dead.empty())
            (void)rig.wire("link 8>* cut");
        rig.settle(cutTime);
        (void)rig.wire("link *>*");
        measure(rig, cut, dead, spread);
        rig.settle(Milliseconds(500));
        openEveryLink(rig);
        rig.settle(Milliseconds(500));
    }
    const double stall = canary.takeLargest();
    tally.add(judge.judge(broken));
    std::printf("%-44s n %2zu  from the first p50 %5.1f  p99 %5.1f   from the cut p50 %5.0f  p99 %5.0f ms   stall %.1f ms\n", title.c_str(),
                spread.fromFirst.size(), spread.fromFirst.at(0.5), spread.fromFirst.at(0.99), spread.fromCut.at(0.5),
                spread.fromCut.at(0.99), stall);
    if (spread.unaware > 0)
        broken.push_back(std::to_string(spread.unaware) + " times a live device never heard of the stand-by");
    return concludes(tally, broken);
}

} // namespace

bool studySpread(const StudyOptions& options)
{
    std::printf("\nEvery live device of eight knows of a stand-by\n");
    bool holds = studyOne("star, cockpit and one robot parted", plans::star(devices), "1>2", "", options);
    holds &= studyOne("mesh of 28 links, cockpit and one robot parted", plans::mesh(devices), "1>2", "", options);
    holds &= studyOne("mesh, one robot parted from all", plans::mesh(devices), "*>8", "robot7", options);
    return holds;
}

} // namespace liena::lab
