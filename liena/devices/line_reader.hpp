// Lines from standard input, on a thread of their own.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <thread>

namespace liena::devices {

/// Ends quietly when standard input is closed, cannot be read, or is a terminal that another program holds: a device runs without it too.
class LineReader {
public:
    /// `use` runs on the reader's thread.
    explicit LineReader(std::function<void(std::string_view)> use);
    ~LineReader();
    LineReader(const LineReader&) = delete;
    LineReader& operator=(const LineReader&) = delete;

    /// No line is used after it returns. Harmless when repeated.
    void stop();

private:
    void read();
    bool take();

    std::function<void(std::string_view)> m_use;
    std::string m_pending;
    bool m_overlong = false;
    int m_end[2] = {-1, -1}; ///< a pipe: something in it ends the thread
    std::thread m_thread;
};

} // namespace liena::devices
