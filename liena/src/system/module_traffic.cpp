// What a module sends for the application and of incidents, and the figures of its link.
#include "protocol/byte_writer.hpp"
#include "protocol/message_access.hpp"
#include "system/distributed_module.hpp"

#include <boost/asio/post.hpp>
#include <fmt/format.h>

namespace liena::system {

namespace {

/// More than a whole system in stand-by has to tell at once: 256 incidents, both ends' causes and the holds of 64 devices, nearly twice.
constexpr std::size_t mostIncidentNews = 32768;

} // namespace

Result<void> DistributedModule::checkSendable(const Message& message) const
{
    const auto& definition = message.definition();
    const auto state = m_machine.state();
    if (!m_link.carries(definition.name, m_host.ownDevice().id))
        return fail(Errc::Forbidden, fmt::format("{} may not flow to {}: the topology's link says what may", definition.name, m_peer.name));
    if (!definition.allowedInStandBy && m_host.standsBy())
        return fail(Errc::StandBy, fmt::format("{} is refused while the system stands by", definition.name));
    const bool control = definition.priority == Priority::Control;
    if (!carriesMessages(state) && (control || state != SessionState::Reconnecting))
        return fail(Errc::NotOpen, fmt::format("the session with {} is {}", m_peer.name, toString(state)));
    if (control && !m_machine.stamper().ready())
        return fail(Errc::NotYet, fmt::format("no heartbeat of {} was heard in this session yet", m_peer.name));
    return ok();
}

Result<void> DistributedModule::send(Message&& message)
{
    if (auto allowed = checkSendable(message); !allowed)
        return allowed;
    const auto now = m_host.now(); // reading the clocks is a good part of what a small message costs
    const auto& definition = message.definition();
    if (definition.priority != Priority::Status)
        m_usedSince = true;
    tasks::OutputQueue::Entry entry{
        {}, tasks::rankOf(definition.priority), definition.history, std::nullopt, definition.name, MessageAccess::takeSet(message)};
    auto& encoded = entry.message;
    encoded.header.message = {m_host.ownDevice().id, definition.number};
    encoded.header.target = m_peer.id;
    encoded.header.timestamp = m_host.stamp(now);
    if (definition.priority == Priority::Control) {
        const auto fields = message.fieldBytes();
        const auto record = m_machine.stamper().next(encoded.header, fields);
        if (!record) {
            handle(session::ViolationFound{"the sequence numbers of a control message are used up"});
            return fail(Errc::NotOpen, fmt::format("the sequence numbers of {} are used up", definition.name));
        }
        const auto bytes = protocol::encodeSafetyRecord(*record);
        protocol::ByteWriter(encoded.part).append(std::span<const std::byte>(bytes)).append(fields);
    } else {
        encoded.part = MessageAccess::takeFields(message);
        encoded.lent = MessageAccess::takeLent(message);
    }
    if (definition.path == Path::Datagram && m_machine.datagramsHeardByPeer() > 0 && m_datagrams.send(encoded, now.mono)) {
        m_books.sentInPacket(encoded.part.size());
        return ok();
    }
    if (definition.lifespan)
        entry.expires = now.mono + *definition.lifespan;
    const bool taken = definition.priority == Priority::Bulk ? m_bulk.push(std::move(entry)) : m_laneZero.push(std::move(entry));
    if (!taken)
        return fail(Errc::QueueFull, fmt::format("too much waits for {} already: {} is refused", m_peer.name, definition.name));
    m_books.sent();
    return ok();
}

void DistributedModule::notSent(const tasks::OutputQueue::Entry& entry, tasks::OutputQueue::Fate fate)
{
    if (entry.name.empty())
        return;
    if (fate == tasks::OutputQueue::Fate::Superseded)
        return m_books.superseded(entry.rank == tasks::Rank::Bulk);
    auto event = this->event(SessionEvent::Kind::SendFailed);
    event.message = entry.name;
    event.count = 1;
    event.detail = fate == tasks::OutputQueue::Fate::Expired ? "its lifespan ended before it could leave"
                                                             : "the session was interrupted before it left";
    // A handler may send, and this is told in the midst of a queue's own work.
    boost::asio::post(m_host.io(), [&host = m_host, event = std::move(event)]() mutable { host.tell(std::move(event)); });
}

void DistributedModule::sendSession(const protocol::SessionMessage& message, DeviceId target)
{
    const auto rank = target.isBroadcast() ? tasks::Rank::Incident : tasks::Rank::Safety;
    if (rank == tasks::Rank::Incident && m_laneZero.queue().waiting(rank) >= mostIncidentNews) {
        m_greetingDue = true;
        return;
    }
    m_laneZero.push({encode(message, target), rank, 0, std::nullopt, {}});
}

/// The peer reads again: it hears what is held here. What is over it hears when it asks.
void DistributedModule::greetAnew()
{
    if (!m_greetingDue || !carriesMessages(m_machine.state()) || m_laneZero.queue().waiting(tasks::Rank::Incident) > 0)
        return;
    m_greetingDue = false;
    m_host.greet(m_peer.id);
}

std::size_t DistributedModule::backlog() const
{
    auto bytes = m_incoming ? m_incoming->backlog() : std::size_t{0};
    for (const auto& [lane, task] : m_incomingBulk)
        bytes += task->backlog();
    return bytes;
}

LinkStatus DistributedModule::status() const
{
    LinkStatus status;
    const auto& monitor = m_machine.monitor();
    status.peer = m_peer.id;
    status.state = m_machine.state();
    status.peerState = monitor.peerState();
    if (monitor.lastHeard() != session::Instant{})
        status.lastHeard = monitor.lastHeard();
    status.roundTrip = m_machine.clock().lastDelay();
    status.jitter = m_machine.jitter();
    status.clockOffset = m_machine.clock().offset();
    status.clockUncertainty = m_machine.clock().uncertainty();
    status.heartbeatsOnTime = monitor.onTimeRun();
    status.heartbeatsReceived = monitor.received();
    status.heartbeatsMissed = monitor.missed();
    status.messagesSent = m_books.messagesSent();
    status.messagesReceived = m_books.messagesReceived();
    status.messagesDropped = m_books.messagesDropped();
    status.bytesSent = m_laneZero.bytesSent() + m_bulk.bytesSent() + m_datagrams.bytesSent();
    status.bytesReceived = m_bytesReceived + m_datagrams.bytesReceived() + (m_incoming ? m_incoming->bytesReceived() : 0);
    status.messagesSuperseded = m_books.messagesSuperseded();
    status.bulkSuperseded = m_books.bulkSuperseded();
    status.messagesAbandoned = m_abandoned + (m_incoming ? m_incoming->abandoned() : 0);
    for (const auto& [lane, task] : m_incomingBulk) {
        status.bytesReceived += task->bytesReceived();
        status.messagesAbandoned += task->abandoned();
    }
    status.queuedMessages = static_cast<std::uint32_t>(m_laneZero.queue().size() + m_bulk.queuedMessages());
    status.bulkQueuedBytes = m_bulk.queuedBytes();
    const auto now = m_host.now().mono;
    if (const auto known = m_bulk.knownRate(now)) {
        status.bulkRate = known->bytesPerSecond;
        status.bulkRateAge = now - known->shown;
    }
    status.bulkStreams = m_bulk.streamRates(now);
    status.bulkLanes = static_cast<std::uint8_t>(m_bulk.connected());
    status.bulkLanesIn = static_cast<std::uint8_t>(m_incomingBulk.size());
    status.bulkWorkers = static_cast<std::uint8_t>(m_host.workers().count());
    status.epoch = m_machine.guard().epoch();
    status.peerEpoch = m_machine.stamper().targetEpoch();
    status.interruptions = m_interruptions;
    status.packetsHeard = monitor.packetsHeard(now);
    status.packetsHeardByPeer = m_machine.datagramsHeardByPeer();
    status.toPeerConnected = m_machine.isOutgoingUp();
    status.fromPeerConnected = m_machine.isIncomingUp();
    status.localAddress = m_laneZero.way().local;
    status.remoteAddress = m_laneZero.way().remote;
    status.incident = m_machine.incident();
    status.latency = carriesMessages(status.state) ? m_latency : std::nullopt;
    return status;
}

} // namespace liena::system
