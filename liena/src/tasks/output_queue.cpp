// Order, history, lifespan and bounds of what leaves.
#include "tasks/output_queue.hpp"

#include <algorithm>

namespace liena::tasks {

namespace {

void place(OutputBatch& out, const protocol::Segment& segment, const std::shared_ptr<const void>& owner) { out.append(segment, owner); }

void place(std::vector<std::byte>& out, const protocol::Segment& segment, const std::shared_ptr<const void>& /*owner*/)
{
    protocol::appendTo(out, segment);
}

} // namespace

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

OutputQueue::Stream& OutputQueue::streamOf(Class& ofRank, const Entry& entry)
{
    const bool takesTurns = entry.rank == Rank::Status || entry.rank == Rank::Bulk;
    return ofRank.streams[takesTurns ? entry.message.header.message.number : std::uint16_t{0}];
}

bool OutputQueue::push(Entry&& entry)
{
    auto& ofRank = m_classes[static_cast<std::size_t>(entry.rank)];
    auto& stream = streamOf(ofRank, entry);
    const bool session = entry.message.header.message.isSessionManagement();
    const auto size = entry.message.size();
    const auto gone = superseded(stream, entry);
    std::size_t freed = 0;
    for (const auto at : gone)
        freed += stream.waiting[at].part().size();
    if (!session && (ofRank.bounded.messages - gone.size() >= m_limits.messages || ofRank.bounded.bytes - freed + size > m_limits.bytes))
        return false; // and what it would have replaced still leaves
    if (stream.waiting.empty())
        base::append(ofRank.turns, &stream);
    enters(entry, size);
    Waiting place;
    base::append(stream.waiting, std::move(place));
    stream.waiting.back().entry = std::move(entry); // a message is moved once
    for (auto at = gone.rbegin(); at != gone.rend(); ++at)
        drop(stream, *at, Fate::Superseded);
    return true;
}

bool OutputQueue::waits(Rank rank, std::uint16_t number) const
{
    for (const auto& [place, stream] : m_classes[static_cast<std::size_t>(rank)].streams)
        for (const auto& waiting : stream.waiting)
            if (waiting.entry.message.header.message.number == number)
                return true;
    return false;
}

void OutputQueue::enters(const Entry& entry, std::size_t size)
{
    ++m_count;
    m_bytes += size;
    if (entry.message.header.message.isSessionManagement())
        return;
    auto& bounded = m_classes[static_cast<std::size_t>(entry.rank)].bounded;
    ++bounded.messages;
    bounded.bytes += size;
}

void OutputQueue::leaves(const Entry& entry, std::size_t size)
{
    --m_count;
    m_bytes -= size;
    if (entry.message.header.message.isSessionManagement())
        return;
    auto& bounded = m_classes[static_cast<std::size_t>(entry.rank)].bounded;
    --bounded.messages;
    bounded.bytes -= size;
}

/// The places of those that `entry` takes the place of, in ascending order.
OutputQueue::Places OutputQueue::superseded(const Stream& stream, const Entry& entry)
{
    Places places;
    if (entry.history == 0)
        return places;
    for (std::size_t i = 0; i < stream.waiting.size(); ++i) {
        const auto& other = stream.waiting[i];
        if (!other.encoder.begun() && other.entry.message.header.message == entry.message.header.message &&
            other.entry.message.header.target == entry.message.header.target)
            places.push_back(i);
    }
    places.resize(places.size() >= entry.history ? places.size() - entry.history + 1 : 0);
    return places;
}

bool OutputQueue::appendNext(std::size_t maximumSegment, std::chrono::steady_clock::time_point now, OutputBatch& out)
{
    return appendNextTo(out, maximumSegment, now);
}

bool OutputQueue::appendNext(std::size_t maximumSegment, std::chrono::steady_clock::time_point now, std::vector<std::byte>& out)
{
    return appendNextTo(out, maximumSegment, now);
}

template <typename Out>
bool OutputQueue::appendNextTo(Out& out, std::size_t maximumSegment, std::chrono::steady_clock::time_point now)
{
    for (auto& ofRank : m_classes) {
        if (expire(ofRank, maximumSegment, now, out))
            return true;
        if (ofRank.turns.empty())
            continue;
        take(ofRank, maximumSegment, out);
        return true;
    }
    return false;
}

/// Until the stream whose turn it is has something that may still leave. True when a message that was begun is abandoned: that is a
/// segment, too.
template <typename Out>
bool OutputQueue::expire(Class& from, std::size_t maximumSegment, std::chrono::steady_clock::time_point now, Out& out)
{
    while (!from.turns.empty()) {
        auto& stream = *from.turns.front();
        if (!isExpired(stream.waiting.front(), now))
            return false;
        const bool begun = stream.waiting.front().encoder.begun();
        const auto header = stream.waiting.front().entry.message.header;
        drop(stream, 0, Fate::Expired);
        if (stream.waiting.empty())
            endTurn(from);
        if (begun) {
            const auto abandon = m_abandoning(header);
            place(out, protocol::DatagramEncoder().next(abandon.header, abandon.bytes(), maximumSegment), nullptr);
            return true;
        }
    }
    return false;
}

/// A control message leaves in one segment, however small those of others are: the peer refuses one that was cut (protocol section 3).
template <typename Out>
void OutputQueue::take(Class& from, std::size_t maximumSegment, Out& out)
{
    auto& stream = *from.turns.front();
    if (stream.credit <= 0)
        stream.credit += static_cast<std::ptrdiff_t>(maximumSegment + protocol::headerSize); // just what a full segment takes
    auto& front = stream.waiting.front();
    if (!front.begun && front.entry.message.part.size() >= OutputBatch::longBody)
        front.begun = std::make_shared<const FieldBytes>(std::move(front.entry.message.part));
    const auto part = front.part();
    const auto longest = front.entry.rank == Rank::Control ? protocol::maximumBody : maximumSegment;
    const auto segment = front.encoder.next(front.entry.message.header, part, longest);
    place(out, segment, segment.isLent ? std::shared_ptr<const void>(front.entry.message.lent) : front.begun);
    stream.credit -= static_cast<std::ptrdiff_t>(segment.size());
    if (segment.last) {
        if (!front.entry.message.header.message.isSessionManagement()) {
            m_left.bytes += part.size();
            m_left.largest = std::max(m_left.largest, part.size());
        }
        leaves(front.entry, part.size());
        stream.waiting.pop_front();
    }
    if (stream.waiting.empty()) {
        endTurn(from);
    } else if (stream.credit <= 0) {
        from.turns.pop_front();
        base::append(from.turns, &stream);
    }
}

/// Of a stream that has nothing more to send.
void OutputQueue::endTurn(Class& of)
{
    of.turns.front()->credit = 0;
    base::settle(of.turns.front()->waiting);
    of.turns.pop_front();
}

bool OutputQueue::isExpired(const Waiting& waiting, std::chrono::steady_clock::time_point now)
{
    return waiting.entry.expires && *waiting.entry.expires <= now;
}

/// Whoever calls sees to the stream's turn when nothing is left of it.
void OutputQueue::drop(Stream& stream, std::size_t at, Fate fate)
{
    const auto dropped = stream.waiting.begin() + static_cast<std::ptrdiff_t>(at);
    leaves(dropped->entry, dropped->part().size());
    const auto entry = std::move(dropped->entry);
    stream.waiting.erase(dropped);
    m_report(entry, fate);
}

std::size_t OutputQueue::waiting(Rank rank) const
{
    std::size_t count = 0;
    for (const auto& [number, stream] : m_classes[static_cast<std::size_t>(rank)].streams)
        count += stream.waiting.size();
    return count;
}

template <typename Visit>
void OutputQueue::forEachStream(Visit visit)
{
    for (auto& ofRank : m_classes) {
        for (auto& [number, stream] : ofRank.streams)
            visit(stream);
        ofRank.turns.erase(
            std::remove_if(ofRank.turns.begin(), ofRank.turns.end(), [](const Stream* stream) { return stream->waiting.empty(); }),
            ofRank.turns.end());
    }
}

void OutputQueue::restart()
{
    forEachStream([](Stream& stream) {
        if (!stream.waiting.empty())
            stream.waiting.front().encoder = {};
    });
}

void OutputQueue::discard(Rank rank)
{
    // A control message is one segment, so none of them is ever half sent.
    auto& ofRank = m_classes[static_cast<std::size_t>(rank)];
    for (auto& [number, stream] : ofRank.streams)
        while (!stream.waiting.empty())
            drop(stream, 0, Fate::Discarded);
    ofRank.turns.clear();
}

void OutputQueue::discardApplication()
{
    std::vector<protocol::EncodedMessage> abandoned;
    forEachStream([&](Stream& stream) {
        for (std::size_t i = stream.waiting.size(); i-- > 0;) {
            const auto& waiting = stream.waiting[i];
            if (waiting.entry.message.header.message.isSessionManagement())
                continue;
            if (waiting.encoder.begun())
                abandoned.push_back(m_abandoning(waiting.entry.message.header));
            drop(stream, i, Fate::Discarded);
        }
    });
    for (auto& message : abandoned)
        push({std::move(message), Rank::Safety, 0, std::nullopt, {}});
}

} // namespace liena::tasks
