// The lanes of one peer: connecting ours, taking in theirs, and the connections whose handshake is still to come.
#include "system/distributed_module.hpp"
#include "system/reconnect_limit.hpp"

#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>

#include <fmt/format.h>

#include <utility>

namespace liena::system {

using namespace std::chrono_literals;

namespace {

constexpr auto connectLimit = 1s;

} // namespace

/// In a session it goes where it went, or where its host was besides: whoever answers there shows who it is, and a name server that is
/// slow, or cut off together with the peer, would take longer than the session has.
void DistributedModule::connectLaneZero()
{
    const bool dialogue = m_machine.state() == SessionState::Opening || m_machine.state() == SessionState::Reopening;
    m_laneZero.connect(encode(protocol::Attach{protocol::protocolVersion, m_machine.token(), 0}, m_peer.id),
                       dialogue ? connectLimit : reconnectLimit(m_machine.clock().lastDelay()),
                       dialogue ? std::vector<boost::asio::ip::address>() : m_laneZero.addresses());
}

void DistributedModule::laneZeroUp()
{
    const auto& lane = *m_laneZero.channel();
    const auto token = m_machine.token();
    m_datagrams.outgoingUp(token, lane.datagramKey(token), lane.remote().address(), m_host.now().mono);
    handle(session::OutgoingUp{});
}

/// No event of the session: the lane is connected again when there is bulk to send.
void DistributedModule::bulkLaneLost(std::uint8_t lane, const std::string& detail)
{
    say(LogLevel::Warning, "bulk-lane-lost",
        fmt::format("bulk lane {} to {} broke: {}; what was under way on it may be missing there", lane, m_peer.name,
                    printable(detail, 256)));
}

void DistributedModule::closeLanes(session::Nanoseconds grace)
{
    m_laneZero.close(grace);
    m_bulk.close();
    m_datagrams.end();
    std::vector<std::shared_ptr<tasks::ReceptionTask>> ended;
    if (m_incoming)
        ended.push_back(std::move(m_incoming));
    for (auto& [lane, task] : m_incomingBulk)
        ended.push_back(std::move(task));
    m_incomingBulk.clear();
    for (auto& task : ended) {
        if (grace <= 0ns)
            task->close();
        settle(*task);
        if (grace <= 0ns) {
            bury(task);
            continue;
        }
        task->orphan();
        auto timer = std::make_shared<boost::asio::steady_timer>(m_host.io(), grace);
        timer->async_wait([timer, task](const boost::system::error_code&) {});
    }
}

void DistributedModule::adopt(session::ConnectionNumber number)
{
    const auto fresh = m_fresh.find(number);
    if (fresh == m_fresh.end())
        return;
    m_incoming = fresh->second->release();
    m_incoming->setSink(*this);
    m_datagrams.incomingUp(m_machine.token(), m_incoming->channel().datagramKey(m_machine.token()), m_host.now().mono);
    bury(std::move(fresh->second));
    m_fresh.erase(fresh);
    boost::asio::post(m_host.io(), [this, alive = std::weak_ptr(m_alive), task = m_incoming.get()] {
        if (!alive.expired() && m_incoming.get() == task)
            task->start();
    });
}

void DistributedModule::refuse(const session::Refuse& refusal)
{
    const auto fresh = m_fresh.find(refusal.connection);
    if (fresh == m_fresh.end())
        return;
    const auto why = fmt::format("{}: {}", toString(refusal.reason), refusal.detail);
    if (const auto count = m_refusals.count(why, 0, m_host.now().mono)) {
        const auto told = why + base::timesText(*count);
        say(LogLevel::Warning, "session-refused", fmt::format("refused a session with {}: {}", m_peer.name, told));
        m_host.record({.event = "session-refused", .peer = m_peer.name, .text = told});
    }
    m_couriers.send(std::move(fresh->second), encode(protocol::Attach{protocol::protocolVersion, refusal.token, 0}, m_peer.id),
                    encode(protocol::Rejected{refusal.token, refusal.reason, {refusal.detail}}, m_peer.id));
    m_fresh.erase(fresh);
}

void DistributedModule::attached(transport::AttachedConnection connection)
{
    const auto state = m_machine.state();
    const bool inSession = state != SessionState::Closed && state != SessionState::StandBy && connection.attach.token == m_machine.token();
    if (connection.attach.protocol != protocol::protocolVersion) {
        if (const auto count = m_refusals.count("protocol version", 0, m_host.now().mono))
            say(LogLevel::Warning, "session-refused",
                fmt::format("{} speaks version {} of the protocol, this device version {}{}", m_peer.name, connection.attach.protocol,
                            protocol::protocolVersion, base::timesText(*count)));
        const auto token = connection.attach.token;
        auto fresh = std::make_unique<FreshConnection>(m_host.io(), std::move(connection), m_host.ownDevice().id, m_host.budget(),
                                                       FreshConnection::Handlers{[] {}, [](const auto&) {}, [] {}});
        m_couriers.send(std::move(fresh), encode(protocol::Attach{protocol::protocolVersion, token, 0}, m_peer.id),
                        encode(protocol::Rejected{token, RejectReason::ProtocolVersion, {"version 1 is spoken here"}}, m_peer.id));
        return;
    }
    // Nothing but acknowledgements leaves on it; a queue of images the other way must not hold those of commands up.
    connection.channel->mark(connection.attach.lane > 0 ? m_host.marks().bulk : m_host.marks().prompt);
    if (connection.attach.lane > 0)
        return inSession && m_incoming ? admitBulk(std::move(connection)) : connection.channel->close();
    if (!inSession)
        return admitFresh(std::move(connection));
    if (m_incoming) {
        m_incoming->close();
        settle(*m_incoming);
        bury(std::move(m_incoming));
    }
    m_bulk.reportMissed(); // what was not read of the one before is gone
    m_incoming = std::make_unique<tasks::ReceptionTask>(std::move(connection.channel), std::move(connection.decoder), m_host.budget(),
                                                        std::uint8_t{0}, *this);
    auto* task = m_incoming.get();
    m_datagrams.incomingUp(m_machine.token(), task->channel().datagramKey(m_machine.token()), m_host.now().mono);
    handle(session::IncomingUp{});
    if (m_incoming.get() == task)
        task->start();
}

void DistributedModule::admitFresh(transport::AttachedConnection connection)
{
    constexpr std::size_t mostFresh = 4;
    if (m_fresh.size() >= mostFresh)
        endFresh(m_fresh.begin()->first);
    const auto number = ++m_nextConnection;
    const auto identity = m_host.identity();
    auto certificates = identity ? connection.channel->admitSession(*identity) : ok();
    auto fresh = std::make_unique<FreshConnection>(
        m_host.io(), std::move(connection), m_host.ownDevice().id, m_host.budget(),
        FreshConnection::Handlers{[this] { m_host.turned(); },
                                  [this, number, certificates = std::move(certificates)](const protocol::SessionMessage& message) {
                                      handshakeHeard(number, message, certificates);
                                  },
                                  [this, number] { endFresh(number); }});
    auto* raw = fresh.get();
    m_fresh.emplace(number, std::move(fresh));
    raw->start();
}

void DistributedModule::endFresh(session::ConnectionNumber number)
{
    const auto fresh = m_fresh.find(number);
    if (fresh == m_fresh.end())
        return;
    fresh->second->close();
    bury(std::move(fresh->second));
    m_fresh.erase(fresh);
}

void DistributedModule::handshakeHeard(session::ConnectionNumber number, const protocol::SessionMessage& message,
                                       const Result<void>& certificates)
{
    session::HandshakeHeard input;
    input.connection = number;
    if (const auto* plain = std::get_if<protocol::Handshake>(&message)) {
        input.handshake = *plain;
    } else {
        const auto& diagnosis = std::get<protocol::DiagnosisHandshake>(message);
        input.handshake = diagnosis.handshake;
        input.diagnosis = true;
        input.previous = diagnosis.previous;
    }
    // Packets and incidents are told apart by their tokens, and those are no secret: a peer could take another session's.
    if (m_host.isTokenUsed(m_peer.id, input.handshake.token)) {
        drop("a handshake whose token is in use, or was", protocol::Handshake::number);
        return endFresh(number);
    }
    const auto admitted = certificates ? m_host.admitSession(input.diagnosis) : certificates;
    if (!admitted)
        input.notAdmitted = admitted.error().what;
    input.standing = m_host.standingOf(m_peer.id, input.handshake.set);
    if (input.standing == session::SetStanding::Held)
        hearFrom(m_host.setOf(m_peer.id, input.handshake.set));
    handle(input);
}

void DistributedModule::admitBulk(transport::AttachedConnection connection)
{
    constexpr std::uint8_t mostLanes = 8;
    const auto lane = connection.attach.lane;
    if (lane > mostLanes)
        return connection.channel->close();
    connection.channel->shareWork(m_host.workers());
    auto& task = m_incomingBulk[lane];
    if (task) {
        task->close();
        settle(*task);
        bury(std::move(task));
    }
    task =
        std::make_unique<tasks::ReceptionTask>(std::move(connection.channel), std::move(connection.decoder), m_host.budget(), lane, *this);
    const bool dialogue = m_machine.state() == SessionState::Opening || m_machine.state() == SessionState::Reopening;
    if (!dialogue) // in a dialogue it is attached and not read
        task->start();
}

void DistributedModule::settle(const tasks::ReceptionTask& ended)
{
    m_bytesReceived += ended.bytesReceived();
    m_abandoned += ended.abandoned();
}

void DistributedModule::bury(std::shared_ptr<void> ended)
{
    if (ended)
        boost::asio::post(m_host.io(), [ended = std::move(ended)] {});
}

} // namespace liena::system
