// The honest part of a scripted peer: opening, answering, beating, closing; and the words it offers to a test.
#include "support/scripted_peer.hpp"

#include <algorithm>
#include <arpa/inet.h>
#include <cerrno>
#include <netinet/in.h>
#include <poll.h>
#include <random>
#include <stdexcept>
#include <sys/socket.h>

namespace liena::test {

using namespace wire;

namespace {

constexpr std::size_t remembered = 2000;

std::uint64_t freshToken()
{
    std::random_device random;
    return (std::uint64_t{random()} << 32U | random()) | 1U;
}

std::uint64_t wallClock()
{
    return static_cast<std::uint64_t>(std::chrono::nanoseconds(std::chrono::system_clock::now().time_since_epoch()).count());
}

} // namespace

ScriptedPeer::ScriptedPeer(PeerRole role)
    : m_role(std::move(role)),
      m_client(clientContext(m_role.face)),
      m_server(serverContext(m_role.face)),
      m_listener(listenAt(m_role.port)),
      m_udp(udpAt(m_role.port)),
      m_thread([this] { run(); })
{}

ScriptedPeer::~ScriptedPeer()
{
    m_stop = true;
    m_thread.join();
}

// The thread.

void ScriptedPeer::run()
{
    auto nextBeat = std::chrono::steady_clock::now();
    while (!m_stop) {
        std::vector<pollfd> sockets{{m_udp.number(), POLLIN, 0}};
        if (habits.accepts)
            sockets.push_back({m_listener.number(), POLLIN, 0});
        {
            const std::lock_guard lock(m_mutex);
            for (std::size_t i = 0; habits.reads && i < m_incoming.size(); ++i)
                sockets.push_back({m_incoming[i]->link->descriptor(), POLLIN, 0});
            if (m_lane0 && !m_laneClosed)
                sockets.push_back({m_lane0->descriptor(), POLLIN, 0});
        }
        ::poll(sockets.data(), sockets.size(), 10);
        const std::lock_guard lock(m_mutex);
        if (habits.accepts)
            accept();
        readPackets();
        hearDelayed();
        for (std::size_t i = 0; habits.reads && i < m_incoming.size(); ++i)
            read(*m_incoming[i]);
        std::erase_if(m_incoming, [](const auto& incoming) { return incoming->link == nullptr; });
        Bytes nothing;
        m_laneClosed = m_laneClosed || (m_lane0 && !m_lane0->receive(nothing));
        if (const auto now = std::chrono::steady_clock::now(); now >= nextBeat) {
            nextBeat = now + m_role.heartbeat;
            beat();
        }
        sendLate();
        m_changed.notify_all();
    }
}

void ScriptedPeer::accept()
{
    while (auto socket = Descriptor(::accept4(m_listener.number(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC)))
        m_incoming.push_back(
            std::make_unique<Incoming>(Incoming{.link = std::make_unique<TlsLink>(m_server.get(), std::move(socket), true), .stream = {}}));
}

void ScriptedPeer::read(Incoming& incoming)
{
    const bool alive = incoming.link->receive(incoming.stream);
    for (const auto& datagram : takeDatagrams(incoming.stream))
        judge(incoming, datagram);
    if (!alive)
        incoming.link.reset();
}

void ScriptedPeer::judge(Incoming& incoming, const Datagram& datagram)
{
    Reader body(datagram.body);
    if (datagram.header.number == number::attach) {
        body.u16();
        incoming.token = body.u64();
        incoming.lane = body.u8();
        if (incoming.lane == 0 && incoming.token == m_token)
            m_openKey = incoming.link->datagramKey(m_token);
    } else if ((datagram.header.number == number::handshake || datagram.header.number == number::diagnosisHandshake) && habits.answers) {
        m_openKey = incoming.link->datagramKey(incoming.token);
        m_again = datagram.header.number == number::diagnosisHandshake;
        auto back = connection();
        if (!back->failure().empty())
            return;
        Bytes commit = handshakeCommit(incoming.token, hashOf(m_role.set));
        if (m_again)
            commit = Words().raw(commit).u64(m_previous);
        begin(incoming.token, std::move(back), said(m_again ? number::diagnosisHandshakeCommit : number::handshakeCommit, commit));
    }
    m_heard.push_back({datagram, incoming.lane, incoming.token});
    if (m_heard.size() > remembered)
        m_heard.pop_front();
    if (incoming.token == m_token && incoming.lane == 0)
        answer(datagram);
}

/// What an honest peer does upon a word of the session in hand.
void ScriptedPeer::answer(const Datagram& datagram)
{
    Reader body(datagram.body);
    const auto saying = [this](std::uint16_t number, const Bytes& words) { m_lane0->send(said(number, words)); };
    switch (datagram.header.number) {
    case number::heartbeat:
        if (const auto beat = heartbeatOf(datagram.body))
            hear(*beat);
        break;
    case number::handshakeCommit:
    case number::diagnosisHandshakeCommit:
        if (!habits.answers)
            break;
        if (body.u64(); datagram.body.size() > 40 && datagram.body[40] != 0)
            sendSet();
        if (m_again)
            saying(number::channelReOpened, reOpened(m_token, m_previous, m_role.id, m_role.device));
        else
            saying(number::channelOpened, tokenOnly(m_token));
        m_state = state::open;
        break;
    case number::messageSetRequest:
        sendSet();
        break;
    case number::channelOpened:
        m_state = state::open;
        break;
    case number::channelReOpened:
        if (m_state == state::reopening)
            m_state = state::open;
        break;
    case number::rejected:
        if (m_state != state::opening && m_state != state::reopening)
            m_previous = m_token; // a session that is refused while it is open is lost
        m_state = state::closed;
        break;
    case number::standBy: {
        const auto incident = body.u64();
        const auto a = body.u32();
        const auto b = body.u32();
        if (std::minmax(a, b) == std::minmax(m_role.id, m_role.device))
            m_previous = incident;
        break;
    }
    case number::disengagement:
        m_state = state::closing;
        saying(number::disengagementCommit, tokenOnly(m_token));
        break;
    case number::disengagementCommit:
        saying(number::channelClosed, tokenOnly(m_token));
        m_state = state::closed;
        break;
    case number::channelClosed:
        m_state = state::closed;
        break;
    default:
        break;
    }
}

/// In segments of 8 192 bytes.
void ScriptedPeer::sendSet()
{
    const auto body = messageSet(hashOf(m_role.set), m_role.sentSet.empty() ? m_role.set : m_role.sentSet);
    auto head = header(number::messageSet);
    for (std::size_t at = 0; at < body.size(); at += 8192) {
        const auto end = std::min(body.size(), at + 8192);
        head.more = end < body.size();
        const Bytes part(body.begin() + static_cast<std::ptrdiff_t>(at), body.begin() + static_cast<std::ptrdiff_t>(end));
        if (!m_lane0->send(datagram(head, part)))
            return;
    }
}

void ScriptedPeer::hear(const Heartbeat& beat)
{
    m_underway.push_back({std::chrono::steady_clock::now() + habits.delay.load(), beat});
    hearDelayed();
}

void ScriptedPeer::hearDelayed()
{
    for (; !m_underway.empty() && m_underway.front().arrives <= std::chrono::steady_clock::now(); m_underway.pop_front())
        take(m_underway.front().beat);
}

void ScriptedPeer::take(const Heartbeat& beat)
{
    if (beat.sequence <= m_newest.sequence)
        return;
    if (beat.epoch != m_newest.epoch)
        m_sequences.clear();
    m_newest = beat;
    m_newestReceived = wallClock();
}

void ScriptedPeer::readPackets()
{
    std::uint8_t buffer[2048];
    for (;;) {
        const auto size = ::recv(m_udp.number(), buffer, sizeof buffer, 0);
        if (size < 0)
            break;
        const Bytes packet(buffer, buffer + size);
        if (m_openKey.empty() || Reader(packet).u64() != m_token)
            continue;
        const auto plain = unsealed(m_openKey, packet);
        const auto header = plain ? headerOf(*plain) : std::nullopt;
        if (!header)
            continue;
        ++m_packetsHeard;
        m_packetTimes.push_back(std::chrono::steady_clock::now());
        if (const auto beat = header->number == number::heartbeat ? heartbeatOf(ByteSpan(*plain).subspan(headerBytes)) : std::nullopt)
            hear(*beat);
    }
    while (!m_packetTimes.empty() && m_packetTimes.front() + 8 * m_role.heartbeat < std::chrono::steady_clock::now())
        m_packetTimes.pop_front();
}

void ScriptedPeer::beat()
{
    if (!habits.heartbeats || !m_lane0 || m_laneClosed || m_state == state::closed)
        return;
    const auto now = stamp();
    const auto datagram =
        said(number::heartbeat, heartbeat({.sequence = ++m_beat,
                                           .sent = now,
                                           .echoSequence = m_newest.sequence,
                                           .echoSent = m_newest.sent,
                                           .echoReceived = m_newestReceived,
                                           .datagramsHeard = static_cast<std::uint8_t>(std::min<std::size_t>(m_packetTimes.size(), 255)),
                                           .state = m_state,
                                           .incidents = 0,
                                           .epoch = m_epoch}));
    constexpr std::uint32_t oneIn = 4;
    const auto lateness = m_beat % oneIn == 0 ? habits.lateness.load() : std::chrono::milliseconds(0);
    m_late.push_back({std::chrono::steady_clock::now() + lateness, datagram});
    sendLate();
}

void ScriptedPeer::sendLate()
{
    for (; !m_late.empty() && m_late.front().leaves <= std::chrono::steady_clock::now(); m_late.pop_front()) {
        if (habits.laneZero && !m_laneClosed)
            m_lane0->send(m_late.front().datagram);
        if (habits.datagrams)
            sendPacket(sealNext(m_late.front().datagram));
    }
}

// Opening and closing.

void ScriptedPeer::begin(std::uint64_t token, std::unique_ptr<TlsLink> lane0, const Bytes& first)
{
    m_token = token;
    m_lane0 = std::move(lane0);
    m_laneClosed = false;
    m_sealKey = m_lane0->datagramKey(token);
    m_underway.clear();
    m_late.clear();
    m_newest = {};
    m_newestReceived = 0;
    m_packet = 0;
    m_packetsHeard = 0;
    m_beat = 0;
    m_sequences.clear();
    ++m_epoch;
    m_state = m_again ? state::reopening : state::opening;
    m_lane0->send(attach(token));
    m_lane0->send(first);
}

void ScriptedPeer::begin(bool again)
{
    auto lane0 = connection();
    if (!lane0->failure().empty())
        throw std::runtime_error("the scripted peer cannot connect: " + lane0->failure());
    const std::lock_guard lock(m_mutex);
    m_again = again;
    m_incoming.clear();
    const auto token = freshToken();
    begin(token, std::move(lane0), again ? diagnosisHandshake(token, m_previous) : handshake(token));
}

std::optional<std::uint8_t> ScriptedPeer::refusalOfConnecting()
{
    const auto trial = connection();
    return trial->failure().empty() ? refusalOfOpening() : std::uint8_t{0};
}

std::optional<std::uint8_t> ScriptedPeer::refusalOfOpening(bool again)
{
    begin(again);
    const auto reason = [this] {
        const auto refusals = heard(number::rejected);
        return !refusals.empty() && refusals.back().token == token() ? refusals.back().datagram.body.at(8) : std::uint8_t{0};
    };
    if (!waits([&] { return (isOpen() && deviceState() == state::open) || reason() != 0 || laneClosed(); }))
        throw std::runtime_error("the device neither opens nor refuses");
    if (isOpen() && reason() == 0)
        return std::nullopt;
    (void)waits([this] { return laneClosed(); }); // the reason may come behind the end of our lane
    return reason();
}

void ScriptedPeer::open(bool again)
{
    if (const auto refused = refusalOfOpening(again))
        throw std::runtime_error("the scripted peer could not open: reason " + std::to_string(*refused));
}

void ScriptedPeer::awaitOpen()
{
    if (!waits([this] { return isOpen() && deviceState() == state::open; }))
        throw std::runtime_error("the device did not open a session with the scripted peer");
}

void ScriptedPeer::show(const TlsFace& face)
{
    const std::lock_guard lock(m_mutex);
    m_role.face = face;
    m_client = clientContext(face);
    m_server = serverContext(face);
}

void ScriptedPeer::showSet(const std::string& announced, const std::string& sent)
{
    const std::lock_guard lock(m_mutex);
    m_role.set = announced;
    m_role.sentSet = sent;
}

void ScriptedPeer::close()
{
    say(number::disengagement, Words().u64(token()).text("done"));
    if (!waits([this] { return laneClosed(); }))
        throw std::runtime_error("the scripted peer could not close");
}

bool ScriptedPeer::waits(const std::function<bool()>& holds) const
{
    const auto deadline = std::chrono::steady_clock::now() + TlsLink::patience;
    while (!holds()) {
        std::unique_lock lock(m_mutex);
        if (m_changed.wait_until(lock, deadline) == std::cv_status::timeout)
            return false;
    }
    return true;
}

bool ScriptedPeer::isOpen() const
{
    const std::lock_guard lock(m_mutex);
    return m_state == state::open && !m_laneClosed;
}

bool ScriptedPeer::laneClosed() const
{
    const std::lock_guard lock(m_mutex);
    return m_laneClosed;
}

std::uint64_t ScriptedPeer::token() const
{
    const std::lock_guard lock(m_mutex);
    return m_token;
}

std::uint8_t ScriptedPeer::deviceState() const
{
    const std::lock_guard lock(m_mutex);
    return m_newest.state;
}

std::uint32_t ScriptedPeer::deviceEpoch() const
{
    const std::lock_guard lock(m_mutex);
    return m_newest.epoch;
}

} // namespace liena::test
