// A message set by chance: always one that the grammar allows.
#pragma once

#include <cstdint>
#include <string>

namespace liena::fuzz {

/// Up to three messages with up to six fields of all types and shapes, as a whole file.
std::string randomSetXml(std::uint16_t seed);

} // namespace liena::fuzz
