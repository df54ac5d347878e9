// Where the library's log lines go: one line per event, once per cause.
#pragma once

#include <chrono>
#include <concepts>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace liena {

enum class LogLevel : std::uint8_t { Debug, Info, Warning, Error };

std::string_view toString(LogLevel level);

/// One event. The texts are valid during the call only.
struct LogLine {
    LogLevel level = LogLevel::Info;
    std::string_view text;     ///< a sentence for a person
    std::string_view event{};  ///< for programs: what happened, as `session-lost`; may be empty
    std::string_view peer{};   ///< the other device's name or id, when the event is about one
    std::string_view device{}; ///< whose log it is
};

/// Called from the network thread and from the thread that calls the facade; must not block and must not call back. It is made from any
/// function of (LogLevel, std::string_view) or of (const LogLine&); to call one that was not throws std::bad_function_call.
class LogSink {
public:
    LogSink() = default;

    template <typename F>
    requires(!std::same_as<std::remove_cvref_t<F>, LogSink> && std::invocable<F&, const LogLine&>) LogSink(F write)
        : m_write(std::move(write))
    {}

    template <typename F>
    requires(!std::same_as<std::remove_cvref_t<F>, LogSink> && std::invocable<F&, LogLevel, std::string_view>) LogSink(F write)
        : m_write([write = std::move(write)](const LogLine& line) mutable { write(line.level, line.text); })
    {}

    void operator()(const LogLine& line) const { m_write(line); }
    void operator()(LogLevel level, std::string_view text) const { m_write(LogLine{level, text}); }

    explicit operator bool() const { return static_cast<bool>(m_write); }

private:
    std::function<void(const LogLine&)> m_write;
};

enum class LogFormat : std::uint8_t { Text, Json };

/// `text` or `json`.
std::optional<LogFormat> logFormatFrom(std::string_view name);

/// One line without its end: `2026-01-31T12:00:00.000Z level text`, or a JSON object with the fields time, level, device, event, peer and
/// text, of which empty ones are left out. Nothing in the texts can break the line or the terminal, and none grows beyond 2 KiB.
std::string formatLog(const LogLine& line, LogFormat format, std::chrono::system_clock::time_point when);

/// Writes such lines to stderr, whole lines at a time and in order, from a thread of its own: who logs never waits for a terminal, a pipe
/// or a disk. Up to 1 MiB may wait; what finds no room is counted, and a line in its place says how many were lost. The process waits for
/// at most half a second when it exits until all is written; a signal that kills it takes what was just being written with it.
LogSink stderrLog(LogLevel least = LogLevel::Info, LogFormat format = LogFormat::Text);

/// Text that came from a peer, made safe for a log or a screen: control characters and invalid UTF-8 escaped, cut to `limit` bytes.
std::string printable(std::string_view text, std::size_t limit = 64);

/// `2026-01-31T12:00:00.000Z`.
std::string timeText(std::chrono::system_clock::time_point when);

} // namespace liena
