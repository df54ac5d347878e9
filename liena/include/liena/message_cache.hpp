// The seam between the network thread and the application: bounded queues with one notification per burst.
#pragma once

#include "liena/message.hpp"
#include "liena/session_event.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace liena {

/// Holds what arrived for the application and no subscription took. All functions may be called from any thread.
///
/// A message with a `history` keeps that many undelivered ones of its kind and origin, the newest; all together are at most 4 096
/// messages and 256 MiB, and 4 096 events. The oldest goes, and what had to go is counted, and told at the next drain by a SessionEvent
/// (MessagesDropped).
class MessageCache {
public:
    MessageCache();
    ~MessageCache();
    MessageCache(const MessageCache&) = delete;
    MessageCache& operator=(const MessageCache&) = delete;

    /// `notify` runs on the network thread when something arrived in an empty cache, and not again before a drain.
    /// It must not block; a GUI posts one drain to its own thread. Set it before the system starts.
    void setNotification(std::function<void()> notify);

    struct Drained {
        std::vector<SessionEvent> events; ///< in order
        std::vector<Message> messages;    ///< in the order of arrival
    };

    /// Takes everything.
    Drained drain();

    /// The same into what was drained before, whose memory is used again; what is in it goes.
    void drain(Drained& into);

    /// Messages so far whose `history` ended before they were drained.
    std::uint64_t superseded() const;

private:
    friend class MessageCacheAccess;
    struct State;
    std::unique_ptr<State> m_state;
};

} // namespace liena
