// Log levels, the stderr sink, and peer text made safe to print.
#include "liena/log.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <unistd.h>

#include <chrono>

namespace liena {

std::string_view toString(LogLevel level)
{
    switch (level) {
    case LogLevel::Debug:
        return "debug";
    case LogLevel::Info:
        return "info";
    case LogLevel::Warning:
        return "warning";
    case LogLevel::Error:
        return "error";
    }
    return "log";
}

LogSink stderrLog(LogLevel least)
{
    return [least](LogLevel level, std::string_view text) {
        if (level < least)
            return;
        const auto now = std::chrono::system_clock::now();
        const auto seconds = std::chrono::floor<std::chrono::seconds>(now);
        const auto millis = std::chrono::duration_cast<std::chrono::milliseconds>(now - seconds).count();
        const auto line = fmt::format("{:%Y-%m-%dT%H:%M:%S}.{:03}Z {} {}\n", fmt::gmtime(std::chrono::system_clock::to_time_t(seconds)),
                                      millis, toString(level), text);
        // One write per line keeps lines of several threads and processes whole.
        [[maybe_unused]] const auto written = ::write(STDERR_FILENO, line.data(), line.size());
    };
}

namespace {

/// Length of the valid UTF-8 sequence at the start of `text`, 0 when there is none.
std::size_t sequenceLength(std::string_view text)
{
    const auto lead = static_cast<unsigned char>(text.front());
    const std::size_t length = lead < 0x80                   ? 1
                               : lead >= 0xC2 && lead < 0xE0 ? 2
                               : lead >= 0xE0 && lead < 0xF0 ? 3
                               : lead >= 0xF0 && lead < 0xF5 ? 4
                                                             : 0;
    if (length == 0 || text.size() < length)
        return 0;
    for (std::size_t i = 1; i < length; ++i)
        if ((static_cast<unsigned char>(text[i]) & 0xC0U) != 0x80U)
            return 0;
    const auto second = length > 1 ? static_cast<unsigned char>(text[1]) : 0U;
    const bool overlong = (lead == 0xE0 && second < 0xA0) || (lead == 0xF0 && second < 0x90);
    const bool outside = (lead == 0xED && second >= 0xA0) || (lead == 0xF4 && second >= 0x90); // surrogates, beyond U+10FFFF
    return overlong || outside ? 0 : length;
}

/// C0, DEL, C1, line separators and the bidirectional marks: what can move a cursor, break or reorder a line.
bool isUnsafe(std::string_view sequence)
{
    const auto lead = static_cast<unsigned char>(sequence.front());
    if (sequence.size() == 1)
        return lead < 0x20 || lead == 0x7F;
    if (sequence.size() == 2)
        return (lead == 0xC2 && static_cast<unsigned char>(sequence[1]) < 0xA0) || sequence == "\xD8\x9C";
    if (sequence.starts_with("\xE2\x80"))
        return (sequence[2] >= '\xA8' && sequence[2] <= '\xAE') || sequence[2] == '\x8E' || sequence[2] == '\x8F';
    return sequence.starts_with("\xE2\x81") && sequence[2] >= '\xA6' && sequence[2] <= '\xA9';
}

} // namespace

std::string printable(std::string_view text, std::size_t limit)
{
    std::string result;
    while (!text.empty()) {
        const auto length = sequenceLength(text);
        const bool plain = length > 0 && !isUnsafe(text.substr(0, length));
        const auto taken = length > 0 ? length : 1;
        std::string piece;
        if (plain)
            piece = std::string(text.substr(0, taken));
        else
            for (const char c : text.substr(0, taken))
                piece += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
        if (result.size() + piece.size() > limit)
            return result + "…";
        result += piece;
        text.remove_prefix(taken);
    }
    return result;
}

} // namespace liena
