// Devices and links of the topology, and their last minute.
#include "model/session_model.hpp"

#include <algorithm>

namespace console {

namespace {

constexpr std::chrono::milliseconds samplePeriod{100};
constexpr std::chrono::milliseconds readingsStop{300}; ///< three of them have not come
constexpr std::size_t usualOf = 3;
constexpr std::size_t mostSuspects = 10'000; // within a minute: beyond that the number says nothing more

bool isWorse(LinkState to) { return to == LinkState::Suspect || to == LinkState::Reconnecting || to == LinkState::StandBy; }

void sample(LinkNode& link, Instant now)
{
    if (!link.history.empty() && now - link.history.back().at < samplePeriod)
        return;
    const auto number = [](const std::optional<Duration>& duration) {
        return duration ? std::optional<double>(milliseconds(*duration)) : std::nullopt;
    };
    const auto& figures = link.figures;
    link.history.push_back({now, link.state, number(figures.roundTrip), number(figures.jitter), number(figures.heardAgo(now))});
    while (link.history.front().at < now - SessionModel::historyLength)
        link.history.pop_front();
}

void forgetOldSuspects(LinkNode& link, Instant now)
{
    std::erase_if(link.suspects, [now](Instant at) { return at < now - SessionModel::historyLength; });
}

void noteRoundTrip(LinkNode& link)
{
    if (!link.figures.roundTrip)
        return link.roundTrips.clear();
    if (!link.roundTrips.empty() && link.roundTrips.back() == *link.figures.roundTrip)
        return; // figures come more often than heartbeats: to the nanosecond the same is the same measurement
    link.roundTrips.push_back(*link.figures.roundTrip);
    if (link.roundTrips.size() > usualOf)
        link.roundTrips.pop_front();
}

void noteQueue(LinkNode& link)
{
    link.queued.push_back(link.figures.queuedMessages);
    if (link.queued.size() > usualOf)
        link.queued.pop_front();
}

} // namespace

std::optional<Duration> LinkNode::heardAgo(Instant now) const
{
    const bool inTime = state == LinkState::Open && now - figuresAt < readingsStop;
    return figures.heardAgo(inTime ? figuresAt : now);
}

quint32 LinkNode::leastQueued() const { return queued.empty() ? 0 : *std::min_element(queued.begin(), queued.end()); }

std::optional<Duration> LinkNode::usualRoundTrip() const
{
    if (roundTrips.empty())
        return std::nullopt;
    std::vector<Duration> sorted(roundTrips.begin(), roundTrips.end());
    std::sort(sorted.begin(), sorted.end());
    return sorted[sorted.size() / 2];
}

SessionModel::SessionModel(QObject* parent) : QObject(parent) {}

void SessionModel::setTopology(Topology topology)
{
    m_topology = std::move(topology);
    m_links.clear();
    const auto* own = self();
    for (const auto& [a, b] : m_topology.links) {
        LinkNode link;
        link.a = a;
        link.b = b;
        link.own = own != nullptr && (own->id == a || own->id == b);
        if (link.own)
            link.peer = own->id == a ? b : a;
        if (m_links.size() < m_topology.heartbeats.size())
            link.heartbeat = m_topology.heartbeats[m_links.size()];
        m_links.push_back(std::move(link));
    }
    Q_EMIT topologyChanged();
}

const DeviceNode* SessionModel::device(quint32 id) const
{
    const auto& all = m_topology.devices;
    const auto place = std::find_if(all.begin(), all.end(), [id](const DeviceNode& node) { return node.id == id; });
    return place == all.end() ? nullptr : &*place;
}

const DeviceNode* SessionModel::self() const
{
    const auto& all = m_topology.devices;
    const auto place = std::find_if(all.begin(), all.end(), [](const DeviceNode& node) { return node.self; });
    return place == all.end() ? nullptr : &*place;
}

QString SessionModel::titleOf(quint32 id) const
{
    if (const auto* node = device(id))
        return node->title.isEmpty() ? node->name : node->title;
    DeviceNode stranger;
    stranger.id = id;
    return stranger.idText();
}

const LinkNode* SessionModel::link(quint32 a, quint32 b) const
{
    const auto place = std::find_if(m_links.begin(), m_links.end(), [a, b](const LinkNode& link) { return link.joins(a, b); });
    return place == m_links.end() ? nullptr : &*place;
}

const LinkNode* SessionModel::linkTo(quint32 peer) const
{
    const auto place = std::find_if(m_links.begin(), m_links.end(), [peer](const LinkNode& link) { return link.own && link.peer == peer; });
    return place == m_links.end() ? nullptr : &*place;
}

LinkNode* SessionModel::ownLink(quint32 peer)
{
    const auto place = std::find_if(m_links.begin(), m_links.end(), [peer](const LinkNode& link) { return link.own && link.peer == peer; });
    return place == m_links.end() ? nullptr : &*place;
}

LinkState SessionModel::state(quint32 peer) const
{
    const auto* link = linkTo(peer);
    return link ? link->state : LinkState::Closed;
}

std::optional<quint32> SessionModel::firstPeer(DeviceKind kind) const
{
    for (const auto& link : m_links)
        if (link.own && kindOf(link.peer) == kind)
            return link.peer;
    return std::nullopt;
}

std::size_t SessionModel::ownLinkCount() const
{
    return static_cast<std::size_t>(std::count_if(m_links.begin(), m_links.end(), [](const LinkNode& link) { return link.own; }));
}

std::size_t SessionModel::openCount() const
{
    return static_cast<std::size_t>(
        std::count_if(m_links.begin(), m_links.end(), [](const LinkNode& link) { return link.own && carriesMessages(link.state); }));
}

void SessionModel::setLinkState(quint32 peer, LinkState state, Instant now)
{
    auto* link = ownLink(peer);
    if (link == nullptr || link->state == state)
        return;
    const auto from = link->state;
    link->state = state;
    link->since = now;
    if (carriesMessages(state) && !carriesMessages(from))
        link->carriesSince = now;
    forgetOldSuspects(*link, now);
    if (isWorse(state) && from == LinkState::Open && link->suspects.size() < mostSuspects)
        link->suspects.push_back(now);
    Q_EMIT linkStateChanged(peer, from, state);
}

void SessionModel::setLinkFigures(quint32 peer, const LinkFigures& figures, Instant now)
{
    auto* link = ownLink(peer);
    if (link == nullptr)
        return;
    link->figures = figures;
    link->figuresAt = now;
    noteRoundTrip(*link);
    noteQueue(*link);
    sample(*link, now);
    forgetOldSuspects(*link, now);
    Q_EMIT linkFiguresChanged(peer);
}

void SessionModel::setCarried(quint32 peer, std::optional<Duration> roundTrip)
{
    if (auto* link = ownLink(peer))
        link->carried = roundTrip;
}

void SessionModel::setCommandsDiffer(quint32 peer, bool differ)
{
    if (auto* link = ownLink(peer))
        link->commandsDiffer = differ;
}

void SessionModel::noteOpened(quint32 peer, Duration took)
{
    auto* link = ownLink(peer);
    if (link == nullptr)
        return;
    link->openingMs = milliseconds(took);
    link->failure.clear();
    link->systemDiffers = false;
    Q_EMIT linkOpened(peer, *link->openingMs);
}

void SessionModel::noteOpenFailed(quint32 peer, const QString& reason, bool systemDiffers)
{
    auto* link = ownLink(peer);
    if (link == nullptr)
        return;
    link->failure = reason;
    link->systemDiffers = systemDiffers;
    Q_EMIT linkOpenFailed(peer, reason);
}

void SessionModel::setLinkIncident(quint32 a, quint32 b, quint64 incident)
{
    for (auto& link : m_links) {
        if (!link.joins(a, b) || link.incident == incident)
            continue;
        link.incident = incident;
        link.inIncident = incident != 0;
        Q_EMIT linkIncidentChanged(link.a, link.b);
    }
}

void SessionModel::setStandBy(bool standBy)
{
    if (m_standBy == standBy)
        return;
    m_standBy = standBy;
    Q_EMIT standByChanged(standBy);
}

} // namespace console
