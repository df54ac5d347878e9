// Faults of the way between two devices: cut, unplugged, flapping, one direction only.
#include "runner/faults.hpp"

#include <csignal>

namespace liena::lab {

namespace {

constexpr Milliseconds longCut{900};
constexpr Milliseconds longerThanAProbe{2000}; // which begins with the stand-by and waits for a second

std::string cable(std::size_t port, bool in) { return "carrier " + std::to_string(port + 1) + (in ? " on" : " off"); }

void cut(Scene& scene)
{
    scene.engage();
    scene.disturb("link *>* cut", longCut);
    scene.recover();
    scene.must({"stand-by"});
}

void unplugRobot(Scene& scene)
{
    scene.engage();
    scene.beginByWire(cable(scene.robot().port, false));
    scene.rig().settle(longCut);
    (void)scene.rig().wire(cable(scene.robot().port, true));
    scene.recover();
    scene.must({"stand-by"});
}

void interfaceDown(Scene& scene)
{
    auto& networks = scene.rig().networks();
    const auto port = scene.cockpit().port;
    scene.engage();
    const auto before = nowNs();
    networks.run(port, {"ip", "link", "set", "eth0", "down"});
    scene.begin(before);
    scene.rig().settle(longCut);
    networks.run(port, {"ip", "link", "set", "eth0", "up"});
    networks.setRoute(port);
    scene.recover();
    scene.must({"stand-by"});
    scene.mustFind("interface-down");
}

/// Its interface is up and has its address and its route: only the carrier is gone, as with a cable out at this side.
void unplugCockpit(Scene& scene)
{
    const auto port = scene.cockpit().port;
    scene.engage();
    scene.beginByWire(cable(port, false));
    scene.rig().settle(longerThanAProbe);
    (void)scene.rig().wire(cable(port, true));
    scene.recover();
    scene.must({"stand-by"});
    scene.mustFind("interface-down");
}

/// The robot's cable out of the switch, so that its computer keeps its carrier: Linux may take a second to believe in a new one.
std::function<void(Scene&)> replugAfter(Milliseconds time, std::vector<std::string> allowed)
{
    return [time, allowed](Scene& scene) {
        scene.engage();
        scene.disturb("link *>* cut", time);
        scene.recover();
        scene.must(allowed);
    };
}

void flap(Scene& scene)
{
    constexpr int flaps = 12;
    scene.engage();
    scene.begin(nowNs());
    for (int i = 0; i < flaps; ++i) {
        (void)scene.rig().wire("link *>* cut");
        scene.rig().settle(Milliseconds(scene.draw(20, 300)));
        scene.heal();
        scene.rig().settle(Milliseconds(scene.draw(20, 200)));
    }
    scene.recover();
}

std::function<void(Scene&)> oneWay(const std::string& direction)
{
    return [direction](Scene& scene) {
        scene.engage();
        scene.disturb("link " + direction + " cut", longCut);
        scene.recover();
        scene.must({"stand-by"});
    };
}

/// The robot's computer goes down without a word and comes back, while the cockpit believes in its old connections.
void halfOpen(Scene& scene)
{
    scene.engage();
    scene.beginByWire("link *>* cut");
    (void)scene.rig().signal("robot", SIGKILL);
    scene.rig().settle(Milliseconds(300));
    scene.rig().start("robot");
    scene.heal();
    scene.recover();
    scene.must({"stand-by"});
}

void mtuHole(Scene& scene)
{
    scene.engage();
    scene.rig().say("xray", "pictures 200000 100");
    const auto first = scene.cockpit().pictures;
    scene.await([&] { return scene.cockpit().pictures > first; }, Milliseconds(3000), "no picture arrived before the fault");
    scene.beginByWire("link *>* largest=600");
    scene.rig().settle(Milliseconds(1500));
    const auto during = scene.cockpit().pictures;
    scene.heal();
    scene.read();
    scene.must({"unnoticed", "suspect"});
    scene.rig().say("xray", "pictures 200000 100");
    scene.await([&] { return scene.cockpit().pictures > during + 2; }, Milliseconds(8000), "no picture arrived after the fault");
    scene.rig().say("xray", "pictures 0 100");
    scene.recover();
}

} // namespace

std::vector<Fault> linkFaults()
{
    return {
        {"cut", "F1", "everything between the devices is lost for 900 ms", Cast::Pair, cut},
        {"unplug", "F2", "the robot's cable is out for 900 ms (carrier gone)", Cast::Pair, unplugRobot},
        {"unplug-cockpit", "F2", "the cockpit's own cable is out for 2 s", Cast::Pair, unplugCockpit},
        {"interface-down", "F2", "the cockpit's interface is set down for 900 ms", Cast::Pair, interfaceDown},
        {"replug-50", "F3", "the robot's cable is out of the switch for 50 ms", Cast::Pair,
         replugAfter(Milliseconds(50), {"unnoticed", "suspect"})},
        {"replug-90", "F3", "… for 90 ms", Cast::Pair, replugAfter(Milliseconds(90), {"unnoticed", "suspect", "interrupted"})},
        {"replug-300", "F3", "… for 300 ms", Cast::Pair, replugAfter(Milliseconds(300), {"interrupted"})},
        {"replug-2000", "F3", "… for 2 s", Cast::Pair, replugAfter(Milliseconds(2000), {"stand-by"})},
        {"flap", "F4", "12 cuts of 20-300 ms with 20-200 ms between them", Cast::Pair, flap},
        {"half-open", "F10", "the robot is killed and started anew behind a cut, so that no FIN or RST arrives", Cast::Pair, halfOpen},
        {"deaf-robot", "F11", "nothing reaches the robot for 900 ms; the other way works", Cast::Pair, oneWay("1>2")},
        {"deaf-cockpit", "F11", "nothing reaches the cockpit for 900 ms; the other way works", Cast::Pair, oneWay("2>1")},
        {"mtu-hole", "F17", "frames over 600 bytes vanish for 1.5 s while pictures flow", Cast::WithPictures, mtuHole},
    };
}

} // namespace liena::lab
