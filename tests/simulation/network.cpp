// Paths, attempts to connect, and datagrams.
#include "network.hpp"

#include "connection.hpp"

#include <utility>

namespace liena::simulation {

using namespace std::chrono_literals;

namespace {

constexpr std::size_t wirePacket = 1448;
constexpr auto bottleneckQueue = 300ms;
constexpr auto lostSyn = 1s;        ///< TCP's first time-out for a SYN
constexpr auto lostSegment = 200ms; ///< and for a segment
constexpr int lastStep = 5;         ///< SYN, its answer, the client's hello, the server's, the client's finish

} // namespace

Network::Network(VirtualTime& time, HostPrograms& programs, SeededRandom random, std::size_t hosts)
    : m_time(time), m_programs(programs), m_random(random), m_hosts(hosts), m_paths(hosts * hosts)
{}

Network::~Network() = default;

std::optional<Instant> Network::arrival(HostIndex from, HostIndex to, std::size_t bytes)
{
    auto& way = path(from, to);
    bool lost = way.cut != 0;
    if (way.loss != 0)
        for (std::size_t sent = 0; sent <= bytes && !lost; sent += wirePacket)
            lost = m_random.chance(way.loss);
    auto departs = m_time.now();
    if (!lost && way.rate != 0) {
        departs = std::max(departs, way.free);
        lost = departs - m_time.now() > bottleneckQueue;
        departs += Nanoseconds(static_cast<std::int64_t>(bytes * 1'000'000'000U / way.rate));
        if (!lost)
            way.free = departs;
    }
    if (lost) {
        ++m_lost;
        return std::nullopt;
    }
    auto arrives = departs + way.delay;
    if (way.jitter > 0ns)
        arrives += m_random.between(0ns, way.jitter);
    return std::max(arrives, way.heldUntil);
}

std::uint64_t Network::connect(HostIndex from, HostIndex to, Nanoseconds limit, Connected done)
{
    const auto number = ++m_numbers;
    const auto deadline = m_time.now() + limit;
    m_attempts.emplace(number, Attempt{from, to, 0, deadline, std::move(done), 0});
    m_time.at(deadline, [this, number] {
        const auto found = m_attempts.find(number);
        if (found != m_attempts.end())
            finish(number, 0,
                   found->second.step >= 2 ? ConnectFailure{ProbeResult::PeerSilent, "connected, and then silence"}
                                           : ConnectFailure{ProbeResult::HostUnreachable, "no answer"});
    });
    advance(number);
    return number;
}

/// Sends what the step at hand sends, again and again until it arrives.
void Network::advance(std::uint64_t number)
{
    const auto found = m_attempts.find(number);
    if (found == m_attempts.end())
        return;
    const auto& attempt = found->second;
    const bool onward = attempt.step % 2 == 0;
    const auto arrives = arrival(onward ? attempt.from : attempt.to, onward ? attempt.to : attempt.from, attempt.step < 2 ? 60 : 1400);
    if (arrives)
        m_time.at(*arrives, [this, number] { stepArrived(number); });
    else
        m_time.after(attempt.step < 2 ? Nanoseconds(lostSyn) : Nanoseconds(lostSegment), [this, number] { advance(number); });
}

void Network::stepArrived(std::uint64_t number)
{
    const auto found = m_attempts.find(number);
    if (found == m_attempts.end())
        return;
    auto& attempt = found->second;
    const bool onward = attempt.step % 2 == 0;
    if (onward && attempt.step < 4) {
        const auto reception = m_programs.reception(attempt.to);
        if (reception == Reception::Silent)
            return; // the deadline ends it
        if (reception == Reception::Refuses)
            return m_time.after(path(attempt.to, attempt.from).delay, [this, number] {
                finish(number, 0, {ProbeResult::ConnectionRefused, "connection refused"});
            });
    }
    ++attempt.step;
    if (attempt.step == 3) // TLS needs the program itself, not only its kernel
        return m_programs.whenRunning(attempt.to, [this, number] { advance(number); });
    if (attempt.step == lastStep - 1)
        return m_programs.whenRunning(attempt.from, [this, number] {
            const auto waiting = m_attempts.find(number);
            if (waiting != m_attempts.end())
                finish(number, make(waiting->second.from, waiting->second.to), {});
        });
    advance(number);
}

void Network::finish(std::uint64_t number, ConnectionNumber made, ConnectFailure failure)
{
    const auto found = m_attempts.find(number);
    if (found == m_attempts.end())
        return;
    m_programs.whenRunning(found->second.from, [this, number, from = found->second.from, made, failure] {
        const auto waiting = m_attempts.find(number);
        if (waiting != m_attempts.end()) {
            const auto done = std::move(waiting->second.done);
            m_attempts.erase(waiting);
            done(made, failure);
        } else if (auto* unwanted = find(made)) {
            unwanted->close(from);
        }
    });
}

ConnectionNumber Network::make(HostIndex from, HostIndex to)
{
    const auto number = ++m_numbers;
    m_connections.emplace(number, std::make_unique<Connection>(*this, number, from, to, m_random.fork()));
    m_programs.whenRunning(to, [this, number, from, to] {
        if (find(number) != nullptr)
            m_programs.accepted(to, from, number);
    });
    return number;
}

Connection* Network::find(ConnectionNumber number)
{
    const auto found = m_connections.find(number);
    return found != m_connections.end() ? found->second.get() : nullptr;
}

void Network::forgetLater(ConnectionNumber number)
{
    m_time.after(0ns, [this, number] { m_connections.erase(number); });
}

void Network::sendDatagram(HostIndex from, HostIndex to, std::vector<std::byte> bytes)
{
    if (path(from, to).noDatagrams)
        return;
    const auto arrives = arrival(from, to, bytes.size());
    if (!arrives)
        return;
    m_time.at(*arrives, [this, from, to, bytes = std::move(bytes)]() mutable {
        if (!isCut(from, to) && m_programs.reception(to) == Reception::Listens)
            m_programs.whenRunning(to, [this, from, to, kept = std::move(bytes)] { m_programs.datagramArrived(to, from, kept); });
    });
}

std::vector<Connection*> Network::between(HostIndex a, HostIndex b)
{
    std::vector<Connection*> found;
    for (auto& [number, connection] : m_connections)
        if ((connection->maker() == a && connection->acceptor() == b) || (connection->maker() == b && connection->acceptor() == a))
            found.push_back(connection.get());
    return found;
}

void Network::hostEnded(HostIndex host, bool tells)
{
    std::erase_if(m_attempts, [host](const auto& entry) { return entry.second.from == host; });
    std::vector<Connection*> ended;
    for (auto& [number, connection] : m_connections)
        if (connection->maker() == host || connection->acceptor() == host)
            ended.push_back(connection.get());
    for (auto* connection : ended)
        connection->programEnded(host, tells);
}

bool Network::reset(HostIndex a, HostIndex b, std::uint64_t which)
{
    const auto found = between(a, b);
    if (found.empty())
        return false;
    found[which % found.size()]->reset();
    return true;
}

bool Network::holdReading(HostIndex a, HostIndex b, std::uint64_t which, Instant until)
{
    const auto found = between(a, b);
    if (found.empty())
        return false;
    found[which % found.size()]->holdReading(until);
    return true;
}

} // namespace liena::simulation
