// Dialogues and lanes of one peer.
#include "system/distributed_module.hpp"

#include <boost/asio/post.hpp>

#include <fmt/format.h>

#include <utility>

namespace liena::system {

using namespace std::chrono_literals;
using session::SessionMachine;

namespace {

constexpr auto probeLimit = 1s;

session::SessionSettings settingsOf(ModuleHost& host, const TopologyDevice& peer, const TopologyLink& link)
{
    return {host.ownDevice().id, peer.id, link.timing, host.topologyHash(), host.ownSet()->hash(), host.software()};
}

} // namespace

DistributedModule::DistributedModule(ModuleHost& host, TopologyDevice peer, TopologyLink link)
    : m_host(host),
      m_peer(std::move(peer)),
      m_link(std::move(link)),
      m_machine(settingsOf(host, m_peer, m_link)),
      m_ends{m_peer.id, host.ownDevice().id, host.ownSet().get(), nullptr},
      m_laneZero(host.io(), m_peer, host.identity(), {8192, 32768, transport::TcpChannel::Traffic::Prompt, host.marks().prompt},
                 {[this] { laneZeroUp(); },
                  [this](const transport::ConnectionFailure& failure) {
                      handle(session::OutgoingFailed{failure.probe, failure.detail});
                  },
                  [this](const std::string& detail, bool identity) {
                      handle(session::OutgoingLost{identity ? ProbeResult::TlsFailure : ProbeResult::NotProbed, detail});
                  },
                  [this](const tasks::OutputQueue::Entry& entry, tasks::OutputQueue::Fate fate) { notSent(entry, fate); },
                  [this](const protocol::DatagramHeader& begun) { return abandon(begun); },
                  [this](transport::TcpChannel& channel) { return admit(channel); }}),
      m_bulk(host.io(), m_peer, host.identity(), host.marks().bulk, {host.workers(), host.interfaces()},
             {[this](std::uint8_t lane) {
                  return encode(protocol::Attach{protocol::protocolVersion, m_machine.token(), lane}, m_peer.id);
              },
              [this] { return carriesMessages(m_machine.state()); },
              [this](std::uint8_t lane, const std::string& detail) { bulkLaneLost(lane, detail); },
              [this](const tasks::OutputQueue::Entry& entry, tasks::OutputQueue::Fate fate) { notSent(entry, fate); },
              [this](const protocol::DatagramHeader& begun) { return abandon(begun); }, [this] { return m_laneZero.addresses(); }}),
      m_datagrams(host.packets(), m_peer.port, host.identity() != nullptr),
      m_couriers(host, m_peer),
      m_timer(host.io()),
      m_measurement(host, m_peer.name, measuringWays())
{}

Result<void> DistributedModule::open()
{
    switch (m_machine.state()) {
    case SessionState::Closed:
        break;
    case SessionState::StandBy:
        return fail(Errc::StandBy, fmt::format("the link to {} is in stand-by: a person has to re-open it", m_peer.name));
    default:
        return fail(Errc::Busy, fmt::format("the session with {} is {} already", m_peer.name, toString(m_machine.state())));
    }
    if (auto admitted = m_host.admitSession(false); !admitted)
        return notAdmitted(std::move(admitted));
    handle(session::OpenRequested{m_host.freshToken()});
    return ok();
}

Result<void> DistributedModule::reopen(IncidentId seen)
{
    if (m_machine.state() != SessionState::StandBy)
        return fail(Errc::NoIncident,
                    fmt::format("the session with {} is {}, there is nothing to re-open", m_peer.name, toString(m_machine.state())));
    if (auto admitted = m_host.admitSession(true); !admitted)
        return notAdmitted(std::move(admitted));
    handle(session::ReopenRequested{m_host.freshToken(), seen});
    return ok();
}

Result<void> DistributedModule::notAdmitted(Result<void> why)
{
    openFailed({RejectReason::NotAdmitted, ProbeResult::NotProbed, why.error().what});
    return why;
}

/// Certificates are asked when a session begins; one that is only interrupted heals with what it began with.
Result<void> DistributedModule::admit(transport::TcpChannel& channel) const
{
    const bool begins = m_machine.state() == SessionState::Opening || m_machine.state() == SessionState::Reopening;
    const auto identity = m_host.identity();
    return begins && identity ? channel.admitSession(*identity) : ok();
}

Result<void> DistributedModule::close(std::string_view reason)
{
    if (m_machine.state() == SessionState::Closed || m_machine.state() == SessionState::StandBy ||
        m_machine.state() == SessionState::Closing)
        return fail(Errc::NotOpen, fmt::format("the session with {} is {}", m_peer.name, toString(m_machine.state())));
    handle(session::CloseRequested{std::string(reason)});
    return ok();
}

void DistributedModule::revoke() { perform(m_machine.revoke(m_host.now())); }

void DistributedModule::stalled(session::Nanoseconds gap)
{
    if (gap >= m_link.timing.suspect)
        handle(session::Stalled{gap});
}

void DistributedModule::setIncident(IncidentId incident, IncidentId ended)
{
    if (incident != 0)
        handle(session::IncidentHeld{incident, ended});
    else
        handle(session::IncidentGone{});
}

void DistributedModule::setIncidentCount(std::size_t count)
{
    m_machine.setIncidents(static_cast<std::uint16_t>(std::min<std::size_t>(count, 0xFFFF)));
}

void DistributedModule::handle(const session::SessionInput& input)
{
    perform(m_machine.handle(input, m_host.now()));
    armTimer();
}

void DistributedModule::perform(session::SessionActions actions)
{
    for (auto& action : actions)
        perform(action);
}

void DistributedModule::perform(session::SessionAction& action)
{
    struct Doer {
        DistributedModule& module;
        void operator()(const session::ConnectLaneZero&) { module.connectLaneZero(); }
        void operator()(const session::CloseLanes& close) { module.closeLanes(close.grace); }
        void operator()(const session::Adopt& adopt) { module.adopt(adopt.connection); }
        void operator()(const session::Refuse& refuse) { module.refuse(refuse); }
        void operator()(const session::Ignore& ignore)
        {
            if (const auto fresh = module.m_fresh.find(ignore.connection); fresh != module.m_fresh.end())
                fresh->second->ignore();
        }
        void operator()(const session::Send& send)
        {
            if (const auto* heartbeat = std::get_if<protocol::Heartbeat>(&send.message))
                return module.sendHeartbeat(*heartbeat);
            const auto rank = send.afterOutput ? tasks::Rank::Last : tasks::Rank::Safety;
            module.m_laneZero.push({module.encode(send.message, module.m_peer.id), rank, 0, std::nullopt, {}});
        }
        void operator()(const session::SendOwnSet&)
        {
            const auto& set = *module.m_host.ownSet();
            const auto bytes = std::as_bytes(std::span(set.xml().data(), set.xml().size()));
            module.sendSession(protocol::MessageSetAnswer{set.hash(), {bytes.begin(), bytes.end()}}, module.m_peer.id);
        }
        void operator()(const session::DiscardControl&) { module.m_laneZero.queue().discard(tasks::Rank::Control); }
        void operator()(const session::DiscardAll&)
        {
            module.m_laneZero.discardApplication();
            module.m_bulk.discardApplication();
        }
        void operator()(const session::Entered& change) { module.entered(change); }
        void operator()(const session::SessionOpened& opened) { module.opened(opened); }
        void operator()(const session::OpenFailed& failed) { module.openFailed(failed); }
        void operator()(const session::SessionClosed& closed)
        {
            auto event = module.event(SessionEvent::Kind::Closed);
            event.detail = closed.byPeer ? "by the peer: " + printable(closed.detail) : closed.detail;
            module.m_host.tell(std::move(event));
        }
        void operator()(const session::SessionInterrupted& interrupted)
        {
            ++module.m_interruptions;
            module.m_bulk.reportMissed(); // those that came meanwhile were passed over
            module.m_host.greet(module.m_peer.id);
            auto event = module.event(SessionEvent::Kind::Interrupted);
            event.duration = interrupted.duration;
            module.m_host.tell(std::move(event));
        }
        void operator()(const session::SessionLost& lost) { module.lost(lost); }
    };
    std::visit(Doer{*this}, action);
}

protocol::EncodedMessage DistributedModule::encode(const protocol::SessionMessage& message, DeviceId target)
{
    return encodeSession(m_host, message, target);
}

protocol::EncodedMessage DistributedModule::abandon(const protocol::DatagramHeader& begun)
{
    return encode(protocol::Abandon{begun.message.number, begun.timestamp.ns}, m_peer.id);
}

/// The same bytes on both ways; whichever arrives first counts.
void DistributedModule::sendHeartbeat(const protocol::Heartbeat& heartbeat)
{
    auto encoded = encode(heartbeat, m_peer.id);
    m_datagrams.send(encoded, m_host.now().mono);
    m_laneZero.push({std::move(encoded), tasks::Rank::Safety, 1, std::nullopt, {}});
}

void DistributedModule::entered(const session::Entered& change)
{
    auto event = this->event(SessionEvent::Kind::StateChanged);
    event.from = change.from;
    event.to = change.to;
    // Attempts that are made again and again say only how they end.
    const bool attempt = change.to == SessionState::Opening || (change.from == SessionState::Opening && change.to == SessionState::Closed);
    say(attempt ? LogLevel::Debug : LogLevel::Info, "session-state",
        fmt::format("session with {}: {} -> {}", m_peer.name, toString(change.from), toString(change.to)));
    showStatus();
    m_host.tell(std::move(event));
    if (!carriesMessages(change.to))
        m_measurement.sessionEnded();
    if (change.to != SessionState::Open)
        return;
    // Each in a turn of its own: what a lane brings may end the session, and with it the lanes.
    for (const auto& entry : m_incomingBulk)
        boost::asio::post(m_host.io(), [this, alive = std::weak_ptr(m_alive), lane = entry.first, task = entry.second.get()] {
            if (alive.expired())
                return;
            const auto found = m_incomingBulk.find(lane);
            if (found != m_incomingBulk.end() && found->second.get() == task)
                task->start();
        });
    m_bulk.connect();
}

void DistributedModule::opened(const session::SessionOpened& opened)
{
    m_failures.forget();
    m_refusals.forget();
    m_deadlines.reset();
    m_newest.clear();
    m_greetingDue = false; // by what comes now
    m_books.beginWindow(m_host.now().mono);
    auto event = this->event(opened.reopened ? SessionEvent::Kind::ReOpened : SessionEvent::Kind::Opened);
    event.duration = opened.duration;
    event.incident.id = opened.incident;
    m_host.sessionOpened(m_peer.id, opened);
    m_host.tell(std::move(event));
}

void DistributedModule::openFailed(const session::OpenFailed& failed)
{
    auto event = this->event(SessionEvent::Kind::OpenFailed);
    event.reason = failed.reason;
    event.diagnosis.probe = failed.probe;
    event.diagnosis.probeDetail = printable(failed.detail, 512);
    const auto why = failed.reason != RejectReason::None      ? explain(failed.reason)
                     : failed.probe != ProbeResult::NotProbed ? explain(failed.probe)
                                                              : std::string_view();
    event.detail = fmt::format("{}{}{}", printable(failed.detail, 512), why.empty() || failed.detail.empty() ? "" : ". ", why);
    if (const auto count = m_failures.count(event.detail, 0, m_host.now().mono))
        say(LogLevel::Warning, "open-failed", fmt::format("no session with {}: {}{}", m_peer.name, event.detail, base::timesText(*count)));
    m_host.tell(std::move(event));
}

void DistributedModule::lost(const session::SessionLost& lost)
{
    auto event = this->event(SessionEvent::Kind::Lost);
    event.diagnosis = lost.diagnosis;
    event.diagnosis.detail = printable(lost.diagnosis.detail, 256);
    say(LogLevel::Error, "session-lost",
        fmt::format("session with {} lost: {}: {}", m_peer.name, toString(lost.diagnosis.cause), event.diagnosis.detail));
    event.incident.id = lost.incident;
    event.incident.cause = lost.diagnosis.cause;
    event.incident.since = lost.diagnosis.since;
    std::tie(event.incident.a, event.incident.b) = std::minmax(m_host.ownDevice().id, m_peer.id);
    m_loss = {lost.incident, event.diagnosis};
    m_host.sessionLost(m_peer.id, lost, std::move(event));
    probe();
}

void DistributedModule::probe()
{
    if (m_probe)
        m_probe->cancel();
    bury(std::move(m_probe));
    m_probe = std::make_unique<transport::TcpClient>(
        m_host.io(), m_peer, m_host.identity(), probeLimit, [this](transport::TcpClient::Outcome outcome) {
            bury(std::move(m_probe));
            auto event = this->event(SessionEvent::Kind::Diagnosed);
            event.incident.id = m_machine.incident();
            if (event.incident.id != 0 && event.incident.id == m_loss.incident) // whoever asked for it
                event.diagnosis = m_loss.diagnosis;
            if (auto* channel = std::get_if<std::shared_ptr<transport::TcpChannel>>(&outcome)) {
                (*channel)->close();
                event.diagnosis.probe = ProbeResult::Reachable;
            } else {
                const auto& failure = std::get<transport::ConnectionFailure>(outcome);
                event.diagnosis.probe = failure.probe;
                event.diagnosis.probeDetail = printable(failure.detail, 256);
            }
            say(LogLevel::Info, "probe", fmt::format("probe of {}: {}", m_peer.name, toString(event.diagnosis.probe)));
            m_host.tell(std::move(event));
        });
}

void DistributedModule::armTimer()
{
    const auto deadline = m_machine.nextDeadline();
    // A timer that is due earlier than needed ticks harmlessly; moving it for every datagram would cost more.
    if (!deadline || (m_armed && *m_armed <= *deadline))
        return;
    m_armed = deadline;
    m_timer.at(*deadline, [this] {
        m_armed.reset();
        m_host.turned();
        handle(session::Tick{});
    });
}

void DistributedModule::housekeeping()
{
    const auto now = m_host.now().mono;
    checkDeadlines(now);
    greetAnew();
    if (carriesMessages(m_machine.state()) && now >= m_nextReport)
        sendReport(now);
    if (now >= m_nextDrops) {
        m_nextDrops = now + 1s;
        showDrops();
    }
    if (std::exchange(m_usedSince, false))
        m_lastUse = now;
    m_measurement.housekeeping();
    m_bulk.retire(now);
    showStatus();
}

/// Not while the one before it waits: a peer that does not read must not fill our memory, and what a report that was left out had counted
/// would be a queue to the peer. The window goes on instead.
void DistributedModule::sendReport(session::Instant now)
{
    if (m_laneZero.queue().waits(tasks::Rank::Safety, protocol::LinkReport::number))
        return;
    m_nextReport = now + reportPeriod(m_link.timing.heartbeat);
    const auto report = m_books.takeReport(now, backlog());
    m_latency = report.oneWayNs > 0 ? std::optional(std::chrono::nanoseconds(report.oneWayNs)) : std::nullopt;
    sendSession(report, m_peer.id);
}

/// A session that is over owes nothing more; one that is interrupted does.
void DistributedModule::checkDeadlines(session::Instant now)
{
    if (!carriesMessages(m_machine.state()) && m_machine.state() != SessionState::Reconnecting)
        return;
    m_deadlines.check(now, [this](std::uint16_t, const std::string& name) {
        auto event = this->event(SessionEvent::Kind::DeadlineMissed);
        event.message = name;
        m_host.tell(std::move(event));
    });
}

void DistributedModule::showDrops()
{
    std::vector<DropCount> drops;
    m_books.forEachDrop([&](const std::string& cause, std::uint32_t number, std::uint64_t count) {
        const auto* definition = definitionOf(static_cast<std::uint16_t>(number));
        drops.push_back({cause, definition != nullptr ? definition->name : "", count});
    });
    m_host.showDrops(m_peer.id, std::move(drops));
}

void DistributedModule::showStatus() { m_host.show(status()); }

void DistributedModule::abort()
{
    m_timer.cancel();
    closeLanes(0ns);
    m_couriers.clear();
    while (!m_fresh.empty())
        endFresh(m_fresh.begin()->first);
    if (m_probe)
        m_probe->cancel();
}

SessionEvent DistributedModule::event(SessionEvent::Kind kind) const
{
    SessionEvent event;
    event.kind = kind;
    event.at = m_host.now().mono;
    event.peer = m_peer.id;
    event.from = event.to = m_machine.state();
    return event;
}

void DistributedModule::say(LogLevel level, std::string_view event, const std::string& text) const
{
    m_host.log(LogLine{level, text, event, m_peer.name});
}

} // namespace liena::system
