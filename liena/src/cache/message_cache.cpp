// Bounded queues towards the application.
#include "cache/message_cache_access.hpp"

#include <algorithm>
#include <utility>

namespace liena {

MessageCache::MessageCache() : m_state(std::make_unique<State>()) {}
MessageCache::~MessageCache() = default;

void MessageCache::setNotification(std::function<void()> notify)
{
    const std::lock_guard lock(m_state->mutex);
    m_state->notify = std::move(notify);
}

MessageCache::Drained MessageCache::drain()
{
    std::deque<SessionEvent> events;
    std::deque<Message> messages;
    {
        const std::lock_guard lock(m_state->mutex);
        events.swap(m_state->events);
        messages.swap(m_state->messages);
        m_state->bytes = 0;
        m_state->notified = false;
        m_state->overflowTold = false;
    }
    return {{std::make_move_iterator(events.begin()), std::make_move_iterator(events.end())},
            {std::make_move_iterator(messages.begin()), std::make_move_iterator(messages.end())}};
}

void MessageCacheAccess::put(MessageCache& cache, Message message)
{
    auto& state = *cache.m_state;
    std::unique_lock lock(state.mutex);
    makeRoom(state, message);
    state.bytes += message.fieldBytes().size();
    state.messages.push_back(std::move(message));
    notify(state, lock);
}

void MessageCacheAccess::put(MessageCache& cache, SessionEvent event)
{
    auto& state = *cache.m_state;
    std::unique_lock lock(state.mutex);
    if (state.events.size() >= mostEvents)
        state.events.pop_front();
    state.events.push_back(std::move(event));
    notify(state, lock);
}

void MessageCacheAccess::makeRoom(MessageCache::State& state, const Message& message)
{
    if (const auto history = message.definition().history; history > 0) {
        const auto same = [&](const Message& other) { return other.id() == message.id(); };
        auto count = static_cast<std::size_t>(std::count_if(state.messages.begin(), state.messages.end(), same));
        for (; count >= history; --count)
            dropOldest(state, std::find_if(state.messages.begin(), state.messages.end(), same));
    }
    while (!state.messages.empty() && (state.messages.size() >= mostMessages || state.bytes + message.fieldBytes().size() > mostBytes)) {
        if (!std::exchange(state.overflowTold, true)) {
            SessionEvent event;
            event.kind = SessionEvent::Kind::MessagesDropped;
            event.at = std::chrono::steady_clock::now();
            event.peer = state.messages.front().origin();
            event.message = state.messages.front().name();
            event.count = 1;
            event.detail = "the application does not drain its cache fast enough";
            state.events.push_back(std::move(event));
        }
        dropOldest(state, state.messages.begin());
    }
}

void MessageCacheAccess::dropOldest(MessageCache::State& state, std::deque<Message>::iterator at)
{
    state.bytes -= at->fieldBytes().size();
    state.messages.erase(at);
}

void MessageCacheAccess::notify(MessageCache::State& state, std::unique_lock<std::mutex>& lock)
{
    if (std::exchange(state.notified, true) || !state.notify)
        return;
    // The function is set before the system starts and does not change; it must not run under the lock, it may drain.
    lock.unlock();
    state.notify();
}

} // namespace liena
