// A measurement out of the JSON that a running device answers with.
#include "bench_report.hpp"
#include "json_value.hpp"

namespace liena::tools {

namespace {

template <typename T>
T countOf(const JsonValue& value)
{
    constexpr double most = 1e15;
    const auto number = value.numberOr(0);
    return number > 0 && number < most ? static_cast<T>(number) : T{0};
}

std::chrono::nanoseconds timeOf(const JsonValue& seconds)
{
    constexpr double most = 1e9;
    const double number = seconds.numberOr(0);
    return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::duration<double>(number > 0 && number < most ? number : 0));
}

ProbeFigures figuresFrom(const JsonValue& json)
{
    ProbeFigures figures;
    figures.asked.perSecond = json["asked_per_second"].numberOr(0);
    figures.asked.atOnce = countOf<std::uint32_t>(json["asked_at_once"]);
    figures.asked.bytes = countOf<std::uint32_t>(json["bytes"]);
    figures.perSecond = json["per_second"].numberOr(0);
    figures.limited = json["limited"].truth();
    figures.sent = countOf<std::uint64_t>(json["sent"]);
    figures.withheld = countOf<std::uint64_t>(json["withheld"]);
    figures.heard = countOf<std::uint64_t>(json["heard"]);
    figures.echoed = countOf<std::uint64_t>(json["echoed"]);
    figures.spent = timeOf(json["spent_s"]);
    for (const auto& bucket : json["buckets_ns"].items())
        if (const auto pair = bucket.items(); pair.size() == 2)
            figures.roundTrip.record(countOf<std::int64_t>(pair[0]), countOf<std::uint64_t>(pair[1]));
    return figures;
}

} // namespace

std::optional<Measurement> measurementFrom(const JsonValue& json)
{
    if (json["phases"].isNull())
        return std::nullopt;
    Measurement measurement;
    measurement.failure = json["failure"].text();
    measurement.inUse = json["in_use"].truth();
    measurement.imagesFlowed = json["images_flowed"].truth();
    measurement.limits.probesPerSecond = countOf<std::uint32_t>(json["limits"]["probes_per_second"]);
    measurement.limits.bulkBytesPerSecond = countOf<std::uint64_t>(json["limits"]["bulk_bytes_per_second"]);
    if (const double rate = json["bulk_bytes_per_second"].numberOr(0); rate > 0) {
        measurement.bulkRate = rate;
        measurement.bulkRateAge = timeOf(json["bulk_age_s"]);
    }
    for (const auto& phase : json["phases"].items())
        measurement.phases.push_back(
            {phase["name"].text(), figuresFrom(phase["prompt"]), figuresFrom(phase["packets"]), figuresFrom(phase["images"])});
    return measurement;
}

} // namespace liena::tools
