// Sessions of a simulated device: what is told to the machine, and what is done for it.
#include "simulated_module.hpp"

#include "simulated_device.hpp"

#include "protocol/crc32c.hpp"

#include <algorithm>

namespace liena::simulation {

using namespace std::chrono_literals;

namespace {

constexpr auto reportPeriod = 200ms;

session::SessionSettings settingsOf(SimulatedDevice& device, HostIndex peer, const LinkTiming& timing)
{
    static const auto topology = Sha256::of(std::string_view("the simulated topology"));
    return {device.settings().id, device.surroundings().idOf(peer), timing, topology, device.settings().set->hash(), "simulation"};
}

} // namespace

SimulatedModule::SimulatedModule(SimulatedDevice& device, HostIndex peer, const LinkTiming& timing)
    : m_device(device),
      m_peer(peer),
      m_timing(timing),
      m_machine(settingsOf(device, peer, timing)),
      m_laneZero(device, peer, {8192, 32768}, laneZeroHandlers()),
      m_bulk(device, peer, {16384, 65536}, bulkHandlers()),
      m_bulkRetry(device),
      m_couriers(device, peer),
      m_timer(device)
{}

bool SimulatedModule::open(bool byPerson)
{
    if (m_machine.state() != SessionState::Closed)
        return false;
    const auto token = m_device.surroundings().freshToken();
    m_device.observe(Requested{m_device.host(), m_peer, token, false, byPerson, 0});
    handle(session::OpenRequested{token});
    return true;
}

bool SimulatedModule::reopen(bool byPerson, IncidentId shown)
{
    if (m_machine.state() != SessionState::StandBy)
        return false;
    const auto token = m_device.surroundings().freshToken();
    m_device.observe(Requested{m_device.host(), m_peer, token, true, byPerson, shown});
    const auto unbound = m_device.settings().mutant == Mutant::ConfirmNotBound;
    handle(session::ReopenRequested{token, unbound ? IncidentId{0} : shown});
    return true;
}

bool SimulatedModule::close()
{
    const auto state = m_machine.state();
    if (state == SessionState::Closed || state == SessionState::StandBy || state == SessionState::Closing)
        return false;
    handle(session::CloseRequested{"the person closes it"});
    return true;
}

void SimulatedModule::revoke()
{
    perform(m_machine.revoke(m_device.now()));
    armTimer();
}

void SimulatedModule::stalled(Nanoseconds gap)
{
    if (gap >= m_timing.suspect)
        handle(session::Stalled{gap});
}

void SimulatedModule::setIncident(IncidentId incident, IncidentId ended)
{
    if (incident != 0)
        handle(session::IncidentHeld{incident, ended});
    else
        handle(session::IncidentGone{});
}

void SimulatedModule::handle(const session::SessionInput& input)
{
    perform(m_machine.handle(input, m_device.now()));
    armTimer();
}

void SimulatedModule::armTimer()
{
    const auto deadline = m_machine.nextDeadline();
    if (!deadline || (m_armed && *m_armed <= *deadline))
        return;
    m_armed = deadline;
    m_timer.at(*deadline, [this] {
        m_armed.reset();
        m_device.turned();
        handle(session::Tick{});
    });
}

bool SimulatedModule::owns(std::uint64_t token) const
{
    const auto state = m_machine.state();
    return token != 0 && token == m_machine.token() && state != SessionState::Closed && state != SessionState::StandBy;
}

Nanoseconds SimulatedModule::silence() const
{
    const auto heard = m_machine.monitor().lastHeard();
    return heard == Instant{} ? 0ns : m_device.now().mono - heard;
}

struct SimulatedModule::Doer {
    SimulatedModule& module;

