// What every fuzz target is made of: its entry, and what it asserts.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

/// One execution; asserts with expect(). Called by libFuzzer, or by replay.cpp with the files of the kept corpus.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace liena::fuzz {

/// Ends the program, which is a finding, when a property does not hold. (Clang 14 has no std::source_location.)
inline void expect(bool holds, const char* property, const char* file = __builtin_FILE(), int line = __builtin_LINE())
{
    if (holds)
        return;
    std::fprintf(stderr, "%s:%d: a property does not hold: %s\n", file, line, property);
    std::abort();
}

} // namespace liena::fuzz
