// Log levels and formats, the stderr sink, and peer text made safe to print.
#include "liena/log.hpp"

#include "base/characters.hpp"
#include "base/line_writer.hpp"
#include "liena/json_line.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

namespace liena {

using base::isUnsafe;
using base::sequenceLength;

namespace {

constexpr std::size_t longestText = 2048;
constexpr std::size_t longestName = 64;

template <LogFormat format>
std::string lostText(std::uint64_t count)
{
    const auto text = fmt::format("{} lines of this log were lost: stderr did not take them", count);
    return formatLog({LogLevel::Warning, text, "log-lines-lost"}, format, std::chrono::system_clock::now()) + '\n';
}

} // namespace

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

std::optional<LogFormat> logFormatFrom(std::string_view name)
{
    if (name == "text")
        return LogFormat::Text;
    return name == "json" ? std::optional(LogFormat::Json) : std::nullopt;
}

std::string timeText(std::chrono::system_clock::time_point when)
{
    const auto seconds = std::chrono::floor<std::chrono::seconds>(when);
    const auto millis = std::chrono::duration_cast<std::chrono::milliseconds>(when - seconds).count();
    return fmt::format("{:%Y-%m-%dT%H:%M:%S}.{:03}Z", fmt::gmtime(std::chrono::system_clock::to_time_t(seconds)), millis);
}

std::string formatLog(const LogLine& line, LogFormat format, std::chrono::system_clock::time_point when)
{
    // Whoever wrote the text may have forgotten that a peer had a part in it.
    if (format == LogFormat::Text)
        return fmt::format("{} {} {}", timeText(when), toString(line.level), printable(line.text, longestText));
    JsonLine json;
    json.add("time", timeText(when)).add("level", toString(line.level));
    if (!line.device.empty())
        json.add("device", line.device, longestName);
    if (!line.event.empty())
        json.add("event", line.event, longestName);
    if (!line.peer.empty())
        json.add("peer", line.peer, longestName);
    return json.add("text", line.text, longestText).text();
}

LogSink stderrLog(LogLevel least, LogFormat format)
{
    const auto lost = format == LogFormat::Json ? lostText<LogFormat::Json> : lostText<LogFormat::Text>;
    return [least, format, lost, &writer = base::stderrWriter()](const LogLine& line) {
        if (line.level >= least)
            writer.put(formatLog(line, format, std::chrono::system_clock::now()) + '\n', lost);
    };
}

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
