// What the measured sizes of a mesh look like to people, and to programs.
#pragma once

#include "scale/scale_row.hpp"

#include <string>
#include <vector>

namespace liena::bench {

/// Markdown: the machine, the conditions, and a line per size.
std::string scaleTable(const std::vector<ScaleRow>& rows, const ScaleOptions& options);

std::string scaleJson(const std::vector<ScaleRow>& rows, const ScaleOptions& options);

} // namespace liena::bench
