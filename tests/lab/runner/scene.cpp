// One repetition of a fault: implementation.
#include "runner/scene.hpp"

#include <algorithm>

namespace liena::lab {

namespace {

constexpr Milliseconds openLimit{4'000};
constexpr Milliseconds healthyBeforeConfirming{500};
constexpr Milliseconds armLimit{1'500};
constexpr int patience = 12;

double millisecondsSince(std::int64_t from, std::int64_t to) { return static_cast<double>(to - from) / 1e6; }

bool isLoss(const std::string& state) { return state == "interrupted" || state == "stand-by" || state == "closed"; }

} // namespace

int Scene::draw(int least, int most) { return least + static_cast<int>(m_random() % static_cast<std::uint64_t>(most - least + 1)); }

void Scene::restart(const std::string& device, RigDevice& witness, const Rig::Start& how)
{
    m_rig.say(device, "quit");
    await([&] { return m_rig[device].ended && witness.stateOf(device) == "closed"; }, Milliseconds(4000), device + " did not end in order");
    m_rig.start(device, how);
}

void Scene::await(const std::function<bool()>& condition, Milliseconds limit, const std::string& what)
{
    if (!m_rig.until(condition, limit))
        throw Stuck{what};
}

// Both ends are where they stay until somebody acts.
bool Scene::settled(const std::string& peer)
{
    const auto rests = [](const std::string& state) { return state == "open" || state == "stand-by" || state == "closed"; };
    return rests(cockpit().stateOf(peer)) && rests(m_rig[peer].stateOf("cockpit")) &&
           (cockpit().stateOf(peer) == "open") == (m_rig[peer].stateOf("cockpit") == "open");
}

void Scene::reopen(const std::string& peer)
{
    const auto pressed = nowNs();
    RigDevice& other = m_rig[peer];
    for (int press = 0; press < patience; ++press) {
        const auto& state = cockpit().stateOf(peer);
        if (state == "stand-by" || state == "closed")
            m_rig.say("cockpit", (state == "stand-by" ? "reopen " : "open ") + peer);
        const auto from = nowNs();
        const auto failed = [&](const Record& record) { return record.kind() == "event" && record.word(1) == "open-failed"; };
        const auto open = [&] { return cockpit().stateOf(peer) == "open" && other.stateOf("cockpit") == "open"; };
        (void)m_rig.until([&] { return open() || cockpit().first(from, failed) != nullptr; }, openLimit);
        if (open()) {
            if (press > 0)
                note("pressed " + std::to_string(press + 1) + " times");
            break;
        }
        m_rig.settle(Milliseconds(300));
    }
    const auto isOpen = [](const RigDevice& device, const std::string& to) {
        return [&device, to](const Record& record) {
            return record.kind() == "state" && record.word(1) == to && record.word(3) == "open" && device.stateOf(to) == "open";
        };
    };
    const auto* here = cockpit().first(pressed, isOpen(cockpit(), peer));
    const auto* there = other.first(pressed, isOpen(other, "cockpit"));
    if (here == nullptr || there == nullptr)
        throw Stuck{"the session of cockpit and " + peer + " did not open again: cockpit " + cockpit().stateOf(peer) + ", " + peer + " " +
                    other.stateOf("cockpit")};
    if (peer == "robot" && m_begin)
        m_outcome.reopens = millisecondsSince(pressed, std::max(here->at, there->at));
}

void Scene::open(With with)
{
    for (const auto& link : m_rig.plan().links) {
        const auto peer = link.substr(link.find(' ') + 1);
        if (!link.starts_with("cockpit ") || (with == With::Robot && peer != "robot") ||
            (cockpit().isOpenTo(peer) && m_rig[peer].isOpenTo("cockpit")))
            continue;
        await([&] { return settled(peer); }, openLimit,
              "the ends of cockpit-" + peer + " did not settle: " + cockpit().stateOf(peer) + ", " + m_rig[peer].stateOf("cockpit"));
        if (cockpit().stateOf(peer) != "open")
            reopen(peer);
    }
}

void Scene::engage(With with)
{
    for (int attempt = 0; attempt < patience; ++attempt) {
        open(with);
        if (robot().moving && robot().robotState == "Engaged")
            break;
        if (!m_rig.until([&] { return cockpit().heard["robot"] == "Ready" && robot().robotState == "Ready"; }, armLimit))
            continue;
        m_rig.say("cockpit", "arm robot");
        if (m_rig.until([&] { return robot().moving && robot().robotState == "Engaged"; }, armLimit))
            break;
    }
    if (!robot().moving)
        throw Stuck{"the robot did not move again; it says " + robot().robotState + ", the cockpit heard " + cockpit().heard["robot"]};
    m_rig.settle(Milliseconds(draw(150, 250)));
}

void Scene::begin(std::int64_t at)
{
    m_begin = at;
    m_outcome.began = at;
    m_moved = robot().moving;
}

void Scene::disturb(const std::string& order, Milliseconds time)
{
    beginByWire(order);
    m_rig.settle(time);
    heal();
}

std::optional<double> Scene::detection(const RigDevice& device, const std::string& peer) const
{
    const auto* lost = device.first(m_begin.value(), [&](const Record& record) {
        return record.kind() == "state" && record.word(1) == peer && isLoss(record.word(3));
    });
    return lost == nullptr ? std::nullopt : std::optional(millisecondsSince(*m_begin, lost->at));
}

void Scene::read()
{
    m_outcome.cockpitDetects = detection(cockpit(), "robot");
    m_outcome.robotDetects = detection(robot(), "cockpit");
    const auto* still = robot().first(m_begin.value(), [](const Record& record) { return record.kind() == "still"; });
    if (m_moved && still != nullptr)
        m_outcome.stops = millisecondsSince(*m_begin, still->at);
    const auto wentTo = [&](const std::string& state) {
        const auto went = [&](const RigDevice& device, const std::string& peer) {
            return device.first(*m_begin, [&](const Record& record) {
                return record.kind() == "state" && record.word(1) == peer && record.word(3) == state;
            }) != nullptr;
        };
        return went(cockpit(), "robot") || went(robot(), "cockpit");
    };
    m_outcome.seen = wentTo("stand-by") ? "stand-by" : wentTo("interrupted") ? "interrupted" : wentTo("suspect") ? "suspect" : "unnoticed";
    const auto* lost = cockpit().first(*m_begin, [](const Record& record) { return record.kind() == "event" && record.word(1) == "lost"; });
    if (lost != nullptr)
        note(lost->word(4));
}

void Scene::recover()
{
    await([&] { return settled("robot"); }, openLimit,
          "the ends did not settle: cockpit " + cockpit().stateOf("robot") + ", robot " + robot().stateOf("cockpit"));
    const bool needsPerson = !cockpit().isOpenTo("robot");
    m_rig.settle(healthyBeforeConfirming);
    if (needsPerson && (cockpit().isOpenTo("robot") || robot().moving))
        fails("open or moving again without a person");
    read();
    engage();
}

void Scene::must(const std::vector<std::string>& seen)
{
    if (std::find(seen.begin(), seen.end(), m_outcome.seen) != seen.end())
        return;
    std::string wanted;
    for (const auto& word : seen)
        wanted += (wanted.empty() ? "" : " or ") + word;
    fails("saw " + m_outcome.seen + " instead of " + wanted);
}

void Scene::mustFind(const std::string& finding)
{
    const auto* diagnosed = cockpit().first(m_begin.value(), [](const Record& record) {
        return record.kind() == "event" && record.word(1) == "diagnosed" && record.word(2) == "robot";
    });
    const auto found = diagnosed == nullptr ? "nothing" : diagnosed->word(9);
    if (found != finding)
        fails("the cockpit's probe found " + found + " instead of " + finding);
}

double Scene::largestGap(std::int64_t from)
{
    std::int64_t last = 0;
    std::int64_t largest = 0;
    for (const auto& record : robot().records)
        if (record.kind() == "applied" && record.at >= from) {
            largest = last == 0 ? 0 : std::max(largest, record.at - last);
            last = record.at;
        }
    return static_cast<double>(largest) / 1e6;
}

} // namespace liena::lab
