// The course of a measurement, and what must hold in it.
#include "scale/scale_row.hpp"

#include "runner/statistics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <thread>

namespace liena::bench {

namespace {

using Clock = std::chrono::steady_clock;

double meanOf(const std::vector<double>& values)
{
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double secondsSince(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

void settle(double seconds) { std::this_thread::sleep_for(std::chrono::duration<double>(seconds)); }

double loadOver(const Mesh& mesh, double seconds)
{
    const auto start = Clock::now();
    const auto before = mesh.processorSeconds();
    settle(seconds);
    return (mesh.processorSeconds() - before) / secondsSince(start);
}

void require(ScaleRow& row, bool holds, std::string fault)
{
    if (!holds)
        row.faults.push_back(fmt::format("{} devices: {}", row.devices, std::move(fault)));
}

void requireAllOpen(ScaleRow& row, const MeshCounts& counts)
{
    require(row, counts.sessionEnds == row.sessionEnds,
            fmt::format("{} of {} ends of sessions are open", counts.sessionEnds, row.sessionEnds));
}

void measureClosed(MeshLoads& loads, const Mesh& mesh, const ScaleOptions& options)
{
    settle(0.5);
    loads.closed = loadOver(mesh, options.seconds);
}

void measureIdle(ScaleRow& row, MeshLoads& loads, Mesh& mesh, const ScaleOptions& options)
{
    const auto before = mesh.counts();
    loads.idle.push_back(loadOver(mesh, options.seconds));
    const auto after = mesh.counts();
    loads.heartbeatsPerSecond += static_cast<double>(after.heartbeats - before.heartbeats) / (after.at - before.at) / options.rounds;
    require(row, after.heartbeats > before.heartbeats, "no heartbeat was heard");
}

std::vector<std::int64_t> measureAsking(ScaleRow& row, MeshLoads& loads, Mesh& mesh, const ScaleOptions& options)
{
    const auto before = mesh.counts();
    mesh.ask(true);
    loads.asking.push_back(loadOver(mesh, options.seconds));
    const auto during = mesh.counts();
    loads.messagesPerSecond += 2 * static_cast<double>(during.answered - before.answered) / (during.at - before.at) / options.rounds;
    mesh.ask(false);
    settle(0.2); // the last answers
    const auto after = mesh.counts();
    require(row, after.asked > before.asked, "nothing was asked");
    require(row, after.heard == after.asked && after.answered == after.asked,
            fmt::format("{} commands were sent, {} heard and {} answered", after.asked, after.heard, after.answered));
    auto latencies = mesh.latencies();
    require(row, latencies.size() == after.answered - before.answered,
            fmt::format("{} round trips were timed of {}", latencies.size(), after.answered - before.answered));
    return latencies;
}

void requireNoTrouble(ScaleRow& row, const MeshCounts& atTheEnd)
{
    require(row, atTheEnd.troubles == 0, fmt::format("{} troubles of sessions", atTheEnd.troubles));
    requireAllOpen(row, atTheEnd);
}

void measureMemory(ScaleRow& row, const Mesh& mesh)
{
    const auto memory = mesh.memory();
    row.allocatedKiB = static_cast<double>(memory.allocatedKiB) / static_cast<double>(row.devices);
    row.descriptors = static_cast<double>(memory.descriptors) / static_cast<double>(row.devices);
}

void measureSessions(ScaleRow& row, const MeshPlan& plan, const ScaleOptions& options)
{
    Mesh mesh(plan);
    measureClosed(row.loads, mesh, options);
    row.bareKiB = static_cast<double>(mesh.memory().allocatedKiB) / static_cast<double>(row.devices);
    const auto start = Clock::now();
    const auto opened = mesh.open();
    row.openSeconds = secondsSince(start);
    row.retries = opened.retries;
    requireAllOpen(row, opened);
    settle(2 * std::chrono::duration<double>(options.heartbeat).count());
    lab::Sample trips;
    for (int round = 0; round < options.rounds && row.faults.empty(); ++round) {
        const auto before = loopbackTraffic();
        const auto begun = Clock::now();
        measureIdle(row, row.loads, mesh, options);
        const auto after = loopbackTraffic();
        row.bytesPerSecond += static_cast<double>(after.bytes - before.bytes) / secondsSince(begun) / options.rounds;
        row.packetsPerSecond += static_cast<double>(after.packets - before.packets) / secondsSince(begun) / options.rounds;
        if (round == 0)
            measureMemory(row, mesh);
        for (const auto latency : measureAsking(row, row.loads, mesh, options))
            trips.add(static_cast<double>(latency) / 1e3);
    }
    const auto counts = mesh.counts();
    row.missed = counts.missed;
    requireNoTrouble(row, counts);
    if (!trips.empty()) {
        row.roundTripP50Us = trips.at(0.5);
        row.roundTripP99Us = trips.at(0.99);
    }
}

void measurePlain(ScaleRow& row, MeshPlan plan, const ScaleOptions& options)
{
    plan.plain = true;
    Mesh mesh(plan);
    measureClosed(row.plain, mesh, options);
    requireAllOpen(row, mesh.open());
    for (int round = 0; round < options.rounds && row.faults.empty(); ++round) {
        measureIdle(row, row.plain, mesh, options);
        (void)measureAsking(row, row.plain, mesh, options);
    }
    requireNoTrouble(row, mesh.counts());
}

} // namespace

double MeshLoads::meanIdle() const { return meanOf(idle); }

double MeshLoads::idleSpread() const
{
    const auto [least, most] = std::minmax_element(idle.begin(), idle.end());
    return (*most - *least) / meanIdle();
}

std::optional<double> MeshLoads::costOf(double difference, double perSecond) const
{
    const double varies = meanIdle() * idleSpread() / 2;
    return difference > varies ? std::optional(1e6 * difference / perSecond) : std::nullopt;
}

std::optional<double> MeshLoads::perHeartbeat() const { return costOf(meanIdle() - closed, heartbeatsPerSecond); }
std::optional<double> MeshLoads::perMessage() const { return costOf(meanOf(asking) - meanIdle(), messagesPerSecond); }

std::string timingFor(std::chrono::milliseconds heartbeat)
{
    const auto ms = std::max<std::int64_t>(heartbeat.count(), 50);
    return fmt::format(R"(heartbeat="{}ms" suspect="{}ms" lost="{}ms" reconnect="{}ms")", heartbeat.count(), 20 * ms, 30 * ms, 60 * ms);
}

std::optional<double> ScaleRow::perSessionEnd() const
{
    const auto each = loads.perHeartbeat();
    return each ? std::optional(*each * loads.heartbeatsPerSecond / static_cast<double>(sessionEnds)) : std::nullopt;
}

ScaleRow measureScale(std::size_t devices, const ScaleOptions& options)
{
    const MeshPlan plan{devices, timingFor(options.heartbeat), options.rate, options.program};
    ScaleRow row;
    row.devices = devices;
    row.sessionEnds = plan.sessionEnds();
    row.machine = measureRawPair(std::chrono::milliseconds(static_cast<std::int64_t>(500 * options.seconds)));
    measureSessions(row, plan, options);
    if (row.faults.empty())
        measurePlain(row, plan, options);
    return row;
}

} // namespace liena::bench
