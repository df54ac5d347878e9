// The network thread's work for the whole device.
#include "system/distributed_system_state.hpp"

#include "liena/status.hpp"
#include "security/random_token.hpp"
#include "system/audit_entries.hpp"
#include "system/card_search.hpp"
#include "system/real_time.hpp"
#include "system/status_line.hpp"
#include "transport/packet_mark.hpp"

#include <boost/asio/post.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <ctime>

namespace liena {

namespace asio = boost::asio;
using namespace std::chrono_literals;

namespace {

constexpr auto housekeepingPeriod = 20ms;
constexpr auto closingLimit = 1s;

/// The monotonic clock stands still while the computer is suspended; this one goes on, and costs as little.
session::Instant bootNow()
{
    timespec time{};
    ::clock_gettime(CLOCK_BOOTTIME, &time);
    return session::Instant(std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec));
}

} // namespace

/// There is at most one on its way: the next may come when the outbox was taken.
struct DistributedSystem::State::OutboxCall {
    using allocator_type = transport::HandlerAllocator<std::byte>;

    State* state;

    allocator_type get_allocator() const { return allocator_type(state->outboxMemory); }
    void operator()() const { state->drainOutbox(); }
};

DistributedSystem::State::State(Settings given, SystemTopology read, TopologyDevice own, Registry sets, Stores stores,
                                std::shared_ptr<security::TlsIdentity> tls, std::unique_ptr<audit::AuditLog> auditLog)
    : settings(std::move(given)),
      topology(std::move(read)),
      ownTopologyDevice(std::move(own)),
      registry(std::move(sets)),
      store(std::move(stores.reading)),
      audit(std::move(auditLog)),
      tlsIdentity(std::move(tls)),
      ownMessageSet(registry.find(ownTopologyDevice.id)),
      outbox([this] { asio::post(context, OutboxCall{this}); }),
      setKeeper(context, std::move(stores.writing)),
      ledger(ownTopologyDevice.id, topology.devices().size()),
      udpSocket(
          context, [this](std::span<std::byte> packet) { packetHeard(packet); }, settings.log),
      server(context, ownTopologyDevice.id, tlsIdentity,
             {[this](transport::AttachedConnection connection) { attached(std::move(connection)); },
              [this](DeviceId device, const std::string& cause, const asio::ip::tcp::endpoint& from) {
                  identityRefused(device, cause, fmt::format("{}:{}: {}", from.address().to_string(), from.port(), cause));
              }},
             settings.log)
{
    board.showSet(ownTopologyDevice.id, ownMessageSet);
    for (const auto* link : topology.linksOf(ownTopologyDevice.id)) {
        const auto& peer = *topology.find(link->otherEnd(ownTopologyDevice.id));
        auto made = std::make_unique<system::DistributedModule>(*this, peer, *link);
        if (auto set = registry.find(peer.id)) {
            made->setKnown(set);
            board.showSet(peer.id, std::move(set));
        }
        board.show(made->status());
        shortestSuspect = std::min(shortestSuspect, link->timing.suspect);
        modules.emplace(peer.id, std::move(made));
    }
}

DistributedSystem::State::~State() { stop(); }

Result<void> DistributedSystem::State::listen()
{
    if (auto listening = server.listen(ownTopologyDevice.host, ownTopologyDevice.port); !listening)
        return listening;
    auto listening = udpSocket.listen(server.address(), ownTopologyDevice.port, settings.marks.prompt);
    for (const int socket : {server.descriptor(), udpSocket.descriptor()})
        system::searchCard(socket, settings.realTime.cardSearch);
    return listening;
}

void DistributedSystem::State::start()
{
    if (thread.joinable() || stopped)
        return;
    auto keeper = std::make_unique<Periodic>();
    keeper->period = housekeepingPeriod;
    keeper->task = [this] { housekeeping(); };
    periodics.push_back(std::move(keeper));
    log(LogLevel::Info, "listening",
        fmt::format("{} ({}) listening on {}:{}", ownTopologyDevice.name, ownTopologyDevice.id.toString(), ownTopologyDevice.host,
                    ownTopologyDevice.port));
    if (const auto why = transport::whyUnmarked(server.address().is_v6(), {settings.marks.prompt, settings.marks.bulk}))
        log(LogLevel::Warning, "packets-unmarked", *why);
    record({.event = "start",
            .text = fmt::format("{}, topology {} {}", settings.software, topology.name(), topology.hash().toHex().substr(0, 12))});
    server.start();
    udpSocket.start();
    for (auto& periodic : periodics)
        startPeriodic(*periodic);
    offerStatus();
    thread = std::thread([this] {
        threadId = std::this_thread::get_id();
        system::runNetworkThread(context, settings.realTime, attention);
    });
}

