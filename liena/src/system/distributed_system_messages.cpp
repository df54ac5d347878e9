// Messages between the application's threads and the modules, and whether such messages flow.
#include "protocol/message_access.hpp"
#include "system/distributed_system_state.hpp"

#include <boost/asio/post.hpp>

#include <algorithm>

namespace liena {

namespace asio = boost::asio;
using namespace std::chrono_literals;

void DistributedSystem::State::deliver(Message&& message)
{
    if (message.definition().priority != Priority::Bulk)
        attention.heard();
    const auto* subscription = subscriptionTo(message);
    if (subscription == nullptr)
        return MessageCacheAccess::put(messageCache, std::move(message));
    for (const auto& handler : subscription->handlers)
        handler(message);
    if (subscription->keeper)
        return subscription->keeper(kept(std::move(message)));
    partialBudget.recycle(MessageAccess::takeFields(message));
}

DistributedSystem::State::Subscription& DistributedSystem::State::newSubscription(std::string_view message)
{
    Subscription& subscription = subscriptions[std::string(message)];
    const auto* own = ownMessageSet->find(message);
    subscription.isOwnCommand = own != nullptr && own->role == Role::Command;
    return subscription;
}

/// Null when there is none. A command has been judged by token, order and age, and a report has not: who waits for a command of ours does
/// not get what a peer reports by the same name.
const DistributedSystem::State::Subscription* DistributedSystem::State::subscriptionTo(const Message& message)
{
    // The one that was asked for last is most often asked for next.
    if (lastSubscription == subscriptions.end() || lastSubscription->first != message.name())
        lastSubscription = subscriptions.find(message.name());
    if (lastSubscription == subscriptions.end() || (lastSubscription->second.isOwnCommand && !message.id().isCommand()))
        return nullptr;
    return &lastSubscription->second;
}

/// Its buffer comes back from whichever thread lets go of it last.
std::shared_ptr<const Message> DistributedSystem::State::kept(Message&& message)
{
    struct Kept {
        Message message;
        std::shared_ptr<cache::ReturnedBuffers> returned;

        Kept(Message&& given, std::shared_ptr<cache::ReturnedBuffers> back) : message(std::move(given)), returned(std::move(back)) {}
        ~Kept() { returned->put(MessageAccess::takeFields(message)); }
        Kept(const Kept&) = delete;
        Kept& operator=(const Kept&) = delete;
    };
    auto both = std::make_shared<Kept>(std::move(message), returned);
    const auto* inside = &both->message;
    return {std::move(both), inside};
}

void DistributedSystem::State::takeReturned()
{
    returned->take(returnedHere);
    for (auto& used : returnedHere)
        partialBudget.recycle(std::move(used));
    returnedHere.clear();
}

void DistributedSystem::State::drainOutbox()
{
    turned();
    outbox.take(letters);
    const bool isBurst = letters.size() > 1;
    if (isBurst)
        gather(true);
    for (auto& letter : letters) {
        if (letter.target.isBroadcast())
            publishNow(std::move(letter.message));
        else
            sendNow(letter.target, std::move(letter.message));
    }
    letters.clear();
    if (isBurst)
        gather(false);
}

/// What other threads handed over before a stall does not leave after it, as little as what was queued. It goes on to peers that did not
/// miss us.
void DistributedSystem::State::withdrawOutbox(std::chrono::nanoseconds gap)
{
    cache::Outbox::Letters handed;
    outbox.withdraw(handed);
    const auto withdrawn = [&](DeviceId peer, const Message& message) {
        // A handler may send, and the stall is still in hand.
        asio::post(context, [this, event = sendFailed(peer, message.definition().name, "this device itself did not run")]() mutable {
            tell(std::move(event));
        });
    };
    for (auto& letter : handed) {
        if (letter.target.isBroadcast()) {
            for (const auto& [peer, one] : modules)
                if (one->isConcernedBy(gap))
                    withdrawn(peer, letter.message);
            publishNow(std::move(letter.message), gap);
        } else if (const auto* one = module(letter.target); one != nullptr && one->isConcernedBy(gap)) {
            withdrawn(letter.target, letter.message);
        } else {
            sendNow(letter.target, std::move(letter.message));
        }
    }
}

/// What is sent meanwhile leaves at its end, in the order of its priority and in one write.
void DistributedSystem::State::gather(bool begins)
{
    for (auto& [peer, one] : modules)
        one->gather(begins);
}

/// What is said to one peer may have its answer at once; what is published asks nobody.
Result<void> DistributedSystem::State::sendBy(system::DistributedModule& one, Message&& message)
{
    if (message.definition().priority != Priority::Bulk)
        attention.asked();
    return one.send(std::move(message));
}

void DistributedSystem::State::sendNow(DeviceId target, Message&& message)
{
    auto* one = module(target);
    if (one == nullptr)
        return;                                     // stop() was quicker
    const auto set = MessageAccess::setIn(message); // that the name lives in
    const auto& name = message.definition().name;
    const auto sent = sendBy(*one, std::move(message));
    if (!sent)
        tell(sendFailed(target, name, sent.error().what));
}

SessionEvent DistributedSystem::State::sendFailed(DeviceId peer, const std::string& message, std::string_view detail)
{
    SessionEvent event;
    event.kind = SessionEvent::Kind::SendFailed;
    event.at = std::chrono::steady_clock::now();
    event.peer = peer;
    event.message = message;
    event.count = 1;
    event.detail = detail;
    return event;
}

/// Copied for all but the last: an image that goes to one peer is not copied at all. What a single session refuses is no failure of a
/// publication. Sessions that a stall of `stall` concerns are left out.
void DistributedSystem::State::publishNow(Message message, std::chrono::nanoseconds stall)
{
    system::DistributedModule* last = nullptr;
    for (auto& [peer, one] : modules) {
        if ((!carriesMessages(one->state()) && one->state() != SessionState::Reconnecting) || one->isConcernedBy(stall))
            continue;
        if (last != nullptr)
            (void)last->send(Message(message));
        last = one.get();
    }
    if (last != nullptr)
        (void)last->send(std::move(message));
}

/// The network thread's sessions that carry messages.
std::size_t DistributedSystem::State::openSessions() const
{
    return static_cast<std::size_t>(
        std::count_if(modules.begin(), modules.end(), [](const auto& entry) { return carriesMessages(entry.second->state()); }));
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

std::vector<std::string> DistributedSystem::State::measuredLines() const
{
    std::vector<std::string> lines;
    for (const auto& [peer, one] : modules)
        lines.insert(lines.end(), static_cast<std::size_t>(one->measurementsRunning()), one->peer().name);
    return lines;
}

} // namespace liena
