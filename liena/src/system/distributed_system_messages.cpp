// Messages between the application's threads and the modules, and whether such messages flow.
#include "protocol/message_access.hpp"
#include "system/distributed_system_state.hpp"

#include <algorithm>

namespace liena {

using namespace std::chrono_literals;

void DistributedSystem::State::deliver(Message&& message)
{
    if (message.definition().priority != Priority::Bulk)
        attention.heard();
    const auto found = messageHandlers.find(message.name());
    if (found == messageHandlers.end())
        return MessageCacheAccess::put(messageCache, std::move(message));
    for (const auto& handler : found->second)
        handler(message);
    partialBudget.recycle(MessageAccess::takeFields(message));
}

void DistributedSystem::State::drainOutbox()
{
    outbox.take(letters);
    for (auto& letter : letters) {
        if (letter.target.isBroadcast())
            publishNow(std::move(letter.message));
        else
            sendNow(letter.target, std::move(letter.message));
    }
    letters.clear();
}

void DistributedSystem::State::sendNow(DeviceId target, Message&& message)
{
    auto* one = module(target);
    if (one == nullptr)
        return;                                     // stop() was quicker
    const auto set = MessageAccess::setIn(message); // that the name lives in
    const auto& name = message.definition().name;
    const auto sent = one->send(std::move(message));
    if (sent)
        return;
    SessionEvent event;
    event.kind = SessionEvent::Kind::SendFailed;
    event.at = std::chrono::steady_clock::now();
    event.peer = target;
    event.message = name;
    event.count = 1;
    event.detail = sent.error().what;
    tell(std::move(event));
}

/// Copied for all but the last: an image that goes to one peer is not copied at all. What a single session refuses is no failure of a
/// publication.
void DistributedSystem::State::publishNow(Message message)
{
    system::DistributedModule* last = nullptr;
    for (auto& [peer, one] : modules) {
        if (!carriesMessages(one->state()) && one->state() != SessionState::Reconnecting)
            continue;
        if (last != nullptr)
            (void)last->send(Message(message));
        last = one.get();
    }
    if (last != nullptr)
        (void)last->send(std::move(message));
}

bool DistributedSystem::State::isInUse() const
{
    constexpr auto memory = 10s;
    const auto now = std::chrono::steady_clock::now();
    return std::any_of(modules.begin(), modules.end(), [&](const auto& entry) {
        const auto last = entry.second->lastUse();
        return last != session::Instant{} && now - last < memory;
    });
}

} // namespace liena
