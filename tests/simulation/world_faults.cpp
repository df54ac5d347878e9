// How each kind of fault is put into a world, and how everything is healed.
#include "applications.hpp"
#include "world.hpp"

#include <algorithm>

namespace liena::simulation {

using namespace std::chrono_literals;

void World::apply(const Fault& fault)
{
    ++m_outcome.faults;
    ++m_outcome.faultsOfKind[static_cast<std::size_t>(fault.kind)];
    markFault(fault);
    if (fault.kind <= FaultKind::Collapse || fault.kind == FaultKind::SwallowEnds || fault.kind == FaultKind::NoDatagrams)
        applyToPath(fault);
    else if (fault.a == fault.b)
        applyToHost(fault);
    else
        applyToSockets(fault);
}

void World::markFault(const Fault& fault)
{
    const auto mark = [&](HostIndex host, HostIndex peer) {
        const auto& device = m_hosts[host].device;
        const auto* module = device ? device->module(peer) : nullptr;
        m_outcome.coverage.fault(fault.kind, module != nullptr ? module->state() : SessionState::Closed);
    };
    if (fault.a != fault.b) {
        mark(fault.a, fault.b);
        mark(fault.b, fault.a);
    } else if (const auto& device = m_hosts[fault.a].device) {
        for (const auto& [peer, module] : device->modules())
            mark(fault.a, peer);
    }
}

/// Faults end by themselves, at the latest with the chaos.
void World::later(const Fault& fault, std::function<void()> undo)
{
    const auto at = std::min(m_time.now() + fault.duration, m_began + m_scenario.chaos);
    m_time.at(at, [this, undo = std::move(undo)] {
        if (!m_peace)
            undo();
    });
}

void World::applyToPath(const Fault& fault)
{
    auto& path = m_network.path(fault.a, fault.b);
    auto& back = m_network.path(fault.b, fault.a);
    const auto undo = [&](auto change) { later(fault, [&path, &back, change] { change(path), change(back); }); };
    switch (fault.kind) {
    case FaultKind::Cut:
        ++path.cut, ++back.cut;
        return undo([](Path& way) { --way.cut; });
    case FaultKind::CutOneWay:
        ++path.cut;
        return later(fault, [&path] { --path.cut; });
    case FaultKind::Burst: {
        ++path.cut, ++back.cut;
        auto brief = fault;
        brief.duration = Nanoseconds(1ms) + fault.duration / 40;
        return later(brief, [&path, &back] { --path.cut, --back.cut; });
    }
    case FaultKind::Loss:
        path.loss = fault.amount % 300'000;
        return later(fault, [this, &path] { path.loss = m_scenario.loss; });
    case FaultKind::Delay:
        path.delay = m_scenario.delay + Nanoseconds(fault.amount % 200'000'000);
        return later(fault, [this, &path] { path.delay = m_scenario.delay; });
    case FaultKind::Jitter:
        path.jitter = Nanoseconds(fault.amount % 60'000'000);
        return later(fault, [this, &path] { path.jitter = m_scenario.jitter; });
    case FaultKind::Hold:
        path.heldUntil = std::min(m_time.now() + fault.duration / 4, m_began + m_scenario.chaos);
        return;
    case FaultKind::Collapse:
        path.rate = 12'500 + fault.amount % 200'000;
        return later(fault, [&path] { path.rate = 0; });
    case FaultKind::SwallowEnds:
        path.keepsEnds = back.keepsEnds = true;
        return undo([](Path& way) { way.keepsEnds = false; });
    default:
        path.noDatagrams = true;
        return later(fault, [&path] { path.noDatagrams = false; });
    }
}

void World::applyToHost(const Fault& fault)
{
    const auto host = fault.a;
    auto& target = m_hosts[host];
    switch (fault.kind) {
    case FaultKind::Refuse:
        ++target.refusals;
        return later(fault, [&target] { --target.refusals; });
    case FaultKind::Pause:
        pause(host);
        return later(fault, [this, host] { resume(host); });
    case FaultKind::Crash:
        end(host, true);
        return later(fault, [this, host] { boot(host); });
    case FaultKind::PowerCut:
        ++target.downs;
        end(host, false);
        return later(fault, [this, host, &target] {
            --target.downs;
            boot(host);
        });
    case FaultKind::ClockStep: {
        constexpr std::array steps{Nanoseconds(1h),   Nanoseconds(-1h),  Nanoseconds(24h),
                                   Nanoseconds(-24h), Nanoseconds(50ms), Nanoseconds(-50ms)};
        return target.clock.step(steps[fault.amount % steps.size()]);
    }
    case FaultKind::Flood:
        if (target.floods++ == 0)
            flood(host);
        return later(fault, [&target] { --target.floods; });
    case FaultKind::Lie:
        ++target.lies;
        return later(fault, [&target] { --target.lies; });
    case FaultKind::PersonDismisses:
        return whenRunning(host, [&target] { target.person->giveUp(); });
    default:
        return whenRunning(host, [&target] { target.person->stopRobots(); });
    }
}

void World::applyToSockets(const Fault& fault)
{
    auto& target = m_hosts[fault.a];
    switch (fault.kind) {
    case FaultKind::Reset:
        (void)m_network.reset(fault.a, fault.b, fault.amount);
        return;
    case FaultKind::SlowReader:
        (void)m_network.holdReading(fault.a, fault.b, fault.amount,
                                    std::min(m_time.now() + fault.duration / 4, m_began + m_scenario.chaos));
        return;
    case FaultKind::Replay:
        target.replays += 1 + fault.amount % 8;
        return;
    case FaultKind::Corrupt:
        target.corruptions += 1 + static_cast<int>(fault.amount % 4);
        return;
    case FaultKind::SilentSockets:
        for (auto count = fault.amount % 12; count > 0; --count)
            openSocket(fault.a, fault.b, {}, fault.duration);
        return;
    case FaultKind::StaleAttach: {
        const protocol::Attach attach{1, m_oldTokens.empty() ? 1 : m_oldTokens[fault.amount % m_oldTokens.size()],
                                      static_cast<std::uint8_t>(fault.amount % 5 == 0 ? 1 : 0)};
        const auto body = protocol::encodeSessionMessage(attach);
        std::vector<std::byte> bytes;
        protocol::EncodedMessage message{{{idOf(fault.a), protocol::Attach::number}, idOf(fault.b), Timestamp{1}}, {}};
        message.part.assign(body.begin(), body.end());
        protocol::DatagramEncoder().appendSegment(message, protocol::maximumBody, bytes);
        return openSocket(fault.a, fault.b, std::move(bytes), fault.duration);
    }
    case FaultKind::PersonPresses:
        return whenRunning(fault.a, [&target, peer = fault.b] { target.person->pressReopen(peer); });
    default:
        return whenRunning(fault.a, [&target, peer = fault.b] { target.person->pressClose(peer); });
    }
}

void World::openSocket(HostIndex from, HostIndex to, std::vector<std::byte> bytes, Nanoseconds length)
{
    m_network.connect(from, to, 1s, [this, from, bytes = std::move(bytes), length](ConnectionNumber number, ConnectFailure) {
        auto* stands = m_network.find(number);
        if (stands == nullptr)
            return;
        if (!bytes.empty())
            stands->write(bytes);
        m_time.after(length, [this, from, number] {
            if (auto* still = m_network.find(number))
                still->close(from);
        });
    });
}

void World::flood(HostIndex host)
{
    auto& target = m_hosts[host];
    whenRunning(host, [&target] {
        const auto& set = target.device->settings().set;
        for (const auto& definition : set->messages())
            if (definition.role == Role::Report && definition.priority == Priority::Status) {
                Message message(set, definition);
                for (int i = 0; i < 10; ++i)
                    target.device->publish(message);
                break;
            }
    });
    m_time.after(5ms, [this, host, &target] {
        if (target.floods > 0 && !m_peace)
            flood(host);
    });
}

void World::pause(HostIndex host)
{
    if (++m_hosts[host].pauses == 1)
        observe(Paused{host, true});
}

void World::resume(HostIndex host)
{
    auto& target = m_hosts[host];
    if (target.pauses == 0 || --target.pauses > 0)
        return;
    target.resumed = m_time.now();
    observe(Paused{host, false});
    const auto boot = target.boot;
    auto waiting = std::exchange(target.waiting, {});
    // What a program finds first when it runs again is not its choice.
    if (!waiting.empty() && m_faultRandom.below(2) == 0)
        std::rotate(waiting.begin(), waiting.begin() + static_cast<std::ptrdiff_t>(m_faultRandom.below(waiting.size())), waiting.end());
    for (auto& event : waiting)
        if (target.device && target.boot == boot)
            event();
}

void World::end(HostIndex host, bool tells)
{
    auto& target = m_hosts[host];
    if (!target.device)
        return;
    target.waiting.clear();
    target.pauses = 0;
    m_network.hostEnded(host, tells);
    target.device.reset();
    observe(Ended{host});
}

void World::boot(HostIndex host)
{
    auto& target = m_hosts[host];
    if (target.device || target.downs > 0)
        return;
    ++target.boot;
    target.device = std::make_unique<SimulatedDevice>(m_network, target.clock, *this, settingsFor(host), target.disk,
                                                      applicationFor(m_scenario, host, m_workload.fork()));
    target.device->start();
    target.person->sitDown(*target.device);
}

void World::leaving(HostIndex device, HostIndex peer, std::vector<std::byte>& bytes, std::size_t begin)
{
    auto& host = m_hosts[device];
    if (m_peace)
        return;
    if (BlackChannel::isCommand(bytes, begin)) {
        auto& channel = m_channels[{device, peer}];
        channel.remember(bytes, begin);
        if (host.corruptions > 0) {
            --host.corruptions;
            BlackChannel::corrupt(bytes, begin, m_lieRandom);
        }
        if (host.replays > 0) {
            --host.replays;
            channel.replay(bytes, m_lieRandom, 1 + m_lieRandom.below(2));
        }
    }
    if (host.lies > 0 && m_lieRandom.below(8) == 0)
        m_liar->speak(bytes, begin, m_lieRandom, m_scenario.lies);
}

void World::heal()
{
    m_peace = true;
    for (HostIndex a = 0; a < m_hosts.size(); ++a)
        for (HostIndex b = 0; b < m_hosts.size(); ++b) {
            auto& path = m_network.path(a, b);
            path = Path();
            path.delay = m_scenario.delay;
            path.jitter = m_scenario.jitter;
            path.loss = m_scenario.chaos > 0ns ? 0 : m_scenario.loss; // what is healed loses nothing
        }
    for (HostIndex host = 0; host < m_hosts.size(); ++host) {
        auto& target = m_hosts[host];
        target.refusals = target.downs = target.lies = target.floods = target.corruptions = 0;
        target.replays = 0;
        target.person->becomePolite();
        if (m_scenario.liar == host && m_scenario.chaos > 0ns)
            end(host, true); // it is replaced by an honest one
        boot(host);
        if (target.pauses > 0) {
            target.pauses = 1;
            resume(host);
        }
    }
}

} // namespace liena::simulation
