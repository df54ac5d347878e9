// A bench run for people and for programs.
#pragma once

#include "line_verdict.hpp"

#include <string>

namespace liena::tools {

struct BenchSubject {
    std::string topology;
    std::string from;
    std::string to;
    std::string way; ///< how it was measured, in words
};

/// The verdict first, then what it rests on.
std::string benchText(const BenchSubject& subject, const LineProfile& profile, const LineVerdict& verdict, const Measurement& measurement);

/// One JSON object on one line.
std::string benchJson(const BenchSubject& subject, const LineProfile& profile, const LineVerdict& verdict, const Measurement& measurement);

/// The measurement in what toJson() wrote; nothing when it is none.
class JsonValue;
std::optional<Measurement> measurementFrom(const JsonValue& json);

} // namespace liena::tools
