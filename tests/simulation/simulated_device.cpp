// The work of a simulated device as a whole.
#include "simulated_device.hpp"

#include <algorithm>

namespace liena::simulation {

using namespace std::chrono_literals;
using session::SetStanding;

namespace {

constexpr auto housekeepingPeriod = 20ms;
constexpr std::size_t partialLimit = std::size_t{4} << 20U; ///< smaller than a real device's, so that it is reached

} // namespace

SimulatedDevice::SimulatedDevice(Network& network, const DeviceClock& clock, Surroundings& surroundings, DeviceSettings settings,
                                 Disk& disk, std::unique_ptr<Application> application)
    : Program(network, clock, settings.host),
      m_surroundings(surroundings),
      m_settings(std::move(settings)),
      m_disk(disk),
      m_application(std::move(application)),
      m_budget(partialLimit),
      m_ledger(m_settings.id),
      m_server(*this, m_settings.id, [this](AttachedConnection connection) { attached(std::move(connection)); })
{
    for (const auto& neighbour : m_settings.neighbours)
        m_modules.emplace(neighbour.host, std::make_unique<SimulatedModule>(*this, neighbour.host, neighbour.timing));
}

SimulatedDevice::~SimulatedDevice() = default;

void SimulatedDevice::start()
{
    observe(Started{host()});
    m_application->start(*this);
    every(housekeepingPeriod, [this] {
        for (auto& [peer, one] : m_modules)
            one->housekeeping();
        observe(holdings());
    });
}

void SimulatedDevice::every(Nanoseconds period, std::function<void()> task)
{
    m_periodics.push_back(std::unique_ptr<Periodic>(new Periodic{period, std::move(task), std::make_unique<Timer>(*this), now().mono}));
    startPeriodic(m_periodics.size() - 1);
}

void SimulatedDevice::startPeriodic(std::size_t index)
{
    auto& periodic = *m_periodics[index];
    periodic.due = std::max(periodic.due + periodic.period, now().mono);
    periodic.timer->at(periodic.due, [this, index] {
        turned();
        startPeriodic(index);
        m_periodics[index]->task();
    });
}

SimulatedModule* SimulatedDevice::module(HostIndex peer)
{
    const auto found = m_modules.find(peer);
    return found != m_modules.end() ? found->second.get() : nullptr;
}

void SimulatedDevice::turned()
{
    const auto gap = m_stallWatch.turn(now().mono);
    if (m_handlingStall)
        return;
    const bool concerned = std::any_of(m_modules.begin(), m_modules.end(), [&](const auto& entry) {
        const auto state = entry.second->state();
        return (carriesMessages(state) || state == SessionState::Reconnecting) && gap >= entry.second->timing().suspect;
    });
    if (!concerned)
        return;
    m_handlingStall = true;
    SessionEvent event;
    event.kind = SessionEvent::Kind::LocalStall;
    event.duration = gap;
    tell(std::move(event));
    for (auto& [peer, one] : m_modules)
        one->stalled(gap);
    m_handlingStall = false;
}

void SimulatedDevice::accepted(HostIndex from, ConnectionNumber connection) { m_server.admit(connection, from, m_surroundings.idOf(from)); }

void SimulatedDevice::attached(AttachedConnection connection)
{
    turned();
    if (auto* one = module(connection.from))
        return one->attached(std::move(connection));
    if (auto* stands = network().find(connection.connection))
        stands->close(host());
}

void SimulatedDevice::datagramArrived(HostIndex from, std::span<const std::byte> packet)
{
    turned();
    const auto prefix = protocol::decodePacketPrefix(packet);
    auto* one = module(from);
    if (one != nullptr && prefix && one->owns(prefix->token))
        one->datagramArrived(packet);
}

bool SimulatedDevice::isTokenUsed(HostIndex asking, std::uint64_t token)
{
    return m_ledger.knows(token, now()) || std::any_of(m_modules.begin(), m_modules.end(), [&](const auto& entry) {
               return entry.first != asking && entry.second->owns(token);
           });
}

SetStanding SimulatedDevice::standingOf(HostIndex peer, const Sha256& set)
{
    if (m_surroundings.setOf(peer)->hash() != set)
        return SetStanding::Changed;
    return m_disk.sets.contains(set) ? SetStanding::Held : SetStanding::Unknown;
}

std::shared_ptr<const MessageSet> SimulatedDevice::heldSet(HostIndex peer, const Sha256& set)
{
    return standingOf(peer, set) == SetStanding::Held ? m_surroundings.setOf(peer) : nullptr;
}

session::SetHeard SimulatedDevice::learn(HostIndex peer, const Sha256& set, std::span<const std::byte> xml)
{
    if (Sha256::of(xml) != set)
        return {SetStanding::Invalid, "the message set's bytes do not have the hash that was announced"};
    if (m_surroundings.setOf(peer)->hash() != set)
        return {SetStanding::Invalid, "the message set is that of another device"};
    m_disk.sets.insert(set);
    return {SetStanding::Held, {}};
}

void SimulatedDevice::sessionOpened(HostIndex peer, const session::SessionOpened& opened)
{
    const auto id = m_surroundings.idOf(peer);
    if (opened.reopened)
        perform(m_ledger.reopened(id, opened.token, opened.incident, now()));
    perform(m_ledger.greet(id));
}

void SimulatedDevice::sessionHealed(HostIndex peer) { perform(m_ledger.greet(m_surroundings.idOf(peer))); }

void SimulatedDevice::sessionLost(HostIndex peer, const session::SessionLost& lost)
{
    perform(m_ledger.lost(m_surroundings.idOf(peer), lost.incident, lost.diagnosis.cause, lost.diagnosis.since, now()));
}

void SimulatedDevice::heardBroadcast(HostIndex from, const protocol::SessionMessage& message)
{
    const auto id = m_surroundings.idOf(from);
    if (const auto* standBy = std::get_if<protocol::StandBy>(&message))
        perform(m_ledger.heard(id, *standBy, now()));
    else if (const auto* report = std::get_if<protocol::StandByReport>(&message))
        perform(m_ledger.heard(id, *report, now()));
    else if (const auto* dismissed = std::get_if<protocol::IncidentDismissed>(&message))
        perform(m_ledger.heard(id, *dismissed, now()));
    else if (const auto* reopened = std::get_if<protocol::ChannelReOpened>(&message))
        perform(m_ledger.heard(id, *reopened, now()));
}

void SimulatedDevice::confirmHold(bool holding) { perform(m_ledger.confirmHold(holding, now())); }

void SimulatedDevice::dismiss(IncidentId incident)
{
    if (m_ledger.find(incident) == nullptr)
        return;
    observe(Dismissed{host(), incident});
    perform(m_ledger.dismiss(incident, "given up", now()));
}

void SimulatedDevice::revokeControl()
{
    observe(Revoked{host()});
    for (auto& [peer, one] : m_modules)
        one->revoke();
}

void SimulatedDevice::perform(const session::LedgerActions& actions)
{
    for (auto& [peer, one] : m_modules)
        one->setIncidentCount(m_ledger.size());
    for (const auto& action : actions) {
        if (const auto* broadcast = std::get_if<session::Broadcast>(&action)) {
            performBroadcast(*broadcast);
        } else if (const auto* answer = std::get_if<session::Answer>(&action)) {
            if (auto* one = module(m_surroundings.hostOf(answer->to)))
                one->sendSession(answer->message, DeviceId::broadcast());
        } else if (const auto* changed = std::get_if<session::PairChanged>(&action)) {
            if (auto* one = module(m_surroundings.hostOf(changed->peer)))
                one->setIncident(changed->incident, changed->ended);
        } else if (const auto* heard = std::get_if<session::Tell>(&action)) {
            told(heard->event);
            tell(heard->event);
        } else if (const auto* violation = std::get_if<session::LedgerViolation>(&action)) {
            if (auto* one = module(m_surroundings.hostOf(violation->peer)))
                one->endForViolation(violation->detail);
        }
    }
}

void SimulatedDevice::performBroadcast(const session::Broadcast& broadcast)
{
    for (auto& [peer, one] : m_modules) {
        const bool excepted = broadcast.except && m_surroundings.idOf(peer) == *broadcast.except;
        if ((carriesMessages(one->state()) || one->state() == SessionState::Reconnecting) && !excepted)
            one->sendSession(broadcast.message, DeviceId::broadcast());
    }
}

void SimulatedDevice::told(const SessionEvent& event)
{
    const auto& incident = event.incident;
    if (event.kind == SessionEvent::Kind::IncidentRaised)
        observe(Raised{host(), incident.id, m_surroundings.hostOf(incident.a), m_surroundings.hostOf(incident.b)});
    else if (event.kind == SessionEvent::Kind::IncidentEnded)
        observe(Over{host(), incident.id, event.dismissed, m_surroundings.hostOf(event.peer)});
}

void SimulatedDevice::tell(SessionEvent event)
{
    event.at = now().mono;
    m_application->heard(event);
}

void SimulatedDevice::deliver(HostIndex peer, const Message& message) { m_application->delivered(peer, message); }

void SimulatedDevice::publish(const Message& message)
{
    for (auto& [peer, one] : m_modules)
        if (carriesMessages(one->state()) || one->state() == SessionState::Reconnecting)
            (void)one->send(message);
}

Holdings SimulatedDevice::holdings()
{
    Holdings held{host(), m_budget.used(), 0, 0, m_server.pending(), m_ledger.size(), 0ns};
    for (auto& [peer, one] : m_modules) {
        if (carriesMessages(one->state()))
            held.silence = std::max(held.silence, one->silence());
        held.queuedBytes += one->queuedBytes();
        held.fresh = std::max(held.fresh, one->freshCount());
    }
    return held;
}

} // namespace liena::simulation
