// The lanes of a simulated module: connecting ours, taking in theirs, and packets on the path beside them.
#include "simulated_device.hpp"
#include "simulated_module.hpp"

#include <utility>

namespace liena::simulation {

using namespace std::chrono_literals;

namespace {

constexpr auto connectLimit = 1s;
constexpr auto reconnectLimit = 250ms;

} // namespace

SimulatedLane::Handlers SimulatedModule::laneZeroHandlers()
{
    SimulatedLane::Handlers handlers;
    handlers.up = [this] { laneZeroUp(); };
    handlers.failed = [this](const ConnectFailure& failure) { handle(session::OutgoingFailed{failure.probe, failure.detail}); };
    handlers.lost = [this](const std::string& detail) { handle(session::OutgoingLost{ProbeResult::NotProbed, detail}); };
    handlers.dropped = [this](const tasks::OutputQueue::Entry& entry, tasks::OutputQueue::Fate fate) { unsent(entry, fate); };
    handlers.abandoning = [this](const protocol::DatagramHeader& begun) {
        return encode(protocol::Abandon{begun.message.number, begun.timestamp.ns}, m_device.surroundings().idOf(m_peer));
    };
    handlers.leaving = [this](std::vector<std::byte>& bytes, std::size_t begin) { leaving(bytes, begin); };
    return handlers;
}

SimulatedLane::Handlers SimulatedModule::bulkHandlers()
{
    auto handlers = laneZeroHandlers();
    handlers.up = [] {};
    handlers.failed = [this](const ConnectFailure&) { retryBulk(); };
    handlers.lost = [this](const std::string&) { retryBulk(); };
    return handlers;
}

void SimulatedModule::unsent(const tasks::OutputQueue::Entry& entry, tasks::OutputQueue::Fate fate)
{
    if (entry.message.header.message.isSessionManagement())
        return;
    m_device.observe(Unsent{m_device.host(), m_peer, nameOf(entry.message.header), static_cast<Fate>(fate)});
}

void SimulatedModule::leaving(std::vector<std::byte>& bytes, std::size_t begin)
{
    const auto header =
        protocol::decodeHeader(std::span<const std::byte, protocol::headerSize>(bytes.data() + begin, protocol::headerSize));
    if (!header.message.isSessionManagement() && !header.moreSegments)
        m_device.observe(Left{m_device.host(), m_peer, nameOf(header)});
    m_device.surroundings().leaving(m_device.host(), m_peer, bytes, begin);
}

bool SimulatedModule::sendPacket(const protocol::EncodedMessage& message)
{
    auto packet = m_device.settings().datagrams ? m_datagrams.packet(message) : std::nullopt;
    if (packet)
        m_device.network().sendDatagram(m_device.host(), m_peer, std::move(*packet));
    return packet.has_value();
}

void SimulatedModule::laneZeroUp()
{
    m_datagrams.outgoingUp(m_machine.token(), m_laneZero.connection());
    handle(session::OutgoingUp{});
}

void SimulatedModule::connectLaneZero()
{
    const bool dialogue = m_machine.state() == SessionState::Opening || m_machine.state() == SessionState::Reopening;
    m_laneZero.connect(encode(protocol::Attach{protocol::protocolVersion, m_machine.token(), 0}, m_device.surroundings().idOf(m_peer)),
                       dialogue ? connectLimit : reconnectLimit);
}

void SimulatedModule::connectBulk()
{
    if (m_bulk.isUp() || m_bulk.isConnecting() || m_bulk.queue().empty() || !carriesMessages(m_machine.state()))
        return;
    m_bulk.connect(encode(protocol::Attach{protocol::protocolVersion, m_machine.token(), bulkLane}, m_device.surroundings().idOf(m_peer)),
                   connectLimit);
}

void SimulatedModule::retryBulk()
{
    m_bulkRetry.after(50ms, [this] { connectBulk(); });
}

void SimulatedModule::closeLanes(Nanoseconds grace)
{
    m_laneZero.close(grace);
    m_bulk.close(0ns);
    m_bulkRetry.cancel();
    m_datagrams.end();
    std::vector<std::shared_ptr<SimulatedReception>> ended;
    if (m_incoming)
        ended.push_back(std::move(m_incoming));
    for (auto& [lane, reception] : m_incomingBulk)
        if (reception)
            ended.push_back(std::move(reception));
    m_incomingBulk.clear();
    for (auto& reception : ended) {
        if (grace <= 0ns) {
            reception->close();
            m_device.bury(std::move(reception));
            continue;
        }
        reception->orphan();
        auto timer = std::make_shared<Program::Timer>(m_device);
        auto* raw = timer.get();
        m_device.keep(reception, timer);
        raw->after(grace, [this, raw] { m_device.release(raw); });
    }
}

void SimulatedModule::adopt(session::ConnectionNumber number)
{
    const auto fresh = m_fresh.find(number);
    if (fresh == m_fresh.end())
        return;
    m_device.observe(LaneTaken{m_device.host(), m_peer, fresh->second->token(), m_machine.token()});
    m_incoming = fresh->second->release();
    m_incoming->setOwner(*this);
    m_datagrams.incomingUp(m_machine.token(), m_incoming->connection(), m_device.now().mono);
    m_device.bury(std::move(fresh->second));
    m_fresh.erase(fresh);
    m_device.post([this, reception = m_incoming.get()] {
        if (m_incoming.get() == reception)
            reception->start();
    });
}

void SimulatedModule::refuse(const session::Refuse& refusal)
{
    const auto fresh = m_fresh.find(refusal.connection);
    if (fresh == m_fresh.end())
        return;
    const auto peer = m_device.surroundings().idOf(m_peer);
    m_couriers.send(std::move(fresh->second), encode(protocol::Attach{protocol::protocolVersion, refusal.token, 0}, peer),
                    encode(protocol::Rejected{refusal.token, refusal.reason, {refusal.detail}}, peer));
    m_fresh.erase(fresh);
}

void SimulatedModule::attached(AttachedConnection connection)
{
    const auto close = [&] {
        if (auto* stands = m_device.network().find(connection.connection))
            stands->close(m_device.host());
    };
    const auto state = m_machine.state();
    const bool alive = state != SessionState::Closed && state != SessionState::StandBy;
    const bool unbound = m_device.settings().mutant == Mutant::SecondLegNotBound;
    const bool inSession = alive && (connection.attach.token == m_machine.token() || unbound);
    if (connection.attach.protocol != protocol::protocolVersion) {
        const auto peer = m_device.surroundings().idOf(m_peer);
        const auto token = connection.attach.token;
        auto fresh = std::make_unique<SimulatedFresh>(m_device, std::move(connection), m_device.settings().id, m_device.budget(),
                                                      SimulatedFresh::Handlers{[] {}, [](const auto&) {}, [] {}});
        m_couriers.send(std::move(fresh), encode(protocol::Attach{protocol::protocolVersion, token, 0}, peer),
                        encode(protocol::Rejected{token, RejectReason::ProtocolVersion, {"version 1 is spoken here"}}, peer));
        return;
    }
    if (connection.attach.lane > 0)
        return inSession && m_incoming ? admitBulk(std::move(connection)) : close();
    if (!inSession)
        return admitFresh(std::move(connection));
    if (m_incoming) {
        m_incoming->close();
        m_device.bury(std::move(m_incoming));
    }
    m_device.observe(LaneTaken{m_device.host(), m_peer, connection.attach.token, m_machine.token()});
    m_incoming = std::make_unique<SimulatedReception>(m_device, connection.connection, std::move(connection.decoder), m_device.budget(),
                                                      std::uint8_t{0}, *this);
    auto* reception = m_incoming.get();
    m_datagrams.incomingUp(m_machine.token(), reception->connection(), m_device.now().mono);
    handle(session::IncomingUp{});
    if (m_incoming.get() == reception)
        reception->start();
}

void SimulatedModule::admitFresh(AttachedConnection connection)
{
    constexpr std::size_t mostFresh = 4;
    if (m_fresh.size() >= mostFresh)
        endFresh(m_fresh.begin()->first);
    const auto number = ++m_nextConnection;
    auto fresh = std::make_unique<SimulatedFresh>(
        m_device, std::move(connection), m_device.settings().id, m_device.budget(),
        SimulatedFresh::Handlers{[this] { m_device.turned(); },
                                 [this, number](const protocol::SessionMessage& message) { handshakeHeard(number, message); },
                                 [this, number] { endFresh(number); }});
    auto* raw = fresh.get();
    m_fresh.emplace(number, std::move(fresh));
    raw->start();
}

void SimulatedModule::endFresh(session::ConnectionNumber number)
{
    const auto fresh = m_fresh.find(number);
    if (fresh == m_fresh.end())
        return;
    fresh->second->close();
    m_device.bury(std::move(fresh->second));
    m_fresh.erase(fresh);
}

void SimulatedModule::handshakeHeard(session::ConnectionNumber number, const protocol::SessionMessage& message)
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
    if (m_device.isTokenUsed(m_peer, input.handshake.token))
        return endFresh(number);
    input.standing = m_device.standingOf(m_peer, input.handshake.set);
    if (input.standing == session::SetStanding::Held)
        m_peerSet = m_device.heldSet(m_peer, input.handshake.set);
    handle(input);
}

void SimulatedModule::admitBulk(AttachedConnection connection)
{
    constexpr std::uint8_t mostLanes = 8;
    const auto lane = connection.attach.lane;
    if (lane > mostLanes) {
        if (auto* stands = m_device.network().find(connection.connection))
            stands->close(m_device.host());
        return;
    }
    auto& reception = m_incomingBulk[lane];
    if (reception) {
        reception->close();
        m_device.bury(std::move(reception));
    }
    m_device.observe(LaneTaken{m_device.host(), m_peer, connection.attach.token, m_machine.token()});
    reception = std::make_unique<SimulatedReception>(m_device, connection.connection, std::move(connection.decoder), m_device.budget(),
                                                     lane, *this);
    if (m_machine.state() != SessionState::Opening && m_machine.state() != SessionState::Reopening)
        reception->start();
}

} // namespace liena::simulation
