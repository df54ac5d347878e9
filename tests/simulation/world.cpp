// Setting a world up, running it, and judging how it ends.
#include "world.hpp"

#include "applications.hpp"
#include "message_sets.hpp"

#include <algorithm>

namespace liena::simulation {

using namespace std::chrono_literals;

namespace {

constexpr Nanoseconds glance = 5ms;
constexpr Nanoseconds steadyFor = 600ms; // a lane 0 that the chaos left with a gap is repaired by then, or judged silent

} // namespace

World::World(const Scenario& scenario, Onlooker onlooker)
    : m_scenario(scenario),
      m_onlooker(std::move(onlooker)),
      m_tokens(scenario.seed, "tokens"),
      m_faultRandom(scenario.seed, "fault details"),
      m_workload(scenario.seed, "workload"),
      m_lieRandom(scenario.seed, "lies"),
      m_network(m_time, *this, SeededRandom(scenario.seed, "network"), scenario.devices.size()),
      m_hosts(scenario.devices.size()),
      m_model(rules()),
      m_began(m_time.now())
{
    setUp();
}

World::~World()
{
    for (auto& host : m_hosts)
        host.waiting.clear();
}

Rules World::rules() const
{
    Rules rules;
    rules.links.insert(m_scenario.links.begin(), m_scenario.links.end());
    for (HostIndex host = 0; host < m_scenario.devices.size(); ++host) {
        rules.ids[host] = m_scenario.devices[host].id.value();
        for (const auto& definition : messageSetOf(m_scenario.devices[host].kind)->messages())
            rules.largest[{host, definition.number}] = definition.maximumSize();
    }
    return rules;
}

void World::setUp()
{
    m_network.setSendBuffer(m_scenario.sendBuffer);
    for (HostIndex a = 0; a < m_hosts.size(); ++a)
        for (HostIndex b = 0; b < m_hosts.size(); ++b) {
            auto& path = m_network.path(a, b);
            path.delay = m_scenario.delay;
            path.jitter = m_scenario.jitter;
            path.loss = m_scenario.loss;
        }
    std::vector<DeviceId> ids;
    for (const auto& plan : m_scenario.devices)
        ids.push_back(plan.id);
    m_liar = std::make_unique<Liar>(ids);
    if (m_scenario.liar)
        observe(Lies{*m_scenario.liar});
    for (HostIndex host = 0; host < m_hosts.size(); ++host) {
        const auto& plan = m_scenario.devices[host];
        m_hosts[host].clock = DeviceClock(plan.drift, plan.wall);
        m_hosts[host].person = std::make_unique<Person>(plan, m_workload.fork());
        if (plan.knowsSets)
            for (const auto& other : m_scenario.devices)
                m_hosts[host].disk.sets.insert(messageSetOf(other.kind)->hash());
        boot(host);
    }
}

DeviceSettings World::settingsFor(HostIndex host) const
{
    DeviceSettings settings;
    settings.host = host;
    settings.id = m_scenario.devices[host].id;
    settings.set = messageSetOf(m_scenario.devices[host].kind);
    for (HostIndex other = 0; other < m_scenario.devices.size(); ++other)
        if (m_scenario.linked(host, other))
            settings.neighbours.push_back({other, LinkTiming()});
    settings.datagrams = m_scenario.datagrams;
    settings.mutant = m_scenario.mutant;
    return settings;
}

void World::whenRunning(HostIndex host, VirtualTime::Event event)
{
    auto& target = m_hosts[host];
    if (!target.device)
        return;
    if (target.pauses > 0)
        target.waiting.push_back(std::move(event));
    else
        event();
}

Reception World::reception(HostIndex host) const
{
    const auto& target = m_hosts[host];
    if (target.downs > 0)
        return Reception::Silent;
    return target.device && target.refusals == 0 ? Reception::Listens : Reception::Refuses;
}

void World::accepted(HostIndex host, HostIndex from, ConnectionNumber connection) { m_hosts[host].device->accepted(from, connection); }

void World::datagramArrived(HostIndex host, HostIndex from, std::span<const std::byte> bytes)
{
    m_hosts[host].device->datagramArrived(from, bytes);
}

HostIndex World::hostOf(DeviceId id) const
{
    for (HostIndex host = 0; host < m_scenario.devices.size(); ++host)
        if (m_scenario.devices[host].id == id)
            return host;
    return 0xFF;
}

std::shared_ptr<const MessageSet> World::setOf(HostIndex host) const { return messageSetOf(m_scenario.devices[host].kind); }

void World::observe(const Observation& observation)
{
    m_hash.add(m_time.now(), observation);
    m_model.note(m_time.now(), observation);
    measure(observation);
    if (m_onlooker)
        m_onlooker(m_time.now(), observation);
}

void World::measure(const Observation& observation)
{
    if (const auto* entered = std::get_if<Entered>(&observation)) {
        m_course.add(m_time.now(), observation);
        m_outcome.coverage.transition(entered->from, entered->to);
        if (carriesMessages(entered->from) && entered->to == SessionState::Reconnecting) {
            ++m_outcome.interruptions;
            if (m_time.now() - m_hosts[entered->device].resumed > 1ms) // whoever was frozen itself could not notice
                m_outcome.longestDetection = std::max(m_outcome.longestDetection, entered->silence);
        }
    } else if (const auto* lost = std::get_if<Lost>(&observation)) {
        ++m_outcome.standBys;
        m_outcome.falseStandBys += m_whole ? 1 : 0;
        m_firstStandBy.try_emplace(lost->incident, m_time.now());
    } else if (const auto* opened = std::get_if<Opened>(&observation); opened != nullptr && !opened->healed) {
        // TLS keeps what a session said out of the next one, which may begin at either end.
        m_channels.erase({opened->peer, opened->device});
        m_channels.erase({opened->device, opened->peer});
    } else if (const auto* requested = std::get_if<Requested>(&observation)) {
        m_oldTokens.push_back(requested->token);
    } else if (const auto* raised = std::get_if<Raised>(&observation)) {
        const auto first = m_firstStandBy.find(raised->incident);
        if (m_scenario.everybodyKnows && first != m_firstStandBy.end() && m_time.now() < m_began + m_scenario.chaos)
            m_outcome.longestKnowing = std::max(m_outcome.longestKnowing, Nanoseconds(m_time.now() - first->second));
    } else if (const auto* composed = std::get_if<Composed>(&observation)) {
        m_outcome.commandsSent += composed->control ? 1 : 0;
    } else if (const auto* delivered = std::get_if<Delivered>(&observation)) {
        m_outcome.commandsJudged += delivered->control ? 1 : 0;
    } else if (const auto* dropped = std::get_if<Dropped>(&observation)) {
        m_outcome.commandsJudged += dropped->name.number >= 0x0100 && dropped->name.number <= 0x01FF ? 1 : 0;
    }
}

Outcome World::run()
{
    for (const auto& fault : m_scenario.faults)
        m_time.at(m_began + fault.at, [this, &fault] {
            if (!m_peace)
                apply(fault);
        });
    const auto chaosEnds = m_began + m_scenario.chaos;
    while (m_time.step(chaosEnds - 1ns)) {
    }
    if (m_scenario.everybodyKnows)
        judgeKnowing(); // before the faults that last as long as the chaos end with it
    while (m_time.step(chaosEnds)) {
    }
    heal();
    // Whole, and so for longer than the slowest repair of a stream that the chaos left with a gap.
    Nanoseconds wholeFor{};
    for (auto look = chaosEnds + glance; look <= chaosEnds + healLimit + steadyFor && wholeFor < steadyFor; look += glance) {
        while (m_time.step(look)) {
        }
        m_whole = isWhole();
        wholeFor = m_whole ? wholeFor + glance : 0ns;
        if (wholeFor == 0ns)
            m_outcome.longestHeal = look - chaosEnds;
    }
    settle();
    return outcome();
}

Outcome World::runQuiet(Nanoseconds length)
{
    heal();
    const auto end = m_began + length;
    while (m_time.step(m_began + healLimit)) {
    }
    m_whole = isWhole();
    if (!m_whole)
        m_outcome.violations.push_back({"G19", m_time.now(), "a pair that nothing disturbs is not open"});
    while (m_time.step(end)) {
    }
    return outcome();
}

/// Word of an incident reaches every device that runs, over links that work.
void World::judgeKnowing()
{
    for (HostIndex origin = 0; origin < m_hosts.size(); ++origin) {
        if (!isAlive(origin))
            continue;
        std::set<HostIndex> reached{origin};
        for (std::size_t before = 0; before != reached.size();) {
            before = reached.size();
            for (const auto& [a, b] : m_scenario.links)
                if (isAlive(a) && isAlive(b) && !m_network.isCut(a, b) && (reached.contains(a) || reached.contains(b)))
                    reached.insert({a, b});
        }
        for (const auto& incident : m_hosts[origin].device->ledger().incidents())
            for (const auto host : reached)
                if (m_hosts[host].device->ledger().find(incident.id) == nullptr)
                    m_outcome.violations.push_back({"G5", m_time.now(), "a device does not know of a stand-by that it could know of"});
    }
}

bool World::isWhole()
{
    for (const auto& [a, b] : m_scenario.links) {
        const auto& one = m_hosts[a].device->module(b)->machine();
        const auto& other = m_hosts[b].device->module(a)->machine();
        if (!carriesMessages(one.state()) || !carriesMessages(other.state()) || one.token() != other.token())
            return false;
    }
    return std::all_of(m_hosts.begin(), m_hosts.end(), [](const Host& host) { return !host.device->standsBy(); });
}

void World::settle()
{
    for (HostIndex host = 0; host < m_hosts.size(); ++host)
        for (auto& [peer, module] : m_hosts[host].device->modules()) {
            const auto& machine = module->machine();
            observe(Settled{host, peer, machine.state(), machine.token(), machine.guard().epoch(), machine.stamper().targetEpoch(),
                            m_hosts[host].device->ledger().size()});
        }
}

Outcome World::outcome()
{
    const auto& broken = m_model.violations();
    m_outcome.violations.insert(m_outcome.violations.end(), broken.begin(), broken.end());
    m_outcome.hash = m_hash.value();
    m_outcome.course = m_course.value();
    m_outcome.observations = m_hash.count();
    m_outcome.events = m_time.ran();
    m_outcome.packetsLost = m_network.packetsLost();
    m_outcome.commandsDelivered = m_model.controlDelivered();
    m_outcome.simulated = m_time.now() - m_began;
    return m_outcome;
}

} // namespace liena::simulation
