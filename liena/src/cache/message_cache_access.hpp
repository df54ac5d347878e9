// The network thread's side of the message cache.
#pragma once

#include "base/ring.hpp"
#include "cache/inheriting_mutex.hpp"
#include "liena/message_cache.hpp"

#include <cstdint>
#include <mutex>

namespace liena {

struct MessageCache::State {
    mutable cache::InheritingMutex mutex;
    std::function<void()> notify;
    base::Ring<SessionEvent> events;
    base::Ring<Message> messages;
    std::size_t bytes = 0;
    std::uint64_t superseded = 0;
    std::uint64_t messagesLost = 0; ///< for want of room
    SessionEvent firstLost;         ///< names the first of them
    std::uint64_t eventsLost = 0;
    bool notified = false;

    std::mutex draining;         ///< held before the other one
    base::Ring<Message> drained; ///< empty while nobody drains; whoever does exchanges it, so that both keep their memory
};

class MessageCacheAccess {
public:
    static constexpr std::size_t mostMessages = 4096;
    static constexpr std::size_t mostBytes = std::size_t{256} << 20U;
    static constexpr std::size_t mostEvents = 4096;

    static void put(MessageCache& cache, Message message);
    static void put(MessageCache& cache, SessionEvent event);

private:
    static void noteLost(MessageCache::State& state, const Message& message);
    static void makeRoom(MessageCache::State& state, const Message& message);
    static void dropOldest(MessageCache::State& state, base::Ring<Message>::iterator at);
    static void notify(MessageCache::State& state, std::unique_lock<cache::InheritingMutex>& lock);
};

} // namespace liena
