// The topology's devices and links, and what this console knows of each link now and over the last minute.
#pragma once

#include "model/device_node.hpp"
#include "model/link_figures.hpp"
#include "model/link_state.hpp"

#include <QObject>
#include <QString>

#include <chrono>
#include <deque>
#include <optional>
#include <vector>

namespace console {

/// A link between this console and a device, or between two other devices; of the latter the state is not known here.
struct LinkNode {
    quint32 a = 0;
    quint32 b = 0;
    bool own = false;                    ///< one end is this console
    quint32 peer = 0;                    ///< own links: the other end
    LinkState state = LinkState::Closed; ///< own links only
    Instant since;                       ///< when that state was entered; the epoch before the first change
    Instant carriesSince;                ///< own links: when messages last began to pass
    LinkFigures figures;                 ///< own links only
    Instant figuresAt;                   ///< own links: when those were read; the epoch before the first time
    std::deque<LinkSample> history;      ///< own links: 60 s, oldest first
    std::deque<Duration> roundTrips;     ///< own links: the last three, oldest first
    std::deque<quint32> queued;          ///< own links: messages that waited at the last three looks, oldest first
    Duration heartbeat = usualHeartbeat; ///< the topology's
    std::optional<Duration> carried;     ///< own links: commands that take longer there and back come too old; nothing: not known
    bool commandsDiffer = false;         ///< own links: its set has not the commands that this console gives
    std::optional<double> openingMs;     ///< how long the last opening or re-opening took
    QString failure;                     ///< why the last opening failed, for a person; empty after a success
    bool systemDiffers = false;          ///< the last opening failed since topology or message sets are not the same on both sides
    std::vector<Instant> suspects;       ///< from Open to Suspect or worse in the last 60 s
    bool inIncident = false;             ///< an incident of this pair is held; known for links of others, too
    quint64 incident = 0;

    bool stateKnown() const { return own; }

    /// As a person is told it. A reading comes with several heartbeats: while the link is open and readings come, the time since the last
    /// one is no silence of the peer's. In every other state, and when readings stop, it counts.
    std::optional<Duration> heardAgo(Instant now) const;

    /// The directions as figures say that were read since messages pass; before the first of those nothing speaks against an open link.
    bool toPeerStands() const { return figuresAt < carriesSince || figures.toPeerConnected; }
    bool fromPeerStands() const { return figuresAt < carriesSince || figures.fromPeerConnected; }

    /// The median of the last three: a single one that a busy computer delayed is not the line.
    std::optional<Duration> usualRoundTrip() const;

    /// Messages that have been waiting for longer than a look at them takes: what is just on its way is not held against the link.
    quint32 leastQueued() const;

    bool joins(quint32 x, quint32 y) const { return (a == x && b == y) || (a == y && b == x); }
};

/// GUI thread only. Changed by the link room and the composition root; widgets read it.
class SessionModel : public QObject {
    Q_OBJECT
public:
    static constexpr std::chrono::seconds historyLength{60};

    explicit SessionModel(QObject* parent = nullptr);

    struct Topology {
        QString name;
        QString title;
        QString version;
        QString hash;        ///< 64 hex digits
        bool secured = true; ///< TLS; false must be shown
        std::vector<DeviceNode> devices;
        std::vector<std::pair<quint32, quint32>> links;
        std::vector<Duration> heartbeats; ///< of the links, in their order; of those that are missing the usual one
    };

    void setTopology(Topology topology);

    const QString& topologyName() const { return m_topology.name; }
    const QString& topologyTitle() const { return m_topology.title; }
    const QString& topologyVersion() const { return m_topology.version; }
    const QString& topologyHash() const { return m_topology.hash; }
    bool secured() const { return m_topology.secured; }

    const std::vector<DeviceNode>& devices() const { return m_topology.devices; }
    const DeviceNode* device(quint32 id) const;
    const DeviceNode* self() const;

    /// The title of a device; its id in hex when the topology does not have it.
    QString titleOf(quint32 id) const;

    const std::vector<LinkNode>& links() const { return m_links; }
    const LinkNode* link(quint32 a, quint32 b) const;

    /// The link between this console and `peer`; null when there is none.
    const LinkNode* linkTo(quint32 peer) const;

    /// Closed when there is no such link.
    LinkState state(quint32 peer) const;

    /// The first linked device of a kind (the robot: Hand; X-ray: Eye), or nothing.
    std::optional<quint32> firstPeer(DeviceKind kind) const;

    std::size_t ownLinkCount() const;
    std::size_t openCount() const; ///< own links in Open or Suspect
    bool allOpen() const { return ownLinkCount() > 0 && openCount() == ownLinkCount(); }

    /// This device holds at least one incident, of whatever pair.
    bool inStandBy() const { return m_standBy; }

    // For the link room.
    void setLinkState(quint32 peer, LinkState state, Instant now);
    void setLinkFigures(quint32 peer, const LinkFigures& figures, Instant now);
    void setCarried(quint32 peer, std::optional<Duration> roundTrip);
    void setCommandsDiffer(quint32 peer, bool differ);
    void noteOpened(quint32 peer, Duration took);
    void noteOpenFailed(quint32 peer, const QString& reason, bool systemDiffers = false);
    void setLinkIncident(quint32 a, quint32 b, quint64 incident); ///< 0: no longer
    void setStandBy(bool standBy);

Q_SIGNALS:
    void topologyChanged();
    void linkStateChanged(quint32 peer, console::LinkState from, console::LinkState to);
    void linkFiguresChanged(quint32 peer);
    void linkOpened(quint32 peer, double milliseconds);
    void linkOpenFailed(quint32 peer, const QString& reason);
    void linkIncidentChanged(quint32 a, quint32 b);
    void standByChanged(bool standBy);

private:
    LinkNode* ownLink(quint32 peer);

    Topology m_topology;
    std::vector<LinkNode> m_links;
    bool m_standBy = false;
};

} // namespace console