    void operator()(const session::ConnectLaneZero&) { module.connectLaneZero(); }
    void operator()(const session::CloseLanes& close) { module.closeLanes(close.grace); }
    void operator()(const session::Adopt& adopt) { module.adopt(adopt.connection); }
    void operator()(const session::Refuse& refusal) { module.refuse(refusal); }
    void operator()(const session::Ignore& ignored)
    {
        if (const auto fresh = module.m_fresh.find(ignored.connection); fresh != module.m_fresh.end())
            fresh->second->ignore();
    }
    void operator()(const session::Send& send) { module.sendMessage(send); }
    void operator()(const session::SendOwnSet&)
    {
        const auto& set = *module.m_device.settings().set;
        const auto bytes = std::as_bytes(std::span(set.xml().data(), set.xml().size()));
        module.sendSession(protocol::MessageSetAnswer{set.hash(), {bytes.begin(), bytes.end()}},
                           module.m_device.surroundings().idOf(module.m_peer));
    }
    void operator()(const session::DiscardControl&)
    {
        if (module.m_device.settings().mutant != Mutant::QueueNotDropped)
            module.m_laneZero.queue().discard(tasks::Rank::Control);
    }
    void operator()(const session::DiscardAll&)
    {
        if (module.m_device.settings().mutant == Mutant::QueueNotDropped)
            return;
        module.m_laneZero.queue().discardApplication();
        module.m_bulk.queue().discardApplication();
    }
    void operator()(const session::Entered& change) { module.entered(change); }
    void operator()(const session::SessionOpened& opened) { module.opened(opened); }
    void operator()(const session::OpenFailed&) { module.tell(SessionEvent::Kind::OpenFailed); }
    void operator()(const session::SessionClosed&) { module.tell(SessionEvent::Kind::Closed); }
    void operator()(const session::SessionInterrupted&)
    {
        const auto& machine = module.m_machine;
        module.m_device.observe(Opened{module.m_device.host(), module.m_peer, machine.token(), false, true, machine.guard().epoch()});
        module.m_device.sessionHealed(module.m_peer);
        module.tell(SessionEvent::Kind::Interrupted);
    }
    void operator()(const session::SessionLost& lost)
    {
        module.m_device.observe(Lost{module.m_device.host(), module.m_peer, lost.incident});
        module.tell(SessionEvent::Kind::Lost, lost.incident);
        module.m_device.sessionLost(module.m_peer, lost);
    }
};

void SimulatedModule::perform(session::SessionActions actions)
{
    for (const auto& action : actions)
        std::visit(Doer{*this}, action);
}

void SimulatedModule::sendMessage(const session::Send& send)
{
    if (const auto* heartbeat = std::get_if<protocol::Heartbeat>(&send.message))
        return sendHeartbeat(*heartbeat);
    const auto rank = send.afterOutput ? tasks::Rank::Last : tasks::Rank::Safety;
    m_laneZero.push({encode(send.message, m_device.surroundings().idOf(m_peer)), rank, 0, std::nullopt, {}});
}

void SimulatedModule::sendHeartbeat(protocol::Heartbeat heartbeat)
{
    if (m_device.settings().mutant == Mutant::HeartbeatStateless)
        heartbeat.state = SessionState::Open;
    if (m_firstEpoch == 0)
        m_firstEpoch = heartbeat.epoch;
    if (m_device.settings().mutant == Mutant::SameEpoch)
        heartbeat.epoch = m_firstEpoch;
    m_device.observe(Beat{m_device.host(), m_peer, heartbeat.state, heartbeat.epoch});
    auto encoded = encode(heartbeat, m_device.surroundings().idOf(m_peer));
    sendPacket(encoded);
    m_laneZero.push({std::move(encoded), tasks::Rank::Safety, 1, std::nullopt, {}});
}

protocol::EncodedMessage SimulatedModule::encode(const protocol::SessionMessage& message, DeviceId target)
{
    const auto body = protocol::encodeSessionMessage(message);
    protocol::EncodedMessage encoded;
    encoded.header.message = {m_device.settings().id, protocol::numberOf(message)};
    encoded.header.target = target;
    encoded.header.timestamp = m_device.stamp();
    encoded.part.assign(body.begin(), body.end());
    return encoded;
}

void SimulatedModule::sendSession(const protocol::SessionMessage& message, DeviceId target)
{
    const auto rank = target.isBroadcast() ? tasks::Rank::Incident : tasks::Rank::Safety;
    m_laneZero.push({encode(message, target), rank, 0, std::nullopt, {}});
}

void SimulatedModule::entered(const session::Entered& change)
{
    m_device.observe(Entered{m_device.host(), m_peer, change.from, change.to, m_machine.token(), silence()});
    SessionEvent event;
    event.kind = SessionEvent::Kind::StateChanged;
    event.peer = m_device.surroundings().idOf(m_peer);
    event.from = change.from;
    event.to = change.to;
    m_device.tell(std::move(event));
    if (change.to == SessionState::Open)
        for (const auto& entry : m_incomingBulk)
            m_device.post([this, lane = entry.first, reception = entry.second.get()] {
                const auto found = m_incomingBulk.find(lane);
                if (found != m_incomingBulk.end() && found->second.get() == reception)
                    reception->start();
            });
}

void SimulatedModule::opened(const session::SessionOpened& opened)
{
    m_newest.clear();
    m_device.observe(Opened{m_device.host(), m_peer, opened.token, opened.reopened, false, m_machine.guard().epoch()});
    m_device.sessionOpened(m_peer, opened);
    tell(opened.reopened ? SessionEvent::Kind::ReOpened : SessionEvent::Kind::Opened, opened.incident);
}

void SimulatedModule::tell(SessionEvent::Kind kind, IncidentId incident)
{
    SessionEvent event;
    event.kind = kind;
    event.peer = m_device.surroundings().idOf(m_peer);
    event.from = event.to = m_machine.state();
    event.incident.id = incident;
    m_device.tell(std::move(event));
}

void SimulatedModule::housekeeping()
{
    const auto now = m_device.now().mono;
    if (carriesMessages(m_machine.state()) && now >= m_nextReport &&
        !m_laneZero.queue().waits(tasks::Rank::Safety, protocol::LinkReport::number)) {
        m_nextReport = now + reportPeriod;
        m_laneZero.push({encode(protocol::LinkReport{}, m_device.surroundings().idOf(m_peer)), tasks::Rank::Safety, 0, std::nullopt, {}});
    }
    if (m_device.settings().mutant == Mutant::AutoResume && m_machine.state() == SessionState::StandBy)
        reopen(false, m_machine.incident());
}

bool SimulatedModule::send(const Message& message)
{
    const auto& definition = message.definition();
    const auto state = m_machine.state();
    const bool control = definition.priority == Priority::Control;
    if ((!definition.allowedInStandBy && m_device.standsBy()) ||
        (!carriesMessages(state) && (control || state != SessionState::Reconnecting)) || (control && !m_machine.stamper().ready()))
        return false;
    protocol::EncodedMessage encoded;
    encoded.header.message = {m_device.settings().id, definition.number};
    encoded.header.target = m_device.surroundings().idOf(m_peer);
    encoded.header.timestamp = m_device.stamp();
    const auto fields = message.fieldBytes();
    if (control) {
        const auto record = m_machine.stamper().next(encoded.header, fields);
        if (!record) {
            handle(session::ViolationFound{"the sequence numbers of a control message are used up"});
            return false;
        }
        const auto bytes = protocol::encodeSafetyRecord(*record);
        encoded.part.assign(bytes.begin(), bytes.end());
    }
    encoded.part.insert(encoded.part.end(), fields.begin(), fields.end());
    const MessageName name{m_device.settings().id.value(), definition.number, encoded.header.timestamp.ns};
    const auto engagedField = control ? definition.indexOf("engaged") : std::nullopt;
    m_device.observe(
        Composed{m_device.host(), m_peer, name, control, engagedField && message.get<bool>(*engagedField), protocol::crc32c(fields)});
    if (definition.path == liena::Path::Datagram && m_machine.datagramsHeardByPeer() > 0 && sendPacket(encoded)) {
        m_device.observe(Left{m_device.host(), m_peer, name});
        return true;
    }
    tasks::OutputQueue::Entry entry{std::move(encoded), tasks::rankOf(definition.priority), definition.history, std::nullopt,
                                    definition.name};
    if (definition.lifespan)
        entry.expires = m_device.now().mono + *definition.lifespan;
    const bool bulk = definition.priority == Priority::Bulk;
    if (!(bulk ? m_bulk : m_laneZero).push(std::move(entry))) {
        m_device.observe(Unsent{m_device.host(), m_peer, name, Fate::Discarded});
        return false;
    }
    if (bulk)
        connectBulk();
    return true;
}

} // namespace liena::simulation
