// Faults of a way that still works: loss, bursts, reordering, delay, bandwidth, one protocol only.
#include "runner/faults.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <utility>

namespace liena::lab {

namespace {

std::string milliseconds(double value)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.0f ms", value);
    return text;
}

std::size_t count(const RigDevice& device, const std::string& kind, const std::string& word = {}, const std::string& third = {})
{
    std::size_t found = 0;
    for (const auto& record : device.records)
        found += record.kind() == kind && (word.empty() || record.word(1) == word) && (third.empty() || record.word(3) == third);
    return found;
}

/// Commands go on for `time` while the way is bad; the person arms again whenever the robot has stopped.
void workThrough(Scene& scene, const std::string& order, Milliseconds time)
{
    scene.engage();
    scene.beginByWire(order);
    const auto end = nowNs() + std::chrono::nanoseconds(time).count();
    int stops = 0;
    while (nowNs() < end) {
        const auto left = Milliseconds((end - nowNs()) / 1'000'000 + 1);
        if (!scene.rig().until([&] { return !scene.robot().moving; }, left))
            break;
        ++stops;
        const auto wanted = std::min(left, Milliseconds(1500));
        (void)scene.rig().until([&] { return scene.cockpit().heard["robot"] == "Ready" && scene.cockpit().isOpenTo("robot"); }, wanted);
        if (scene.cockpit().stateOf("robot") == "stand-by")
            break;
        scene.rig().say("cockpit", "arm robot");
        (void)scene.rig().until([&] { return scene.robot().moving; }, wanted);
    }
    scene.heal();
    const auto interruptions = count(scene.cockpit(), "state", "robot", "interrupted");
    scene.recover();
    scene.note("drive stops " + std::to_string(stops) + " in " + std::to_string(time.count() / 1000) + " s, interruptions " +
               std::to_string(interruptions));
}

std::function<void(Scene&)> quality(const std::string& setting, Milliseconds time = Milliseconds(8000))
{
    return [setting, time](Scene& scene) { workThrough(scene, "link *>* " + setting, time); };
}

/// What only one protocol loses must not lose the session; `after` is what has to be true then.
void withoutUdp(Scene& scene)
{
    scene.engage();
    scene.beginByWire("link *>* cut only=udp");
    scene.rig().settle(Milliseconds(1200));
    scene.read();
    scene.must({"unnoticed", "suspect"});
    // Commands must flow again, on lane 0, before the datagrams are back.
    const auto from = nowNs();
    scene.engage();
    scene.rig().settle(Milliseconds(500));
    scene.note("fallen back to lane 0");
    if (count(scene.robot(), "applied") == 0 || scene.largestGap(from) <= 0)
        scene.fails("no command was applied without UDP");
    scene.heal();
    scene.recover();
}

void withoutTcp(Scene& scene)
{
    scene.engage();
    scene.disturb("link *>* cut only=tcp", Milliseconds(1500));
    scene.recover();
    scene.must({"stand-by"});
}

/// The cockpit's way in carries pictures and the robot's reports; then it carries next to nothing.
std::function<void(Scene&)> collapse(long rate, long queue, long picture)
{
    return [=](Scene& scene) {
        scene.engage();
        scene.rig().say("xray", "pictures " + std::to_string(picture) + " 66");
        const auto first = scene.cockpit().pictures;
        scene.await([&] { return scene.cockpit().pictures > first + 3; }, Milliseconds(5000), "no pictures arrived before the fault");
        const auto before = scene.cockpit().pictures;
        const auto from = nowNs();
        scene.beginByWire("port 1 rate=" + std::to_string(rate) + " queue=" + std::to_string(queue));
        scene.rig().settle(Milliseconds(3000));
        scene.note(std::to_string((scene.cockpit().pictures - before) / 3) + " pictures/s");
        scene.rig().say("xray", "pictures 0 66");
        scene.rig().settle(Milliseconds(200));
        (void)scene.rig().wire("port 1 rate=0");
        scene.note("largest gap of commands " + milliseconds(scene.largestGap(from)));
        scene.recover();
    };
}

/// Beside what is required. The fault breaks at twice that: a machine's own noise keeps pictures waiting, too.
std::string healingTime(double found)
{
    constexpr double required = 5000;
    return "full quality again after " + milliseconds(found) + ", required " + milliseconds(required) +
           (found > required ? ": NOT MET" : ": met");
}

bool isRung(const Record& record, std::uint64_t rung) { return record.kind() == "picture" && record.number(3) == rung; }

/// The product's X-ray system takes a lower rung of its ladder when the cockpit's way in falls to a tenth, and the first again when it
/// heals.
void ladder(Scene& scene)
{
    const std::string wide = "port 1 rate=100000000 queue=512000";
    const std::string narrow = "port 1 rate=10000000 queue=64000";
    auto& rig = scene.rig();
    auto& cockpit = scene.cockpit();
    const auto isFull = [](const Record& record) { return isRung(record, 0); };
    scene.engage();
    Rig::Start fluoroscopy;
    fluoroscopy.flags = {"--fluoroscopy"};
    scene.restart("xray", cockpit, fluoroscopy);
    (void)rig.wire(wide);
    scene.engage();
    rig.say("cockpit", "pedal xray");
    rig.settle(Milliseconds(5000)); // until it knows what the way carries
    const auto learnt = nowNs();
    scene.await([&] { return cockpit.first(learnt, isFull) != nullptr; }, Milliseconds(5000),
                "the wide way does not carry the pictures as they are asked for");
    const auto fallen = rig.wire(narrow);
    scene.begin(fallen);
    rig.settle(Milliseconds(8000));
    std::uint64_t lowest = 0;
    for (const auto& record : cockpit.records)
        lowest = record.kind() == "picture" && record.at >= fallen ? std::max(lowest, record.number(3)) : lowest;
    if (lowest == 0)
        scene.fails("a tenth of the way, and no picture said that it is reduced");
    const auto healed = rig.wire(wide);
    if (rig.until([&] { return cockpit.first(healed, isFull) != nullptr; }, Milliseconds(10'000)))
        scene.note(healingTime(static_cast<double>(cockpit.first(healed, isFull)->at - healed) / 1e6));
    else
        scene.fails("no picture as asked for within 10 s of the healing");
    scene.note("lowest rung " + std::to_string(lowest) + ", largest gap of commands " + milliseconds(scene.largestGap(fallen)));
    rig.say("cockpit", "pedal up");
    rig.settle(Milliseconds(500));
    (void)rig.wire("port 1 rate=0");
    scene.read();
    scene.must({"unnoticed", "suspect"});
    scene.restart("xray", cockpit, Rig::Start());
    scene.engage();
}

/// The network takes a way that is longer: no queue stands, however late all is, and the pictures go on.
void longerWay(Scene& scene)
{
    constexpr double longestAllowed = 2000; // ms; some pictures come later than the way is longer
    auto& rig = scene.rig();
    auto& cockpit = scene.cockpit();
    scene.engage();
    (void)rig.wire("link *>* delay=2");
    (void)rig.wire("port 1 rate=100000000 queue=512000");
    scene.restart("xray", cockpit, Rig::Start()); // its connections know no shorter way
    scene.engage();
    rig.say("xray", "pictures 300000 66");
    rig.settle(Milliseconds(5000)); // until it knows what the way carries
    const auto changed = rig.wire("link *>* delay=8");
    scene.begin(changed);
    rig.settle(Milliseconds(5000));
    double longest = 0;
    auto last = changed;
    for (const auto& record : cockpit.records)
        if (record.kind() == "picture" && record.at > changed)
            longest = std::max(longest, static_cast<double>(record.at - std::exchange(last, record.at)) / 1e6);
    longest = std::max(longest, static_cast<double>(nowNs() - last) / 1e6);
    scene.note("largest gap of pictures " + milliseconds(longest));
    if (longest > longestAllowed)
        scene.fails("pictures stood still for " + milliseconds(longest) + " when the way became longer");
    rig.say("xray", "pictures 0 66");
    rig.settle(Milliseconds(200));
    (void)rig.wire("port 1 rate=0");
    scene.heal();
    scene.recover();
    scene.must({"unnoticed", "suspect"});
}

void growingDelay(Scene& scene)
{
    scene.engage();
    scene.disturb("link *>* ramp=200 ramp-end=500", Milliseconds(3000));
    scene.recover();
    if (!scene.outcome().stops)
        scene.fails("the drives went on although commands were older than 50 ms");
}

} // namespace

std::vector<Fault> qualityFaults()
{
    const std::string loss5 = "drop=0.05";
    return {
        {"udp-lost", "-", "datagrams are lost for 1.2 s and more, TCP is not: back to lane 0", Cast::Pair, withoutUdp},
        {"tcp-lost", "-", "TCP is lost for 1.5 s, datagrams are not: lane 0 is dead", Cast::Pair, withoutTcp},
        {"loss-5", "F12", "5 % of all frames lost, no delay, 8 s", Cast::Pair, quality(loss5), 2},
        {"loss-5-rtt20", "F12", "… with 10 ms each way", Cast::Pair, quality(loss5 + " delay=10"), 2},
        {"loss-5-rtt40", "F12", "… with 20 ms each way and up to 20 ms more", Cast::Pair, quality(loss5 + " delay=20 jitter=20"), 2},
        {"bursts-3", "F13", "bursts of 3 lost frames in the mean, 1 % of frames begin one, 8 s", Cast::Pair,
         quality("burst-start=0.01 burst-end=0.333"), 2},
        {"bursts-10", "F13", "… of 10 frames", Cast::Pair, quality("burst-start=0.01 burst-end=0.1"), 2},
        {"disorder", "F14", "10 % reordered by 3 ms, 10 % doubled, 2 % with a turned bit, 8 s", Cast::Pair,
         quality("reorder=0.1 reorder-by=3 duplicate=0.1 corrupt=0.02"), 2},
        {"growing-delay", "F16", "the delay each way grows by 200 ms a second to 500 ms", Cast::Pair, growingDelay},
        {"longer-way", "-", "the way becomes 8 ms long instead of 2, each way, while pictures of 300 kB flow at 15/s on 100 Mbit/s",
         Cast::WithPictures, longerWay, 2},
        {"narrow-2000k", "F15", "the cockpit's way in falls to 2 Mbit/s while pictures of 30 kB flow at 15/s", Cast::WithPictures,
         collapse(2'000'000, 64'000, 30'000), 2},
        {"narrow-256k", "F15", "… to 256 kbit/s", Cast::WithPictures, collapse(256'000, 64'000, 30'000), 2},
        {"ladder", "F15", "… from 100 to 10 Mbit/s and back while the X-ray system sends 512 KiB at 15/s, with its ladder",
         Cast::WithPictures, ladder, 2},
    };
}

} // namespace liena::lab
