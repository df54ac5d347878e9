// Lines from standard input, on a thread of their own.
#pragma once

#include "liena/log.hpp"

#include <chrono>
#include <functional>
#include <string>
#include <string_view>
#include <thread>

namespace liena::devices {

/// False while standard input is a terminal that another program holds.
bool mayReadStandardInput();

/// Where the lines come from. While `mayRead` says no, which is asked on the reader's thread, it is asked again every `lookAgain`.
struct LineSource {
    int descriptor = 0;
    std::function<bool()> mayRead = mayReadStandardInput;
    std::chrono::milliseconds lookAgain{200};
};

/// Waits while another program holds the terminal, as a shell does for one in the background. Ends when the input does or cannot be read,
/// and says so in the log: a device runs without it too.
class LineReader {
public:
    /// `use` runs on the reader's thread, and so does `log`.
    LineReader(std::function<void(std::string_view)> use, LogSink log, LineSource source = {});
    ~LineReader();
    LineReader(const LineReader&) = delete;
    LineReader& operator=(const LineReader&) = delete;

    /// No line is used after it returns. Harmless when repeated.
    void stop();

private:
    void read();
    bool take();

    std::function<void(std::string_view)> m_use;
    LogSink m_log;
    LineSource m_source;
    std::string m_pending;
    bool m_overlong = false;
    int m_end[2] = {-1, -1}; ///< a pipe: something in it ends the thread
    std::thread m_thread;
};

} // namespace liena::devices
