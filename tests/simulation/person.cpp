// What a person does, and when.
#include "person.hpp"

#include "applications.hpp"

namespace liena::simulation {

using namespace std::chrono_literals;

void Person::sitDown(SimulatedDevice& device)
{
    m_device = &device;
    m_prompts.clear();
    m_seen.clear();
    device.every(20ms, [this] { think(); });
}

void Person::think()
{
    for (auto& [peer, module] : m_device->modules())
        thinkOf(*module, m_prompts[peer]);
    if (m_polite)
        tidy();
}

void Person::thinkOf(SimulatedModule& module, Prompt& prompt)
{
    const auto now = m_device->now().mono;
    if (module.state() == SessionState::Closed && now >= prompt.nextOpening && (m_plan.opens || m_polite)) {
        prompt.nextOpening = now + (m_polite ? Nanoseconds(200ms) : m_random.between(Nanoseconds(300ms), Nanoseconds(1500ms)));
        module.open(true);
    }
    const bool standsBy = module.state() == SessionState::StandBy;
    const bool isNew = standsBy && (!prompt.standsBy || prompt.shown != module.machine().incident());
    prompt.standsBy = standsBy;
    if (isNew) {
        if (m_plan.manner != Manner::Stale || m_polite || prompt.shown == 0)
            prompt.shown = module.machine().incident();
        prompt.answers = 0;
        prompt.answerAt = now + (m_plan.manner == Manner::Late ? m_random.between(Nanoseconds(1s), Nanoseconds(4s))
                                                               : m_random.between(Nanoseconds(20ms), Nanoseconds(600ms)));
    }
    if (standsBy)
        answer(module, prompt);
}

void Person::answer(SimulatedModule& module, Prompt& prompt)
{
    if (m_polite)
        return (void)module.reopen(true, module.machine().incident());
    const auto now = m_device->now().mono;
    if (m_plan.manner == Manner::Never || now < prompt.answerAt)
        return;
    module.reopen(true, prompt.shown);
    prompt.answerAt = now + m_random.between(Nanoseconds(20ms), Nanoseconds(900ms));
    if (m_plan.manner == Manner::Stale && ++prompt.answers > 3)
        prompt.shown = module.machine().incident();
}

/// Incidents of a pair that is open, or of no pair at all, are given up: nothing else ends them.
void Person::tidy()
{
    const auto now = m_device->now().mono;
    for (const auto& incident : m_device->ledger().incidents()) {
        const auto seen = m_seen.try_emplace(incident.id, now).first->second;
        if (now - seen < 500ms)
            continue;
        const auto& surroundings = m_device->surroundings();
        const auto other = incident.a == m_device->settings().id ? incident.b : incident.a;
        const bool own = incident.a == m_device->settings().id || incident.b == m_device->settings().id;
        const auto* module = own ? m_device->module(surroundings.hostOf(other)) : nullptr;
        if ((module != nullptr && carriesMessages(module->state())) || (own && module == nullptr) || now - seen > 1500ms)
            m_device->dismiss(incident.id);
    }
}

void Person::pressReopen(HostIndex peer)
{
    auto* module = m_device->module(peer);
    if (module != nullptr)
        module->reopen(true, m_prompts[peer].shown);
}

void Person::pressClose(HostIndex peer)
{
    if (auto* module = m_device->module(peer))
        module->close();
}

void Person::giveUp()
{
    const auto incidents = m_device->ledger().incidents();
    if (!incidents.empty())
        m_device->dismiss(incidents[m_random.below(incidents.size())].id);
}

void Person::stopRobots()
{
    for (auto& [peer, module] : m_device->modules()) {
        const auto set = m_device->surroundings().setOf(peer);
        if (set->find("EmergencyStop") == nullptr)
            continue;
        Form stop(set, "EmergencyStop");
        module->send(stop.set("token", m_random.next() | 1U).set("source", "the person").set("reason", "simulated").message());
    }
}

} // namespace liena::simulation
