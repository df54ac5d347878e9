// Which stream goes on which lane.
#include "tasks/bulk_lanes.hpp"

#include <algorithm>
#include <numeric>

namespace liena::tasks {

using namespace std::chrono_literals;

namespace {

constexpr auto connectLimit = 1s;
constexpr auto retryDelay = 50ms;
constexpr std::size_t fullSegment = 16384 - protocol::headerSize; // and its header: one TLS record
constexpr std::size_t batch = 65536;

} // namespace

BulkLanes::BulkLanes(boost::asio::io_context& io, TopologyDevice peer, std::shared_ptr<security::TlsIdentity> identity, std::uint8_t dscp,
                     Commons commons, Handlers handlers)
    : m_io(io),
      m_peer(std::move(peer)),
      m_identity(std::move(identity)),
      m_settings{fullSegment, batch, transport::TcpChannel::Traffic::Bulk, dscp, &commons.workers, &commons.interfaces},
      m_handlers(std::move(handlers)),
      m_retry(io)
{}

bool BulkLanes::push(OutputQueue::Entry&& entry)
{
    const auto place = placeFor(entry.message.header.message.number, entry.rank == Rank::Measuring, std::chrono::steady_clock::now());
    const bool taken = m_lanes[place]->push(std::move(entry));
    connect();
    return taken;
}

std::size_t BulkLanes::placeFor(std::uint16_t number, bool measures, Instant now)
{
    const auto known = m_streams.find(number);
    const bool isKnown = known != m_streams.end();
    // What measures keeps no order.
    const bool stays = isKnown && !measures && (wasUsed(known->second, now) || !m_lanes[known->second.place]->isDelivered());
    const auto place = stays ? known->second.place : measures ? placeBehindOthers(now) : choosePlace(now);
    const bool mayComeIntoUse = !isKnown || !wasUsed(known->second, now) || known->second.place != place;
    m_streams[number] = {place, now, measures};
    if (mayComeIntoUse)
        shareLimit();
    return place;
}

/// One that no stream uses, a new one, or the one with least before it.
std::size_t BulkLanes::choosePlace(Instant now)
{
    for (std::size_t place = 0; place < m_lanes.size(); ++place)
        if (isFree(place, now))
            return place;
    if (m_lanes.size() < m_wanted.want(streamsInUse(now) + 1, now))
        return addLane(now);
    const auto least = std::min_element(m_lanes.begin(), m_lanes.end(),
                                        [](const auto& a, const auto& b) { return a->queue().bytes() < b->queue().bytes(); });
    return static_cast<std::size_t>(least - m_lanes.begin());
}

/// On the lane that another stream used last, or still uses.
std::size_t BulkLanes::placeBehindOthers(Instant now)
{
    const Stream* newest = nullptr;
    for (const auto& [number, stream] : m_streams) {
        const bool uses = wasUsed(stream, now) || m_lanes[stream.place]->queue().waiting(Rank::Bulk) > 0;
        if (!stream.measures && uses && (newest == nullptr || stream.lastUsed > newest->lastUsed))
            newest = &stream;
    }
    return newest != nullptr ? newest->place : choosePlace(now);
}

bool BulkLanes::isInUse(std::size_t place, Instant now) const
{
    const bool hasStream = std::any_of(m_streams.begin(), m_streams.end(),
                                       [&](const auto& stream) { return stream.second.place == place && wasUsed(stream.second, now); });
    return hasStream || !m_lanes[place]->isDelivered();
}

/// For a stream that does not measure, and does not wait for one that does.
bool BulkLanes::isFree(std::size_t place, Instant now) const
{
    const auto uses = [&](bool measures) {
        return std::any_of(m_streams.begin(), m_streams.end(), [&](const auto& stream) {
            return stream.second.place == place && stream.second.measures == measures && wasUsed(stream.second, now);
        });
    };
    return !uses(false) && (m_lanes[place]->isDelivered() || (uses(true) && m_lanes[place]->queue().waiting(Rank::Bulk) == 0));
}

/// Without those that measure.
std::size_t BulkLanes::streamsInUse(Instant now) const
{
    return static_cast<std::size_t>(std::count_if(m_streams.begin(), m_streams.end(), [&](const auto& stream) {
        return !stream.second.measures && (wasUsed(stream.second, now) || !m_lanes[stream.second.place]->isDelivered());
    }));
}

/// Where all that there are are in use.
std::size_t BulkLanes::addLane(Instant now)
{
    const double beginning = beginningBeside(knownRate(now), m_lanes.size());
    const auto number = static_cast<std::uint8_t>(m_lanes.size() + 1);
    const auto again = [this] { m_retry.after(retryDelay, [this] { connect(); }); };
    OutputLane::Handlers handlers;
    handlers.up = [this] { shareLimit(); };
    handlers.failed = [again](const transport::ConnectionFailure&) { again(); };
    handlers.lost = [this, number, again](const std::string& detail, bool) {
        m_arrivals.restart();
        m_handlers.lost(number, detail);
        again();
    };
    handlers.dropped = m_handlers.dropped;
    handlers.abandoning = m_handlers.abandoning;
    m_lanes.push_back(std::make_unique<OutputLane>(m_io, m_peer, m_identity, m_settings, std::move(handlers)));
    m_lanes.back()->beginAt(beginning);
    return m_lanes.size() - 1;
}

void BulkLanes::connect()
{
    if (!m_handlers.mayConnect())
        return;
    for (std::size_t i = 0; i < m_lanes.size(); ++i) {
        auto& lane = *m_lanes[i];
        if (!lane.isUp() && !lane.isConnecting() && !lane.queue().empty())
            lane.connect(m_handlers.attach(static_cast<std::uint8_t>(i + 1)), connectLimit, m_handlers.known());
    }
}

void BulkLanes::retire(std::chrono::steady_clock::time_point now)
{
    const auto wanted = m_wanted.want(streamsInUse(now), now);
    auto excess = connected();
    for (auto place = m_lanes.size(); place-- > 1 && excess > wanted;)
        if (m_lanes[place]->isUp() && !isInUse(place, now)) {
            m_lanes[place]->close(0ns);
            --excess;
        }
}

void BulkLanes::discardApplication()
{
    for (auto& lane : m_lanes)
        lane->queue().discardApplication();
}

void BulkLanes::close()
{
    m_retry.cancel();
    for (auto& lane : m_lanes)
        lane->close(0ns);
    m_streams.clear();
    m_arrivals.restart();
}

std::size_t BulkLanes::connected() const
{
    return static_cast<std::size_t>(std::count_if(m_lanes.begin(), m_lanes.end(), [](const auto& lane) { return lane->isUp(); }));
}

std::size_t BulkLanes::queuedMessages() const
{
    return std::accumulate(m_lanes.begin(), m_lanes.end(), std::size_t{0},
                           [](std::size_t sum, const auto& lane) { return sum + lane->queue().size(); });
}

std::uint64_t BulkLanes::bytesSent() const
{
    return std::accumulate(m_lanes.begin(), m_lanes.end(), std::uint64_t{0},
                           [](std::uint64_t sum, const auto& lane) { return sum + lane->bytesSent(); });
}

std::size_t BulkLanes::queuedBytes() const
{
    return std::accumulate(m_lanes.begin(), m_lanes.end(), std::size_t{0},
                           [](std::size_t sum, const auto& lane) { return sum + lane->queue().bytes(); });
}

std::vector<LaneRate> BulkLanes::laneRates(Instant now) const
{
    std::vector<LaneRate> rates;
    for (std::size_t place = 0; place < m_lanes.size(); ++place)
        rates.push_back({m_lanes[place]->steadyRate(), m_lanes[place]->knownRate(), isInUse(place, now)});
    return rates;
}

std::optional<KnownRate> BulkLanes::knownRate(Instant now) const { return togetherOf(laneRates(now)); }

std::vector<BulkStream> BulkLanes::streamRates(Instant now) const
{
    std::vector<PlacedStream> inUse;
    for (const auto& [number, stream] : m_streams)
        if (!stream.measures && wasUsed(stream, now))
            inUse.push_back({number, stream.place});
    std::vector<std::optional<double>> rates;
    for (const auto& lane : m_lanes) {
        const auto known = lane->knownRate();
        rates.push_back(known ? std::optional(known->bytesPerSecond) : std::nullopt);
    }
    return ratesOf(inUse, rates);
}

bool BulkLanes::waits() const
{
    return std::any_of(m_lanes.begin(), m_lanes.end(), [](const auto& lane) { return lane->queue().waiting(Rank::Bulk) > 0; });
}

OutputQueue::Left BulkLanes::left() const
{
    OutputQueue::Left sum;
    for (const auto& lane : m_lanes) {
        const auto ofLane = lane->left();
        sum.bytes += ofLane.bytes;
        sum.largest += ofLane.largest;
    }
    return sum;
}

void BulkLanes::arrivalsReported(std::chrono::nanoseconds window, std::uint64_t received, Elsewhere sent,
                                 std::chrono::nanoseconds roundTrip)
{
    const auto ours = left();
    std::uint64_t held = 0;
    for (const auto& lane : m_lanes)
        held += lane->channel() != nullptr ? lane->channel()->unacknowledged() : 0;
    m_arrivals.reported({.window = window,
                         .received = received,
                         .sent = ours.bytes + sent.prompt + sent.packets,
                         .packets = sent.packets,
                         .held = held,
                         .largest = ours.largest,
                         .roundTrip = roundTrip});
    shareLimit();
}

/// With each report, when a lane comes up, which has no share before, and when one may come into use.
void BulkLanes::shareLimit()
{
    const auto shares = sharesOf(m_arrivals.bytesPerSecond(), laneRates(std::chrono::steady_clock::now()));
    for (std::size_t place = 0; place < m_lanes.size(); ++place)
        m_lanes[place]->limitRate(shares[place]);
}

} // namespace liena::tasks
