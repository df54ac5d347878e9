// How the sessions of one device share the line that they all leave by.
#include "runner/studies.hpp"

#include "runner/judge.hpp"
#include "runner/many.hpp"
#include "runner/statistics.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

namespace liena::lab {

namespace {

constexpr int bytesForBoth = 1024 * 1024; // of one viewer's picture and the other's
constexpr int period = 66;                // ms
constexpr Milliseconds learning{5000};
constexpr int seconds = 20;

struct Line {
    const char* title;
    int rate;  ///< bits per second
    int delay; ///< ms, each way
};

enum class Viewers : std::uint8_t {
    One,         ///< who wants as much as two
    Both,        ///< from the beginning
    SecondLater, ///< when the first one has the whole line
};

/// Ages of the pictures of one viewer, in ms, by the second in which they came.
std::vector<Sample> agesOf(const RigDevice& viewer, const RigDevice& xray, std::int64_t from)
{
    std::map<std::string, std::int64_t> sent;
    for (const auto& record : xray.records)
        if (record.kind() == "sent-picture")
            sent[record.word(1)] = record.at;
    std::vector<Sample> ages(seconds);
    for (const auto& record : viewer.records) {
        const auto second = static_cast<std::size_t>(std::max<std::int64_t>(record.at - from, 0) / 1'000'000'000);
        if (record.kind() == "picture" && record.at >= from && second < ages.size() && sent.contains(record.word(1)))
            ages[second].add(static_cast<double>(record.at - sent[record.word(1)]) / 1e6);
    }
    return ages;
}

void print(const RigDevice& viewer, const std::vector<Sample>& ages, int pictureBytes)
{
    Sample all;
    std::string each;
    for (const auto& second : ages) {
        all.add(second);
        each += " " + std::to_string(second.size());
    }
    std::printf("    %-8s %4zu pictures, %5.1f Mbit/s; age p50 %4.0f  p99 %4.0f ms; in each second%s\n", viewer.name.c_str(), all.size(),
                static_cast<double>(all.size()) * pictureBytes * 8 / 1e6 / seconds, all.empty() ? 0 : all.at(0.5),
                all.empty() ? 0 : all.at(0.99), each.c_str());
}

bool studyOne(const Line& line, Viewers viewers, const StudyOptions& options)
{
    Rig rig(plans::twoViewers(), {options.seed, options.ordinary, options.keep});
    Judge judge(rig);
    std::vector<std::string> broken;
    rig.startAll();
    (void)rig.wire("link *>* delay=" + std::to_string(line.delay));
    (void)rig.wire("port 1 rate=" + std::to_string(line.rate) + " queue=512000");
    std::vector<std::string> links{"cockpit robot", "viewer robot", "cockpit xray"};
    openLinks(rig, links);
    if (viewers == Viewers::Both)
        openLinks(rig, {"viewer xray"});
    const int pictureBytes = viewers == Viewers::One ? bytesForBoth : bytesForBoth / 2;
    rig.say("xray", "pictures " + std::to_string(pictureBytes) + " " + std::to_string(period));
    rig.settle(learning);
    Tally tally = judge.judge(broken);
    const auto from = nowNs();
    if (viewers == Viewers::SecondLater)
        openLinks(rig, {"viewer xray"});
    if (viewers != Viewers::One)
        links.emplace_back("viewer xray");
    rig.settle(Milliseconds(1000 * seconds - (nowNs() - from) / 1'000'000));
    constexpr const char* titles[]{"one viewer, pictures of 1 MiB", "two viewers, pictures of 512 KiB each",
                                   "the second viewer comes later"};
    std::printf("  %s: %s\n", line.title, titles[static_cast<std::size_t>(viewers)]);
    print(rig["cockpit"], agesOf(rig["cockpit"], rig["xray"], from), pictureBytes);
    if (viewers != Viewers::One)
        print(rig["viewer"], agesOf(rig["viewer"], rig["xray"], from), pictureBytes);
    for (const auto& link : links)
        if (!isOpen(rig, link))
            broken.push_back("the link " + link + " is not open");
    tally.add(judge.judge(broken));
    return concludes(tally, broken);
}

} // namespace

bool studyShare(const StudyOptions& options)
{
    std::printf("\nTwo sessions of one X-ray system behind one line: pictures at 15/s, 126 Mbit/s in all, %d s\n", seconds);
    bool holds = true;
    for (const auto& line :
         {Line{"100 Mbit/s", 100'000'000, 0}, Line{"100 Mbit/s, 20 ms each way", 100'000'000, 20}, Line{"200 Mbit/s", 200'000'000, 0}})
        for (const auto viewers : {Viewers::One, Viewers::Both, Viewers::SecondLater})
            holds &= studyOne(line, viewers, options);
    return holds;
}

} // namespace liena::lab
