// What a peer tells `run`: one JSON object on one line.
#pragma once

#include "liena/latency_histogram.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace liena::compare {

class ResultLine {
public:
    ResultLine& add(std::string_view name, std::string_view text);
    ResultLine& add(std::string_view name, double value);

    /// `NAME_count`, and in microseconds `NAME_p50`, `NAME_p99`, `NAME_p999`, `NAME_max`.
    ResultLine& add(std::string_view name, const LatencyHistogram& latencies);

    ResultLine& add(std::string_view name, const std::vector<double>& values);

    /// On standard output.
    void print() const;

private:
    std::string m_text;
};

} // namespace liena::compare
