// Faults of what a program gets from its computer: sockets, clocks, disks, descriptors, memory for what is read slowly.
#include "runner/faults.hpp"

#include "runner/process_facts.hpp"

#include <cstdio>

namespace liena::lab {

namespace {

/// The kernel gives up the cockpit's connections, as after a forged or a firewall's RST.
void resetSockets(Scene& scene)
{
    scene.engage();
    const auto before = nowNs();
    scene.rig().networks().run(scene.cockpit().port, {"ss", "-K", "state", "established"});
    scene.begin(before);
    scene.rig().settle(Milliseconds(900));
    scene.recover();
    scene.must({"interrupted"});
}

std::function<void(Scene&)> clockStep(const std::string& device, long milliseconds)
{
    return [=](Scene& scene) {
        scene.engage();
        scene.begin(nowNs());
        scene.rig().say(device, "clock " + std::to_string(milliseconds));
        scene.rig().settle(Milliseconds(2500));
        scene.read();
        scene.must({"unnoticed", "suspect"});
        scene.rig().say(device, "clock " + std::to_string(-milliseconds));
        scene.rig().settle(Milliseconds(2500));
        scene.recover();
    };
}

void restartCockpit(Scene& scene, const Rig::Start& how) { scene.restart("cockpit", scene.robot(), how); }

/// The cockpit must learn the X-ray system's message set, and its disk is full; the robot's set it has.
void fullDisk(Scene& scene)
{
    auto& rig = scene.rig();
    Rig::Start small;
    small.smallDisk = true;
    small.registry = rig.files().registryWithout({"cbct-xray"});
    restartCockpit(scene, small);
    const auto store = diskOf(scene.cockpit().process->id(), rig.files().storeOf("cockpit"));
    fillDisk(store);
    scene.engage(With::Robot);
    scene.begin(nowNs());
    rig.say("cockpit", "open xray");
    const auto failed = [](const Record& record) {
        return record.kind() == "event" && record.word(1) == "open-failed" && record.word(2) == "xray";
    };
    (void)rig.until([&] { return scene.cockpit().isOpenTo("xray") || scene.cockpit().first(0, failed) != nullptr; }, Milliseconds(4000));
    scene.note(scene.cockpit().isOpenTo("xray") ? "opened without storing" : "refused to open");
    if (const auto names = incompleteFiles(store); !names.empty())
        scene.fails("a half-written file is left in the store: " + names);
    rig.settle(Milliseconds(300));
    scene.read();
    scene.must({"unnoticed"});
    emptyDisk(store);
    if (!scene.cockpit().isOpenTo("xray"))
        scene.reopen("xray");
    restartCockpit(scene, Rig::Start());
    scene.engage();
}

/// No descriptor is left when the connections break.
void outOfDescriptors(Scene& scene)
{
    scene.engage();
    const auto id = scene.robot().process->id();
    limitDescriptors(id, 3); // what is open stays open, nothing more may be
    scene.rig().settle(Milliseconds(500));
    if (!scene.robot().moving)
        scene.fails("the limit alone stopped an open session");
    const auto from = nowNs();
    scene.begin(from);
    scene.rig().networks().run(scene.cockpit().port, {"ss", "-K", "state", "established"});
    const double busyBefore = processorSeconds(id);
    scene.rig().settle(Milliseconds(1500));
    const double busy = (processorSeconds(id) - busyBefore) / (static_cast<double>(nowNs() - from) / 1e9);
    char text[48];
    std::snprintf(text, sizeof text, "robot busy %.0f %%", busy * 100);
    scene.note(text);
    limitDescriptors(id, 1024);
    scene.recover();
    scene.must({"stand-by"});
}

std::function<void(Scene&)> smallBuffers()
{
    return [](Scene& scene) {
        const std::string tiny = "4096 4096 4096";
        const std::string usual = "4096 16384 4194304";
        for (std::size_t port = 0; port < 3; ++port)
            scene.rig().networks().writeSetting(port, "ipv4/tcp_wmem", tiny);
        scene.engage();
        scene.rig().networks().run(0, {"ss", "-K", "state", "established"}); // the sizes are those of new connections
        scene.rig().settle(Milliseconds(1000));
        scene.engage();
        scene.begin(nowNs());
        scene.rig().say("xray", "pictures 300000 100");
        const auto first = scene.cockpit().pictures;
        scene.rig().settle(Milliseconds(3000));
        scene.note(std::to_string((scene.cockpit().pictures - first) / 3) + " pictures/s");
        if (scene.cockpit().pictures == first)
            scene.fails("no picture passed the small buffers");
        scene.rig().say("xray", "pictures 0 100");
        for (std::size_t port = 0; port < 3; ++port)
            scene.rig().networks().writeSetting(port, "ipv4/tcp_wmem", usual);
        scene.read();
        scene.rig().networks().run(0, {"ss", "-K", "state", "established"});
        scene.rig().settle(Milliseconds(1000));
        scene.engage();
    };
}

/// A cockpit whose application takes nothing out of its cache.
void slowConsumer(Scene& scene)
{
    auto& rig = scene.rig();
    Rig::Start hoards;
    hoards.flags = {"--hoard-pictures"};
    restartCockpit(scene, hoards);
    scene.engage();
    const auto from = nowNs();
    scene.begin(from);
    rig.say("xray", "pictures 500000 33");
    rig.settle(Milliseconds(1000));
    const auto early = residentKiB(scene.cockpit().process->id());
    rig.settle(Milliseconds(3000));
    const auto late = residentKiB(scene.cockpit().process->id());
    rig.say("xray", "pictures 0 33");
    char text[80];
    std::snprintf(text, sizeof text, "grew %+lld KiB in 3 s, largest gap of commands %.0f ms",
                  static_cast<long long>(late) - static_cast<long long>(early), scene.largestGap(from));
    scene.note(text);
    if (late > early + 32 * 1024)
        scene.fails("pictures that nobody takes pile up");
    scene.read();
    restartCockpit(scene, Rig::Start());
    scene.engage();
}

} // namespace

std::vector<Fault> resourceFaults()
{
    constexpr long hour = 3'600'000;
    return {
        {"reset", "F18", "the kernel aborts all connections of the cockpit (ss -K)", Cast::Pair, resetSockets},
        {"clock-forward", "F19", "the cockpit's wall clock steps an hour forward, and back after 2.5 s", Cast::Pair,
         clockStep("cockpit", hour), 2},
        {"clock-back", "F19", "the robot's wall clock steps an hour back, and forward after 2.5 s", Cast::Pair, clockStep("robot", -hour),
         2},
        {"disk-full", "F20", "the cockpit's disk is full when it must learn a message set", Cast::WithPictures, fullDisk, 2},
        {"descriptors", "F21", "the robot has no descriptor left when its connections break", Cast::Pair, outOfDescriptors, 2},
        {"small-buffers", "F22", "send buffers of 4 KiB while pictures of 300 kB flow: most writes are partial", Cast::WithPictures,
         smallBuffers(), 2},
        {"slow-consumer", "F23", "the cockpit's application takes no picture out of its cache, 30 of 500 kB a second", Cast::WithPictures,
         slowConsumer, 2},
    };
}

} // namespace liena::lab
