// UTF-8 sequences, and which of them could harm a line or a screen.
#pragma once

#include <cstddef>
#include <string_view>

namespace liena::base {

/// Length of the valid UTF-8 sequence at the start of `text`, 0 when there is none.
std::size_t sequenceLength(std::string_view text);

/// C0, DEL, C1, line separators and the bidirectional marks: what can move a cursor, break or reorder a line.
bool isUnsafe(std::string_view sequence);

} // namespace liena::base
