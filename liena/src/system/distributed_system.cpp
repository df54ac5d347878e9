// The facade's calls, from any thread.
#include "liena/known_sets.hpp"
#include "system/distributed_system_state.hpp"

#include "system/audit_entries.hpp"
#include "system/real_time.hpp"

#include <boost/asio/post.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

namespace liena {

namespace asio = boost::asio;

namespace {

Result<std::shared_ptr<security::TlsIdentity>> loadIdentity(const Settings& settings, const SystemTopology& topology,
                                                            const TopologyDevice& own)
{
    if (topology.security() == SecurityMode::Tls) {
        auto loaded = security::TlsIdentity::load(settings.certificate, settings.key, settings.authority, own.id,
                                                  {settings.revocations, std::chrono::system_clock::now, settings.log});
        if (const auto usable = loaded ? loaded.value()->trust().admitSession() : ok(); !usable)
            settings.log(LogLevel::Error, usable.error().what);
        return loaded;
    }
    settings.log({LogLevel::Warning,
                  "NO SECURITY: the topology says mode none; whoever reaches this port can command this device",
                  "no-security",
                  {},
                  own.name});
    if (!own.onLoopback && !settings.allowInsecureNetwork)
        return fail(Errc::Forbidden,
                    fmt::format("security mode none binds to loopback addresses only, not to {}; use mode tls, or allow an insecure "
                                "network on purpose",
                                own.host));
    return std::shared_ptr<security::TlsIdentity>();
}

Result<void> checkMarks(const PacketMarks& marks)
{
    constexpr std::uint8_t highest = 63;
    if (marks.prompt > highest || marks.bulk > highest)
        return fail(Errc::InvalidArgument, fmt::format("packet marks {} and {}: a DSCP is 0 to {}", marks.prompt, marks.bulk, highest));
    return ok();
}

} // namespace

DistributedSystem::DistributedSystem(std::unique_ptr<State> state) : m_state(std::move(state)) {}
DistributedSystem::~DistributedSystem() { stop(); }

Result<std::unique_ptr<DistributedSystem>> DistributedSystem::create(Settings settings)
{
    for (const auto& checked : {checkMarks(settings.marks), system::prepareRealTime(settings.realTime)})
        if (!checked)
            return checked.as_failure();
    auto topology = SystemTopology::load(settings.topology);
    if (!topology)
        return topology.as_failure();
    auto own = topology.value().device(settings.device);
    if (!own)
        return own.as_failure();
    auto registry = Registry::load(settings.registry);
    if (!registry)
        return registry.as_failure();
    if (!registry.value().find(own.value().id))
        return fail(Errc::MessageSetInvalid, fmt::format("the register has no message set for {} ({}): name the folder that holds {}.xml",
                                                         own.value().name, own.value().id.toString(), own.value().messageSet));
    auto identity = loadIdentity(settings, topology.value(), own.value());
    if (!identity)
        return identity.as_failure();
    const auto folder = settings.store.empty() ? defaultSetStore() : settings.store;
    State::Stores stores;
    if (!folder.empty()) {
        std::error_code ignored; // the store itself says what it cannot open
        std::filesystem::create_directories(folder.parent_path(), ignored);
        for (auto* store : {&stores.reading, &stores.writing}) {
            auto opened = LocalStore::open(folder);
            if (!opened)
                return opened.as_failure();
            store->emplace(std::move(opened.value()));
        }
    }
    std::unique_ptr<audit::AuditLog> audit;
    if (!settings.audit.empty()) {
        auto opened = audit::AuditLog::open(settings.audit, own.value().name, settings.log);
        if (!opened)
            return opened.as_failure();
        audit = std::move(opened.value());
    }
    auto state = std::make_unique<State>(std::move(settings), std::move(topology.value()), std::move(own.value()),
                                         std::move(registry.value()), std::move(stores), std::move(identity.value()), std::move(audit));
    if (auto listening = state->listen(); !listening)
        return listening.as_failure();
    return std::unique_ptr<DistributedSystem>(new DistributedSystem(std::move(state)));
}

/// Asio runs what is handed over before it looks at sockets and timers: a stall would be found only after it.
void DistributedSystem::State::post(std::function<void()> task)
{
    asio::post(context, [this, task = std::move(task)] {
        turned();
        task();
    });
}

Result<void> DistributedSystem::State::checkKnown(std::string_view message) const
{
    const auto knows = [&](const std::shared_ptr<const MessageSet>& set) { return set && set->find(message) != nullptr; };
    const bool known = knows(ownMessageSet) ||
                       std::any_of(modules.begin(), modules.end(), [&](const auto& peer) { return knows(registry.find(peer.first)); });
    if (!known)
        return fail(Errc::UnknownMessage, fmt::format("no message set of this device or of a linked one has a message {}", message));
    return ok();
}

Result<void> DistributedSystem::subscribe(std::string_view message, MessageHandler handler)
{
    auto known = m_state->checkKnown(message);
    if (known)
        m_state->newSubscription(message).handlers.push_back(std::move(handler));
    return known;
}

Result<void> DistributedSystem::subscribeToKeep(std::string_view message, KeepingHandler handler)
{
    if (auto known = m_state->checkKnown(message); !known)
        return known;
    auto& keeper = m_state->newSubscription(message).keeper;
    if (keeper)
        return fail(Errc::InvalidArgument, fmt::format("{} is kept by another subscription already: there can be one", message));
    keeper = std::move(handler);
    return ok();
}

void DistributedSystem::subscribe(EventHandler handler) { m_state->eventHandlers.push_back(std::move(handler)); }

void DistributedSystem::every(std::chrono::nanoseconds period, std::function<void()> task)
{
    auto periodic = std::make_unique<State::Periodic>();
    periodic->period = period;
    periodic->task = std::move(task);
    m_state->periodics.push_back(std::move(periodic));
}

void DistributedSystem::start() { m_state->start(); }
void DistributedSystem::stop() { m_state->stop(); }

const SystemTopology& DistributedSystem::topology() const { return m_state->topology; }
const TopologyDevice& DistributedSystem::self() const { return m_state->ownTopologyDevice; }
std::shared_ptr<const MessageSet> DistributedSystem::messageSet(DeviceId device) const { return m_state->knownSet(device); }
MessageCache& DistributedSystem::cache() { return m_state->messageCache; }
std::vector<LinkStatus> DistributedSystem::links() const { return m_state->board.links(); }
std::vector<Incident> DistributedSystem::incidents() const { return m_state->board.incidents(); }

Result<DeviceId> DistributedSystem::State::linkedPeer(DeviceId peer) const
{
    if (stopped)
        return fail(Errc::Stopped, "this device's part in the system has stopped");
    if (modules.contains(peer))
        return peer;
    if (topology.find(peer) == nullptr)
        return fail(Errc::UnknownDevice, fmt::format("{} is not in topology {}", peer.toString(), topology.name()));
    return fail(Errc::NoLink, fmt::format("topology {} has no link between {} and {}", topology.name(), ownTopologyDevice.id.toString(),
                                          peer.toString()));
}

Result<void> DistributedSystem::openChannel(DeviceId peer)
{
    if (const auto linked = m_state->linkedPeer(peer); !linked)
        return linked.as_failure();
    const auto status = m_state->board.link(peer);
    if (status->state == SessionState::StandBy)
        return fail(Errc::StandBy, "the link is in stand-by: a person has to re-open it");
    if (status->state != SessionState::Closed)
        return fail(Errc::Busy, fmt::format("the session is {} already", toString(status->state)));
    m_state->recordCommand("open-commanded", peer, 0, {});
    post([state = m_state.get(), peer] {
        if (auto* one = state->module(peer)) // stop() may have been quicker
            (void)one->open();
    });
    return ok();
}

Result<void> DistributedSystem::closeChannel(DeviceId peer, std::string_view reason)
{
    if (const auto linked = m_state->linkedPeer(peer); !linked)
        return linked.as_failure();
    const auto status = m_state->board.link(peer);
    if (status->state == SessionState::Closed || status->state == SessionState::StandBy)
        return fail(Errc::NotOpen, fmt::format("the session is {}", toString(status->state)));
    m_state->recordCommand("close-commanded", peer, 0, reason);
    post([state = m_state.get(), peer, why = std::string(reason)] {
        if (auto* one = state->module(peer)) // stop() may have been quicker
            (void)one->close(why);
    });
    return ok();
}

Result<void> DistributedSystem::reopenChannel(DeviceId peer)
{
    if (const auto linked = m_state->linkedPeer(peer); !linked)
        return linked.as_failure();
    const auto status = m_state->board.link(peer);
    if (status->state == SessionState::Reopening)
        return fail(Errc::Busy, "the session is being re-opened");
    if (status->state != SessionState::StandBy)
        return fail(Errc::NoIncident, fmt::format("the session is {}, there is nothing to re-open", toString(status->state)));
    m_state->recordCommand("reopen-commanded", peer, status->incident, {});
    post([state = m_state.get(), peer, seen = status->incident] {
        if (auto* one = state->module(peer)) // stop() may have been quicker
            (void)one->reopen(seen);
    });
    return ok();
}

Result<void> DistributedSystem::dismissIncident(IncidentId incident, std::string_view reason)
{
    const auto held = incidents();
    if (std::none_of(held.begin(), held.end(), [&](const Incident& one) { return one.id == incident; }))
        return fail(Errc::NoIncident, "this device holds no such incident");
    m_state->recordCommand("dismissal-commanded", std::nullopt, incident, reason);
    post([state = m_state.get(), incident, why = std::string(reason)] {
        state->perform(state->ledger.dismiss(incident, why, state->now()));
    });
    return ok();
}

Result<void> DistributedSystem::probe(DeviceId peer)
{
    if (const auto linked = m_state->linkedPeer(peer); !linked)
        return linked.as_failure();
    post([state = m_state.get(), peer] {
        if (auto* one = state->module(peer)) // stop() may have been quicker
            one->probe();
    });
    return ok();
}

Result<void> DistributedSystem::measure(DeviceId peer, MeasurementPlan plan, MeasurementHandler done)
{
    if (const auto linked = m_state->linkedPeer(peer); !linked)
        return linked.as_failure();
    const auto status = m_state->board.link(peer);
    if (status->state != SessionState::Open)
        return fail(Errc::NotOpen, fmt::format("the session is {}", toString(status->state)));
    post([state = m_state.get(), peer, plan = std::move(plan), done = std::move(done)]() mutable {
        auto* one = state->module(peer);
        if (one == nullptr)
            return; // stopped meanwhile
        if (const auto begun = one->measure(std::move(plan), done); !begun) {
            Measurement none;
            none.failure = begun.error().what;
            done(none);
        }
    });
    return ok();
}

void DistributedSystem::stopMeasuring(DeviceId peer)
{
    post([state = m_state.get(), peer] {
        if (auto* one = state->module(peer))
            one->stopMeasuring();
    });
}

void DistributedSystem::confirmHold(bool holding)
{
    m_state->recordCommand(holding ? "hold-confirmed" : "hold-ended", std::nullopt, 0, {});
    post([state = m_state.get(), holding] { state->perform(state->ledger.confirmHold(holding, state->now())); });
}

void DistributedSystem::revokeControl()
{
    m_state->recordCommand("control-revoked", std::nullopt, 0, {});
    const auto revoke = [state = m_state.get()] {
        for (auto& [peer, one] : state->modules)
            one->revoke();
    };
    if (m_state->isNetworkThread())
        revoke();
    else
        post(revoke);
}

Result<Message> DistributedSystem::report(std::string_view name) const
{
    const auto* definition = m_state->ownMessageSet->find(name);
    if (definition == nullptr || definition->role != Role::Report)
        return fail(Errc::UnknownMessage, fmt::format("message set {} has no report {}", m_state->ownMessageSet->name(), name));
    return Message(m_state->ownMessageSet, *definition);
}

Result<Message> DistributedSystem::command(DeviceId target, std::string_view name) const
{
    auto set = m_state->knownSet(target);
    if (!set)
        return fail(Errc::NotYet, fmt::format("the message set of {} is not known before its first session", target.toString()));
    const auto* definition = set->find(name);
    if (definition == nullptr || definition->role != Role::Command)
        return fail(Errc::UnknownMessage, fmt::format("message set {} has no command {}", set->name(), name));
    return Message(std::move(set), *definition);
}

/// The network thread asks its own modules, and takes no lock.
std::shared_ptr<const MessageSet> DistributedSystem::State::knownSet(DeviceId device) const
{
    if (!isNetworkThread() || stopped)
        return board.set(device);
    if (device == ownTopologyDevice.id)
        return ownMessageSet;
    const auto* one = module(device);
    return one != nullptr ? one->knownSet() : nullptr;
}

namespace {

/// A null set is none's.
bool isSame(const MessageSet* known, const MessageSet& set) { return known != nullptr && (known == &set || known->hash() == set.hash()); }

std::string belongsElsewhere(const MessageDefinition& definition, DeviceId owner)
{
    return fmt::format("{} does not belong to the message set of {}", definition.name, owner.toString());
}

} // namespace

/// From other threads than the network thread.
Result<void> DistributedSystem::State::checkSend(DeviceId target, const Message& message) const
{
    if (const auto linked = linkedPeer(target); !linked)
        return linked.as_failure();
    if (message.fault())
        return boost::outcome_v2::failure(*message.fault());
    const auto& definition = message.definition();
    const auto owner = definition.role == Role::Command ? target : ownTopologyDevice.id;
    const auto facts = board.sendFacts(target, owner);
    if (!isSame(facts.set.get(), message.messageSet()))
        return fail(Errc::UnknownMessage, belongsElsewhere(definition, owner));
    const bool control = definition.priority == Priority::Control;
    if (!carriesMessages(facts.state) && (control || facts.state != SessionState::Reconnecting))
        return fail(Errc::NotOpen, fmt::format("the session is {}", toString(facts.state)));
    if (!definition.allowedInStandBy && facts.standsBy)
        return fail(Errc::StandBy, fmt::format("{} is refused while the system stands by", definition.name));
    return ok();
}

/// On the network thread: no lock, and the module says what the board says to others.
Result<void> DistributedSystem::State::sendFromHere(DeviceId target, Message&& message)
{
    auto* one = stopped ? nullptr : module(target);
    if (one == nullptr)
        return linkedPeer(target).as_failure();
    if (message.fault())
        return boost::outcome_v2::failure(*message.fault());
    const auto& definition = message.definition();
    const bool isCommand = definition.role == Role::Command;
    if (!isSame(isCommand ? one->knownSet().get() : ownMessageSet.get(), message.messageSet()))
        return fail(Errc::UnknownMessage, belongsElsewhere(definition, isCommand ? target : ownTopologyDevice.id));
    return sendBy(*one, std::move(message));
}

Result<void> DistributedSystem::send(DeviceId target, Message message)
{
    if (m_state->isNetworkThread())
        return m_state->sendFromHere(target, std::move(message));
    if (auto allowed = m_state->checkSend(target, message); !allowed)
        return allowed;
    if (!m_state->outbox.put(target, std::move(message)))
        return fail(Errc::QueueFull, "too many messages wait for the network thread");
    return ok();
}

std::size_t DistributedSystem::publish(Message message)
{
    if (message.fault() || message.definition().role != Role::Report || m_state->stopped)
        return 0;
    if (m_state->isNetworkThread()) {
        const auto open = m_state->openSessions();
        m_state->publishNow(std::move(message));
        return open;
    }
    const auto open = m_state->board.openLinks();
    return open > 0 && m_state->outbox.put(DeviceId::broadcast(), std::move(message)) ? open : 0;
}

void DistributedSystem::audit(std::string_view event, std::string_view who, std::string_view text)
{
    m_state->record({.event = std::string(event), .who = std::string(who), .text = std::string(text), .byApplication = true});
}

void DistributedSystem::post(std::function<void()> task) { m_state->post(std::move(task)); }

} // namespace liena
