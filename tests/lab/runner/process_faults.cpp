// Faults of the programs themselves: killed, frozen, starved, two at once, an id twice.
#include "runner/faults.hpp"

#include <unistd.h>

#include <algorithm>
#include <csignal>

namespace liena::lab {

namespace {

void killRobot(Scene& scene)
{
    scene.engage();
    scene.begin(scene.rig().signal("robot", SIGKILL));
    scene.rig().settle(Milliseconds(200));
    scene.rig().start("robot");
    scene.rig().settle(Milliseconds(500));
    scene.recover();
    scene.must({"stand-by"});
}

void killCockpit(Scene& scene)
{
    scene.engage();
    scene.begin(scene.rig().signal("cockpit", SIGKILL));
    scene.rig().settle(Milliseconds(200));
    scene.rig().start("cockpit");
    // A cockpit that was started anew knows nothing; its person opens, is told of the stand-by, and re-opens.
    scene.await([&] { return scene.robot().stateOf("cockpit") == "stand-by" || scene.robot().stateOf("cockpit") == "closed"; },
                Milliseconds(3000), "the robot did not notice that the cockpit died");
    scene.recover();
}

std::function<void(Scene&)> freeze(const std::string& device, int least, int most)
{
    return [=](Scene& scene) {
        scene.engage();
        scene.begin(scene.rig().signal(device, SIGSTOP));
        scene.rig().settle(Milliseconds(scene.draw(least, most)));
        (void)scene.rig().signal(device, SIGCONT);
        scene.recover();
        // The frozen one notices its own gap when it goes on; that is no detection of a peer.
        (device == "robot" ? scene.outcome().robotDetects : scene.outcome().cockpitDetects).reset();
        if (device == "robot")
            scene.outcome().stops.reset(); // its drives are in the frozen process
    };
}

/// The processor of the robot is busy with something more urgent.
void starve(Scene& scene)
{
    constexpr int processor = 0;
    constexpr int moreUrgent = 10;
    const auto id = std::to_string(scene.robot().process->id());
    const auto last = std::to_string(std::max(1L, ::sysconf(_SC_NPROCESSORS_ONLN)) - 1);
    scene.engage();
    (void)runToEnd({"taskset", "-apc", std::to_string(processor), id}, std::nullopt);
    ProcessPlan plan;
    plan.command = {"/proc/self/exe", "--spin", "250"};
    plan.processor = processor;
    plan.urgency = moreUrgent;
    scene.begin(nowNs());
    Process hog(plan);
    scene.rig().settle(Milliseconds(800));
    (void)runToEnd({"taskset", "-apc", "0-" + last, id}, std::nullopt);
    scene.recover();
    scene.outcome().robotDetects.reset(); // its own standing still
    scene.outcome().stops.reset();
}

/// Both persons press `open` at once: one session, and it works.
void openBoth(Scene& scene)
{
    scene.engage();
    scene.rig().say("cockpit", "close robot");
    scene.await([&] { return scene.cockpit().stateOf("robot") == "closed" && scene.robot().stateOf("cockpit") == "closed"; },
                Milliseconds(3000), "the session did not close");
    scene.rig().settle(Milliseconds(scene.draw(150, 300)));
    const auto pressed = nowNs();
    scene.rig().say("cockpit", "open robot");
    scene.rig().settle(Milliseconds(scene.draw(0, 4)));
    scene.rig().say("robot", "open cockpit");
    const bool opened =
        scene.rig().until([&] { return scene.cockpit().isOpenTo("robot") && scene.robot().isOpenTo("cockpit"); }, Milliseconds(4000));
    if (!opened)
        scene.fails("no session after both ends had opened");
    scene.outcome().reopens = static_cast<double>(nowNs() - pressed) / 1e6;
    scene.rig().settle(Milliseconds(400));
    if (!scene.cockpit().isOpenTo("robot"))
        scene.fails("the session did not last");
    scene.engage();
}

/// A second process with the cockpit's identity, elsewhere on the network: its host has the cockpit's address on its own loopback.
void idTwice(Scene& scene)
{
    auto& rig = scene.rig();
    const auto quit = [&] {
        rig.say("xray", "quit");
        scene.await([&] { return rig["xray"].ended; }, Milliseconds(4000), "the process at the third port did not end");
    };
    const std::string address = Networks::addressOf(scene.cockpit().port) + "/32";
    scene.engage();
    quit();
    rig.networks().run(rig["xray"].port, {"ip", "addr", "add", address, "dev", "lo"});
    Rig::Start second;
    second.actsAs = "cockpit";
    rig.start("xray", second);
    scene.begin(nowNs());
    rig.say("xray", "open robot");
    rig.settle(Milliseconds(1500));
    if (rig["xray"].isOpenTo("robot"))
        scene.fails("a second device with one id opened a session");
    scene.read();
    scene.must({"unnoticed", "suspect"});
    quit();
    rig.networks().run(rig["xray"].port, {"ip", "addr", "del", address, "dev", "lo"});
    rig.start("xray");
    scene.engage();
}

} // namespace

std::vector<Fault> processFaults()
{
    return {
        {"kill-robot", "F5", "the robot's process is killed and started anew", Cast::Pair, killRobot},
        {"kill-cockpit", "F5", "the cockpit's process is killed and started anew", Cast::Pair, killCockpit},
        {"freeze-robot", "F6", "the robot's process is stopped for 150-400 ms", Cast::Pair, freeze("robot", 150, 400)},
        {"freeze-cockpit", "F6", "the cockpit's process is stopped for 150-400 ms", Cast::Pair, freeze("cockpit", 150, 400)},
        {"freeze-long", "F6", "the robot's process is stopped for 1.0-1.5 s", Cast::Pair, freeze("robot", 1000, 1500)},
        {"starve", "F24", "a more urgent program takes the robot's processor for 250 ms", Cast::Pair, starve},
        {"both-open", "F27", "both persons open within 4 ms", Cast::Pair, openBoth},
        {"id-twice", "F29", "a second process with the cockpit's certificate opens to the robot", Cast::WithPictures, idTwice},
    };
}

} // namespace liena::lab