void DistributedSystem::State::startPeriodic(Periodic& periodic)
{
    if (!periodic.timer) {
        periodic.timer = std::make_unique<transport::Timer>(context);
        periodic.due = std::chrono::steady_clock::now();
    }
    periodic.due = std::max(periodic.due + periodic.period, std::chrono::steady_clock::now());
    periodic.timer->at(periodic.due, [this, &periodic] {
        turned();
        startPeriodic(periodic);
        periodic.task();
    });
}

void DistributedSystem::State::stop()
{
    if (stopped.exchange(true))
        return;
    if (thread.joinable()) {
        asio::post(context, [this] { closeAll(); });
        thread.join();
    }
    outbox.end();
    outbox.take(letters); // nobody sends them any more
    letters.clear();
    elasticWork.stop();
    setKeeper.finish();
    statusServer.reset();
    periodics.clear();
    for (auto& [peer, one] : modules)
        one->abort();
    server.close();
    udpSocket.close();
    closingTimer.cancel();
    unlinked.clear();
    packetOwners.forget();
    modules.clear();
    // Buried objects die with the handlers that hold them.
    context.restart();
    context.poll();
    if (audit) {
        record({.event = "stop"});
        audit->close();
    }
}

/// Closes what is open, waits for that at most `closingLimit`, and ends the thread.
void DistributedSystem::State::closeAll()
{
    for (auto& [peer, one] : modules)
        (void)one->close("the application is stopping");
    endWhenClosed(std::chrono::steady_clock::now() + closingLimit);
}

void DistributedSystem::State::endWhenClosed(std::chrono::steady_clock::time_point limit)
{
    if (!allClosed() && std::chrono::steady_clock::now() < limit)
        return closingTimer.after(5ms, [this, limit] { endWhenClosed(limit); });
    // What a closing dialogue wrote last may still be on its way to the kernel.
    closingTimer.after(20ms, [this] { context.stop(); });
}

bool DistributedSystem::State::allClosed() const
{
    return std::all_of(modules.begin(), modules.end(), [](const auto& entry) {
        return entry.second->state() == SessionState::Closed || entry.second->state() == SessionState::StandBy;
    });
}

system::DistributedModule* DistributedSystem::State::module(DeviceId peer) const
{
    const auto found = modules.find(peer);
    return found != modules.end() ? found->second.get() : nullptr;
}

std::uint64_t DistributedSystem::State::freshToken() { return security::randomToken(); }

bool DistributedSystem::State::isTokenUsed(DeviceId asking, std::uint64_t token) const
{
    return ledger.knows(token, now()) || std::any_of(modules.begin(), modules.end(),
                                                     [&](const auto& entry) { return entry.first != asking && entry.second->owns(token); });
}

void DistributedSystem::State::turned()
{
    const auto gap = stallWatch.turn(bootNow());
    if (handlingStall || gap < shortestSuspect)
        return;
    if (std::none_of(modules.begin(), modules.end(), [&](const auto& entry) { return entry.second->isConcernedBy(gap); }))
        return;
    handlingStall = true;
    SessionEvent event;
    event.kind = SessionEvent::Kind::LocalStall;
    event.at = std::chrono::steady_clock::now();
    event.duration = gap;
    log(LogLevel::Error, "local-stall",
        fmt::format("this process did not run for {} ms", std::chrono::duration_cast<std::chrono::milliseconds>(gap).count()));
    tell(std::move(event));
    for (auto& [peer, one] : modules)
        one->stalled(gap);
    withdrawOutbox(gap);
    handlingStall = false;
}

void DistributedSystem::State::housekeeping()
{
    watchAudit();
    const auto now = std::chrono::steady_clock::now();
    if (!elasticWork.balance(now))
        log(LogLevel::Warning, "threads-missing",
            "the system has no thread left for the work on images, which the network thread does itself; raise the limit of threads of "
            "this program (TasksMax, pids.max, ulimit -u)");
    takeReturned();
    partialBudget.trim(now);
    for (auto& [peer, one] : modules)
        one->housekeeping();
}

