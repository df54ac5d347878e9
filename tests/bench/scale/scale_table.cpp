// Markdown and JSON of a mesh's figures.
#include "scale/scale_table.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <sys/utsname.h>

#include <algorithm>
#include <thread>

namespace liena::bench {

namespace {

std::string machineLine(const std::vector<ScaleRow>& rows, const ScaleOptions& options)
{
    utsname system{};
    ::uname(&system);
    double stall = 0;
    for (const auto& row : rows)
        stall = std::max(stall, row.machine.largestStallMs);
    return fmt::format(
        "{} processors, {} {}. TLS, heartbeat {} ms, a process per device{}. {} rounds of {:g} s idle and {:g} s with {:g} round "
        "trips of 64 bytes per second, of all devices together. A timer of 1 ms came late by at most {:.1f} ms.",
        std::thread::hardware_concurrency(), system.sysname, system.release, options.heartbeat.count(),
        options.keepAwake ? ", processors kept awake" : "", options.rounds, options.seconds, options.seconds, options.rate, stall);
}

/// LiENa's, that of plain sockets, and how many times as much; what is not known is no figure.
std::string costsOf(const std::optional<double>& ours, const std::optional<double>& plain)
{
    const auto text = [](const std::optional<double>& cost) { return cost ? fmt::format("{:.1f}", *cost) : "–"; };
    return fmt::format("{} / {}{}", text(ours), text(plain), ours && plain ? fmt::format(" = {:.2f}", *ours / *plain) : "");
}

std::string lineOf(const ScaleRow& row)
{
    const auto& loads = row.loads;
    return fmt::format("| {} | {} | {:.1f} | {:.0f} | {:.1f} ± {:.0f} % | {} | {} | {:.0f} / {:.0f} | {:.0f} / {:.0f} | {:.0f} |",
                       row.devices, row.sessionEnds / 2, row.openSeconds, loads.heartbeatsPerSecond, 100 * loads.meanIdle(),
                       50 * loads.idleSpread(), costsOf(loads.perHeartbeat(), row.plain.perHeartbeat()),
                       costsOf(loads.perMessage(), row.plain.perMessage()), row.roundTripP50Us, row.roundTripP99Us, row.machine.p50Us,
                       row.machine.p99Us, row.perSessionKiB());
}

nlohmann::ordered_json figure(const std::optional<double>& cost) { return cost ? nlohmann::ordered_json(*cost) : nlohmann::ordered_json(); }

nlohmann::ordered_json figuresOf(const MeshLoads& loads)
{
    return {{"closed_load", loads.closed},
            {"idle_loads", loads.idle},
            {"asking_loads", loads.asking},
            {"heartbeats_per_s", loads.heartbeatsPerSecond},
            {"messages_per_s", loads.messagesPerSecond},
            {"us_per_heartbeat", figure(loads.perHeartbeat())},
            {"us_per_message", figure(loads.perMessage())}};
}

} // namespace

std::string scaleTable(const std::vector<ScaleRow>& rows, const ScaleOptions& options)
{
    auto text =
        machineLine(rows, options) +
        "\n\n| devices | sessions | all open, s | heartbeats heard per s | load of all, idle, % of a processor | µs per heartbeat: "
        "LiENa / plain sockets | µs per message: LiENa / plain sockets | round trip p50 / p99, µs | plain TCP's before, µs | KiB per "
        "end |\n|---|---|---|---|---|---|---|---|---|---|\n";
    for (const auto& row : rows)
        text += lineOf(row) + "\n";
    for (const auto& row : rows)
        for (const auto& fault : row.faults)
            text += "\n**" + fault + "**\n";
    return text;
}

std::string scaleJson(const std::vector<ScaleRow>& rows, const ScaleOptions& options)
{
    nlohmann::ordered_json all{
        {"heartbeat_ms", options.heartbeat.count()}, {"seconds", options.seconds},      {"rounds", options.rounds},
        {"round_trips_per_second", options.rate},    {"kept_awake", options.keepAwake}, {"rows", nlohmann::ordered_json::array()}};
    for (const auto& row : rows)
        all["rows"].push_back({{"devices", row.devices},
                               {"session_ends", row.sessionEnds},
                               {"open_s", row.openSeconds},
                               {"retries", row.retries},
                               {"liena", figuresOf(row.loads)},
                               {"plain", figuresOf(row.plain)},
                               {"heartbeats_missed", row.missed},
                               {"loopback_bytes_per_s", row.bytesPerSecond},
                               {"loopback_packets_per_s", row.packetsPerSecond},
                               {"us_per_end_second", figure(row.perSessionEnd())},
                               {"round_trip_p50_us", row.roundTripP50Us},
                               {"round_trip_p99_us", row.roundTripP99Us},
                               {"raw_p50_us", row.machine.p50Us},
                               {"raw_p99_us", row.machine.p99Us},
                               {"stall_ms", row.machine.largestStallMs},
                               {"bare_kib_per_device", row.bareKiB},
                               {"kib_per_device", row.allocatedKiB},
                               {"kib_per_end", row.perSessionKiB()},
                               {"descriptors_per_device", row.descriptors},
                               {"faults", row.faults}});
    return all.dump(1);
}

} // namespace liena::bench
