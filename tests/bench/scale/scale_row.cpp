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

void openAll(ScaleRow& row, Mesh& mesh)
{
    const auto start = Clock::now();
    mesh.open();
    row.openSeconds = secondsSince(start);
    const auto counts = mesh.counts();
    row.retries = counts.retries;
    require(row, counts.sessionEnds == row.sessionEnds,
            fmt::format("{} of {} ends of sessions are open", counts.sessionEnds, row.sessionEnds));
}

void measureIdle(ScaleRow& row, Mesh& mesh, const ScaleOptions& options)
{
    const auto before = mesh.counts();
    const auto trafficBefore = loopbackTraffic();
    row.idleLoads.push_back(loadOver(mesh, options.seconds));
    const auto traffic = loopbackTraffic();
    const auto after = mesh.counts();
    const auto share = [&](std::uint64_t from, std::uint64_t to, double seconds) {
        return static_cast<double>(to - from) / seconds / options.rounds;
    };
    row.heartbeatsPerSecond += share(before.heartbeats, after.heartbeats, after.at - before.at);
    row.bytesPerSecond += share(trafficBefore.bytes, traffic.bytes, options.seconds);
    row.packetsPerSecond += share(trafficBefore.packets, traffic.packets, options.seconds);
    require(row, after.heartbeats > before.heartbeats, "no heartbeat was heard");
}

void measureAsking(ScaleRow& row, Mesh& mesh, const ScaleOptions& options, lab::Sample& trips)
{
    const auto before = mesh.counts();
    mesh.ask(true);
    row.askingLoads.push_back(loadOver(mesh, options.seconds));
    const auto during = mesh.counts();
    row.messagesPerSecond += 2 * static_cast<double>(during.answered - before.answered) / (during.at - before.at) / options.rounds;
    mesh.ask(false);
    settle(0.2); // the last answers
    const auto after = mesh.counts();
    require(row, after.asked > before.asked, "nothing was asked");
    require(row, after.heard == after.asked && after.answered == after.asked,
            fmt::format("{} commands were sent, {} heard and {} answered", after.asked, after.heard, after.answered));
    const auto latencies = mesh.latencies();
    require(row, latencies.size() == after.answered - before.answered,
            fmt::format("{} round trips were timed of {}", latencies.size(), after.answered - before.answered));
    for (const auto latency : latencies)
        trips.add(static_cast<double>(latency) / 1e3);
}

} // namespace

double ScaleRow::idleLoad() const { return meanOf(idleLoads); }
double ScaleRow::askingLoad() const { return meanOf(askingLoads); }

double ScaleRow::idleSpread() const
{
    const auto [least, most] = std::minmax_element(idleLoads.begin(), idleLoads.end());
    return (*most - *least) / idleLoad();
}

std::string timingFor(std::chrono::milliseconds heartbeat)
{
    const auto ms = std::max<std::int64_t>(heartbeat.count(), 50);
    return fmt::format(R"(heartbeat="{}ms" suspect="{}ms" lost="{}ms" reconnect="{}ms")", heartbeat.count(), 20 * ms, 30 * ms, 60 * ms);
}

ScaleRow measureScale(std::size_t devices, const ScaleOptions& options)
{
    MeshPlan plan{devices, timingFor(options.heartbeat), options.rate, options.program};
    ScaleRow row;
    row.devices = devices;
    row.sessionEnds = plan.sessionEnds();
    row.machine = measureRawPair(std::chrono::milliseconds(static_cast<std::int64_t>(500 * options.seconds)));
    Mesh mesh(plan);
    const auto each = static_cast<double>(devices);
    settle(0.5);
    row.bareLoad = loadOver(mesh, options.seconds);
    row.bareKiB = static_cast<double>(mesh.memory().allocatedKiB) / each;
    openAll(row, mesh);
    settle(2 * std::chrono::duration<double>(options.heartbeat).count());
    lab::Sample trips;
    for (int round = 0; round < options.rounds && row.faults.empty(); ++round) {
        measureIdle(row, mesh, options);
        if (round == 0) {
            const auto memory = mesh.memory();
            row.allocatedKiB = static_cast<double>(memory.allocatedKiB) / each;
            row.descriptors = static_cast<double>(memory.descriptors) / each;
        }
        measureAsking(row, mesh, options, trips);
    }
    const auto counts = mesh.counts();
    row.missed = counts.missed;
    require(row, counts.troubles == 0, fmt::format("{} troubles of sessions", counts.troubles));
    require(row, counts.sessionEnds == row.sessionEnds,
            fmt::format("{} of {} ends of sessions are open at the end", counts.sessionEnds, row.sessionEnds));
    if (!trips.empty()) {
        row.roundTripP50Us = trips.at(0.5);
        row.roundTripP99Us = trips.at(0.99);
    }
    return row;
}

} // namespace liena::bench