void DistributedSystem::State::attached(transport::AttachedConnection connection)
{
    if (stopped)
        return connection.channel->close();
    turned();
    if (auto* one = module(connection.peer))
        return one->attached(std::move(connection));
    rejectUnlinked(std::move(connection));
}

void DistributedSystem::State::packetHeard(std::span<std::byte> packet)
{
    if (stopped)
        return;
    turned();
    const auto prefix = protocol::decodePacketPrefix(packet);
    if (!prefix)
        return;
    // A packet of a session that just ended, or a stranger's: nothing can be said of it, and nobody is told.
    if (auto* owner = packetOwners.find(prefix->token, modules))
        owner->packetHeard(packet);
}

void DistributedSystem::State::rejectUnlinked(transport::AttachedConnection connection)
{
    const auto* device = topology.find(connection.peer);
    const auto why = device == nullptr ? "it is not in the topology" : "the topology has no link to it";
    identityRefused(connection.peer, why, fmt::format("{} asked for a session, and {}", connection.peer.toString(), why));
    if (device == nullptr || device->id == ownTopologyDevice.id)
        return connection.channel->close(); // to a stranger nothing is said
    const auto token = connection.attach.token;
    auto& courier = unlinked.try_emplace(device->id, *this, *device).first->second;
    auto fresh = std::make_unique<system::FreshConnection>(context, std::move(connection), ownTopologyDevice.id, partialBudget,
                                                           system::FreshConnection::Handlers{[] {}, [](const auto&) {}, [] {}});
    courier.send(
        std::move(fresh), system::encodeSession(*this, protocol::Attach{protocol::protocolVersion, token, 0}, device->id),
        system::encodeSession(
            *this, protocol::Rejected{token, RejectReason::NoLink, {"this device's topology has no link between the two"}}, device->id));
}

/// What a person has accepted stands above the register, and that above what was met first (ruling B14).
session::SetStanding DistributedSystem::State::standingOf(DeviceId peer, const Sha256& set)
{
    using session::SetStanding;
    const auto pin = store ? store->pinFor(peer.deviceType()) : Result<std::optional<LocalStore::Pin>>(std::nullopt);
    if (!pin) {
        log(LogLevel::Error, "set-refused", "no message set is accepted: " + pin.error().what);
        return SetStanding::Changed;
    }
    const auto known = registry.find(peer);
    const bool accepted = pin.value() && pin.value()->accepted;
    if (accepted ? pin.value()->hash != set : known ? known->hash() != set : pin.value() && pin.value()->hash != set)
        return SetStanding::Changed;
    return setOf(peer, set) ? SetStanding::Held : SetStanding::Unknown;
}

std::shared_ptr<const MessageSet> DistributedSystem::State::setOf(DeviceId peer, const Sha256& set)
{
    auto known = registry.find(peer);
    if ((!known || known->hash() != set) && store) {
        const auto learnt = store->find(set);
        known = learnt ? learnt.value() : nullptr;
    }
    if (!known || known->hash() != set || known->deviceType() != peer.deviceType())
        return nullptr;
    if (auto* one = module(peer))
        one->setKnown(known);
    board.showSet(peer, known);
    return known;
}

void DistributedSystem::State::learn(DeviceId peer, const Sha256& set, std::vector<std::byte> xml)
{
    // The module may be gone, or in another attempt, when the disk is done.
    const auto token = module(peer)->token();
    setKeeper.learn(peer, set, std::move(xml), [this, peer, set, token](const session::SetHeard& heard) {
        if (auto* one = module(peer))
            one->setLearnt(token, set, heard);
    });
}

Result<void> DistributedSystem::State::admitSession(bool reopening)
{
    // A procedure that runs must be able to go on: a lost channel is re-opened also without the file, and everybody was told.
    if (auditLost && !reopening)
        return fail(Errc::FileUnwritable,
                    fmt::format("{} writes no audit file at present, so it opens no new session; see its log", ownTopologyDevice.name));
    return tlsIdentity ? tlsIdentity->trust().admitSession() : ok();
}

} // namespace liena
