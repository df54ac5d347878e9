// Round trips as a picture: how many percent were within how long, idle and beside images.
#pragma once

#include "bench_report.hpp"

#include <string>

namespace liena::tools {

/// A whole SVG file. Both axes are logarithmic: the rare late ones are what matters.
std::string latencyPlot(const BenchSubject& subject, const LineProfile& profile, const LineVerdict& verdict,
                        const Measurement& measurement);

} // namespace liena::tools
