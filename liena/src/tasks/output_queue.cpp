// Order, history, lifespan and bounds of what leaves.
#include "tasks/output_queue.hpp"

#include <algorithm>

namespace liena::tasks {

Rank rankOf(Priority priority)
{
    switch (priority) {
    case Priority::Safety:
        return Rank::Safety;
    case Priority::Control:
        return Rank::Control;
    case Priority::Status:
        return Rank::Status;
    case Priority::Bulk:
        break;
    }
    return Rank::Bulk;
}

bool OutputQueue::push(Entry entry)
{
    auto& waiting = m_classes[static_cast<std::size_t>(entry.rank)];
    const bool session = entry.message.header.message.isSessionManagement();
    const auto size = entry.message.part.size();
    const auto gone = superseded(waiting, entry);
    std::size_t freed = 0;
    for (const auto at : gone)
        freed += waiting[at].entry.message.part.size();
    if (!session && (m_count - gone.size() >= m_limits.messages || m_bytes - freed + size > m_limits.bytes))
        return false; // and what it would have replaced still leaves
    for (auto at = gone.rbegin(); at != gone.rend(); ++at)
        drop(waiting, waiting.begin() + static_cast<std::ptrdiff_t>(*at), Fate::Superseded);
    ++m_count;
    m_bytes += size;
    waiting.push_back({std::move(entry), {}});
    return true;
}

/// The places of those that `entry` takes the place of, in ascending order.
std::vector<std::size_t> OutputQueue::superseded(const Class& waiting, const Entry& entry)
{
    std::vector<std::size_t> places;
    if (entry.history == 0)
        return places;
    for (std::size_t i = 0; i < waiting.size(); ++i) {
        const auto& other = waiting[i];
        if (!other.encoder.begun() && other.entry.message.header.message == entry.message.header.message &&
            other.entry.message.header.target == entry.message.header.target)
            places.push_back(i);
    }
    places.resize(places.size() >= entry.history ? places.size() - entry.history + 1 : 0);
    return places;
}

bool OutputQueue::appendNext(std::size_t maximumSegment, std::chrono::steady_clock::time_point now, std::vector<std::byte>& out)
{
    for (auto& waiting : m_classes) {
        while (!waiting.empty() && isExpired(waiting.front(), now)) {
            const bool begun = waiting.front().encoder.begun();
            const auto header = waiting.front().entry.message.header;
            drop(waiting, waiting.begin(), Fate::Expired);
            if (begun) {
                protocol::DatagramEncoder().appendSegment(m_abandoning(header), maximumSegment, out);
                return true;
            }
        }
        if (waiting.empty())
            continue;
        auto& front = waiting.front();
        if (front.encoder.appendSegment(front.entry.message, maximumSegment, out)) {
            m_bytes -= front.entry.message.part.size();
            --m_count;
            waiting.pop_front();
        }
        return true;
    }
    return false;
}

bool OutputQueue::isExpired(const Waiting& waiting, std::chrono::steady_clock::time_point now)
{
    return waiting.entry.expires && *waiting.entry.expires <= now;
}

void OutputQueue::drop(Class& waiting, Class::iterator at, Fate fate)
{
    m_bytes -= at->entry.message.part.size();
    --m_count;
    const auto entry = std::move(at->entry);
    waiting.erase(at);
    m_report(entry, fate);
}

void OutputQueue::restart()
{
    for (auto& waiting : m_classes)
        if (!waiting.empty())
            waiting.front().encoder = {};
}

void OutputQueue::discard(Rank rank)
{
    // A control message is one segment, so none of them is ever half sent.
    auto& waiting = m_classes[static_cast<std::size_t>(rank)];
    while (!waiting.empty())
        drop(waiting, waiting.begin(), Fate::Discarded);
}

void OutputQueue::discardApplication()
{
    std::vector<protocol::EncodedMessage> abandoned;
    for (auto& waiting : m_classes)
        for (std::size_t i = waiting.size(); i-- > 0;) {
            if (waiting[i].entry.message.header.message.isSessionManagement())
                continue;
            if (waiting[i].encoder.begun())
                abandoned.push_back(m_abandoning(waiting[i].entry.message.header));
            drop(waiting, waiting.begin() + static_cast<std::ptrdiff_t>(i), Fate::Discarded);
        }
    for (auto& message : abandoned)
        push({std::move(message), Rank::Safety, 0, std::nullopt, {}});
}

} // namespace liena::tasks
