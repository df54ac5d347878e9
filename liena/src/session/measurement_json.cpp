// The figures of a measurement as JSON.
#include "liena/json_line.hpp"
#include "liena/measurement.hpp"

#include <fmt/format.h>

#include <cmath>

namespace liena {

namespace {

std::string percentiles(const LatencyHistogram& latencies)
{
    const auto us = [](std::uint64_t ns) { return static_cast<double>(ns) / 1000; };
    const auto percentile = [&](double fraction) { return latencies.tells(fraction) ? us(latencies.quantile(fraction)) : std::nan(""); };
    JsonLine json;
    json.add("least", us(latencies.least()));
    json.add("p50", percentile(0.5)).add("p90", percentile(0.9)).add("p99", percentile(0.99));
    json.add("p99_9", percentile(0.999)).add("p99_99", percentile(0.9999));
    return json.add("max", us(latencies.max())).text();
}

/// Pairs of nanoseconds and count, by which another program has the whole histogram again.
std::string buckets(const LatencyHistogram& latencies)
{
    std::string list;
    latencies.forEach(
        [&](std::uint64_t value, std::uint64_t count) { list += fmt::format("{}[{},{}]", list.empty() ? "" : ",", value, count); });
    return fmt::format("[{}]", list);
}

std::string jsonOf(const ProbeFigures& figures)
{
    if (!figures.asked.isUsed())
        return "null";
    JsonLine json;
    json.add("asked_per_second", figures.asked.perSecond).add("asked_at_once", figures.asked.atOnce).add("bytes", figures.asked.bytes);
    json.add("per_second", figures.perSecond).add("limited", figures.limited);
    json.add("sent", figures.sent).add("withheld", figures.withheld).add("heard", figures.heard).add("echoed", figures.echoed);
    json.add("spent_s", std::chrono::duration<double>(figures.spent).count());
    return json.put("round_trip_us", percentiles(figures.roundTrip)).put("buckets_ns", buckets(figures.roundTrip)).text();
}

} // namespace

std::string toJson(const Measurement& measurement)
{
    std::string phases;
    for (const auto& phase : measurement.phases) {
        JsonLine json;
        json.add("name", phase.name).put("prompt", jsonOf(phase.prompt)).put("packets", jsonOf(phase.packets));
        json.put("images", jsonOf(phase.images));
        phases += fmt::format("{}{}", phases.empty() ? "" : ",", json.text());
    }
    JsonLine limits;
    limits.add("probes_per_second", measurement.limits.probesPerSecond);
    limits.add("bulk_bytes_per_second", measurement.limits.bulkBytesPerSecond).add("longest_s", measurement.limits.longest.count());
    JsonLine json;
    json.add("failure", measurement.failure)
        .add("in_use", measurement.inUse)
        .add("images_flowed", measurement.imagesFlowed)
        .put("limits", limits.text());
    if (measurement.bulkRate)
        json.add("bulk_bytes_per_second", *measurement.bulkRate)
            .add("bulk_age_s", std::chrono::duration<double>(measurement.bulkRateAge).count());
    return json.put("phases", "[" + phases + "]").text();
}

} // namespace liena
