// What a device of the lab tells the runner: lines on its output, each with the monotonic time, which all processes of a host share.
#pragma once

#include <chrono>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>

namespace liena::lab {

using SteadyTime = std::chrono::steady_clock::time_point;

/// One word or number of a line.
class Part {
public:
    Part(std::string_view text) : m_text(text) {}
    Part(const char* text) : m_text(text) {}
    Part(const std::string& text) : m_text(text) {}
    template <std::integral Number>
    Part(Number number) : m_text(std::to_string(number))
    {}

    const std::string& text() const { return m_text; }

private:
    std::string m_text;
};

/// Writes `<ns> part part …`, a whole line with one call, from any thread. The runner reads all the time and its pipe is large, so this
/// does not block.
void tell(SteadyTime at, std::initializer_list<Part> parts);

inline void tell(std::initializer_list<Part> parts) { tell(std::chrono::steady_clock::now(), parts); }

} // namespace liena::lab
