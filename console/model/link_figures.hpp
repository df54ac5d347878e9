// The live figures of one link between this console and a device.
#pragma once

#include "model/instant.hpp"
#include "model/link_state.hpp"

#include <QString>
#include <QtGlobal>

#include <cstdint>
#include <optional>

namespace console {

/// A copy of one moment. What is not known is nothing, never zero.
struct LinkFigures {
    std::optional<Instant> lastHeard; ///< the last datagram of the peer on any path
    std::optional<Duration> roundTrip;
    std::optional<Duration> jitter;
    std::optional<Duration> clockOffset; ///< peer's clock − ours
    Duration clockUncertainty{};         ///< meaningful only with clockOffset
    quint64 heartbeatsReceived = 0;
    quint64 heartbeatsMissed = 0;
    quint32 heartbeatsOnTime = 0; ///< consecutive, until now
    double messagesInPerSecond = 0;
    double messagesOutPerSecond = 0;
    double bytesInPerSecond = 0;
    double bytesOutPerSecond = 0;
    quint64 messagesDropped = 0;
    quint32 queuedMessages = 0;
    quint32 interruptions = 0;
    bool packetsPass = false; ///< UDP, both ways, within the last few heartbeats: the way that no lost segment holds up
    bool toPeerConnected = false;
    bool fromPeerConnected = false;
    QString localAddress;                    ///< of our connection to the peer; empty before the first
    QString remoteAddress;                   ///< the peer's end of it
    LinkState peerState = LinkState::Closed; ///< as the peer last said it

    /// At `now`, not when the figures were read: never less than the truth then, and more by at most the time since they were read.
    std::optional<Duration> heardAgo(Instant now) const
    {
        return lastHeard ? std::optional<Duration>(now > *lastHeard ? now - *lastHeard : Duration::zero()) : std::nullopt;
    }

    /// Of the heartbeats expected since the session opened; 0 … 1.
    double loss() const
    {
        const auto expected = heartbeatsReceived + heartbeatsMissed;
        return expected == 0 ? 0.0 : static_cast<double>(heartbeatsMissed) / static_cast<double>(expected);
    }
};

/// One point of a link's history, ten a second.
struct LinkSample {
    Instant at;
    LinkState state = LinkState::Closed;
    std::optional<double> roundTripMs;
    std::optional<double> jitterMs;
    std::optional<double> silenceMs; ///< age of the last heartbeat
};

} // namespace console
