// What a peer tells `run`: one JSON object on one line.
#pragma once

#include "liena/latency_histogram.hpp"
#include "measure/latency_samples.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace liena::compare {

class ResultLine {
public:
    ResultLine& add(std::string_view name, std::string_view text);
    ResultLine& add(std::string_view name, double value);

    /// `NAME_count`, and in microseconds `NAME_p50`, `NAME_p99`, `NAME_p999`, `NAME_max`.
    ResultLine& add(std::string_view name, const LatencyHistogram& latencies) { return addQuantiles(name, latencies); }
    ResultLine& add(std::string_view name, const LatencySamples& latencies) { return addQuantiles(name, latencies); }

    ResultLine& add(std::string_view name, const std::vector<double>& values);

    /// On standard output.
    void print() const;

private:
    template <typename Latencies>
    ResultLine& addQuantiles(std::string_view name, const Latencies& latencies)
    {
        const auto microseconds = [](std::uint64_t nanoseconds) { return static_cast<double>(nanoseconds) / 1000.0; };
        const std::string prefix(name);
        add(prefix + "_count", static_cast<double>(latencies.count()));
        add(prefix + "_p50", microseconds(latencies.quantile(0.5)));
        add(prefix + "_p99", microseconds(latencies.quantile(0.99)));
        add(prefix + "_p999", microseconds(latencies.quantile(0.999)));
        return add(prefix + "_max", microseconds(latencies.max()));
    }

    std::string m_text;
};

} // namespace liena::compare
