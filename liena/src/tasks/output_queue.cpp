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
    if (entry.history > 0)
        dropSuperseded(waiting, entry);
    const bool session = entry.message.header.message.isSessionManagement();
    const auto size = entry.message.part.size();
    if (!session && (m_count >= m_limits.messages || m_bytes + size > m_limits.bytes))
        return false;
    ++m_count;
    m_bytes += size;
    waiting.push_back({std::move(entry), {}});
    return true;
}

void OutputQueue::dropSuperseded(Class& waiting, const Entry& entry)
{
    const auto same = [&](const Waiting& other) {
        return !other.encoder.begun() && other.entry.message.header.message == entry.message.header.message &&
               other.entry.message.header.target == entry.message.header.target;
    };
    auto count = static_cast<std::size_t>(std::count_if(waiting.begin(), waiting.end(), same));
    for (; count >= entry.history; --count)
        drop(waiting, std::find_if(waiting.begin(), waiting.end(), same), Fate::Superseded);
}

bool OutputQueue::appendNext(std::size_t maximumSegment, std::chrono::steady_clock::time_point now, std::vector<std::byte>& out)
{
    for (auto& waiting : m_classes) {
        while (!waiting.empty() && !waiting.front().encoder.begun() && waiting.front().entry.expires &&
               *waiting.front().entry.expires <= now)
            drop(waiting, waiting.begin(), Fate::Expired);
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
    for (auto& waiting : m_classes)
        for (std::size_t i = waiting.size(); i-- > 0;)
            if (!waiting[i].entry.message.header.message.isSessionManagement())
                drop(waiting, waiting.begin() + static_cast<std::ptrdiff_t>(i), Fate::Discarded);
}

} // namespace liena::tasks
