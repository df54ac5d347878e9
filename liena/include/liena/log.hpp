// Where the library's log lines go: one line per event, once per cause.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace liena {

enum class LogLevel : std::uint8_t { Debug, Info, Warning, Error };

std::string_view toString(LogLevel level);

/// Called from the network thread and from the thread that calls the facade; must not block and must not call back.
using LogSink = std::function<void(LogLevel, std::string_view)>;

/// Writes `2026-01-31T12:00:00.000Z level text` lines to stderr, whole lines at a time.
LogSink stderrLog(LogLevel least = LogLevel::Info);

/// Text that came from a peer, made safe for a log or a screen: control characters and invalid UTF-8 escaped, cut to `limit` bytes.
std::string printable(std::string_view text, std::size_t limit = 64);

} // namespace liena
