// Bounded queues towards the application.
#include "cache/message_cache_access.hpp"

#include <algorithm>
#include <utility>

namespace liena {

namespace {

/// The oldest went: what they said stands in links() and incidents().
SessionEvent eventsWereLost(std::uint64_t count)
{
    SessionEvent event;
    event.kind = SessionEvent::Kind::MessagesDropped;
    event.at = std::chrono::steady_clock::now();
    event.count = count;
    event.detail = "events went unheard: the application does not drain its cache fast enough";
    return event;
}

} // namespace

MessageCache::MessageCache() : m_state(std::make_unique<State>()) {}
MessageCache::~MessageCache() = default;

void MessageCache::setNotification(std::function<void()> notify)
{
    const std::lock_guard lock(m_state->mutex);
    m_state->notify = std::move(notify);
}

MessageCache::Drained MessageCache::drain()
{
    Drained drained;
    drain(drained);
    return drained;
}

void MessageCache::drain(Drained& into)
{
    into.events.clear();
    into.messages.clear();
    const std::lock_guard draining(m_state->draining);
    auto& messages = m_state->drained;
    base::Ring<SessionEvent> events; // goes with what is in it: events are rare
    SessionEvent lost;
    std::uint64_t eventsLost = 0;
    {
        const std::lock_guard lock(m_state->mutex);
        events.swap(m_state->events);
        messages.swap(m_state->messages);
        lost = std::exchange(m_state->firstLost, {});
        lost.count = std::exchange(m_state->messagesLost, 0);
        eventsLost = std::exchange(m_state->eventsLost, 0);
        m_state->bytes = 0;
        m_state->notified = false;
    }
    if (eventsLost > 0)
        into.events.push_back(eventsWereLost(eventsLost));
    into.events.insert(into.events.end(), std::make_move_iterator(events.begin()), std::make_move_iterator(events.end()));
    if (lost.count > 0)
        into.events.push_back(std::move(lost));
    into.messages.assign(std::make_move_iterator(messages.begin()), std::make_move_iterator(messages.end()));
    messages.clear();
    base::settle(messages);
}

std::uint64_t MessageCache::superseded() const
{
    const std::lock_guard lock(m_state->mutex);
    return m_state->superseded;
}

void MessageCacheAccess::put(MessageCache& cache, Message message)
{
    auto& state = *cache.m_state;
    std::unique_lock lock(state.mutex);
    makeRoom(state, message);
    state.bytes += message.encodedSize();
    base::append(state.messages, std::move(message));
    notify(state, lock);
}

void MessageCacheAccess::put(MessageCache& cache, SessionEvent event)
{
    auto& state = *cache.m_state;
    std::unique_lock lock(state.mutex);
    if (state.events.size() >= mostEvents) {
        state.events.pop_front();
        ++state.eventsLost;
    }
    base::append(state.events, std::move(event));
    notify(state, lock);
}

void MessageCacheAccess::makeRoom(MessageCache::State& state, const Message& message)
{
    if (const auto history = message.definition().history; history > 0) {
        const auto same = [&](const Message& other) { return other.id() == message.id(); };
        auto count = static_cast<std::size_t>(std::count_if(state.messages.begin(), state.messages.end(), same));
        for (; count >= history; --count) {
            dropOldest(state, std::find_if(state.messages.begin(), state.messages.end(), same));
            ++state.superseded;
        }
    }
    while (!state.messages.empty() && (state.messages.size() >= mostMessages || state.bytes + message.encodedSize() > mostBytes)) {
        noteLost(state, state.messages.front());
        dropOldest(state, state.messages.begin());
    }
}

void MessageCacheAccess::noteLost(MessageCache::State& state, const Message& message)
{
    if (++state.messagesLost > 1)
        return;
    state.firstLost.kind = SessionEvent::Kind::MessagesDropped;
    state.firstLost.at = std::chrono::steady_clock::now();
    state.firstLost.peer = message.origin();
    state.firstLost.message = message.name();
    state.firstLost.detail = "the application does not drain its cache fast enough";
}

void MessageCacheAccess::dropOldest(MessageCache::State& state, base::Ring<Message>::iterator at)
{
    state.bytes -= at->encodedSize();
    state.messages.erase(at);
}

void MessageCacheAccess::notify(MessageCache::State& state, std::unique_lock<cache::InheritingMutex>& lock)
{
    if (std::exchange(state.notified, true) || !state.notify)
        return;
    // The function is set before the system starts and does not change; it must not run under the lock, it may drain.
    lock.unlock();
    state.notify();
}

} // namespace liena
