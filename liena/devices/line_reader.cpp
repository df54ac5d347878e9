// Lines from standard input: implementation.
#include "line_reader.hpp"

#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <utility>

namespace liena::devices {

namespace {

constexpr std::size_t longestLine = 1024;

} // namespace

// Reading a terminal from the background would stop the whole process (SIGTTIN).
bool mayReadStandardInput() { return isatty(STDIN_FILENO) == 0 || tcgetpgrp(STDIN_FILENO) == getpgrp(); }

LineReader::LineReader(std::function<void(std::string_view)> use, LogSink log, LineSource source)
    : m_use(std::move(use)), m_log(std::move(log)), m_source(std::move(source))
{
    if (pipe(m_end) == 0)
        m_thread = std::thread([this] { read(); });
}

LineReader::~LineReader()
{
    stop();
    for (const int end : m_end)
        if (end >= 0)
            close(end);
}

void LineReader::stop()
{
    if (!m_thread.joinable())
        return;
    const char byte = 0;
    while (write(m_end[1], &byte, 1) < 0 && errno == EINTR) {
    }
    m_thread.join();
}

void LineReader::read()
{
    // A terminal that is lost between the question and the reading is an error of the reading then, and stops nobody.
    sigset_t background;
    sigemptyset(&background);
    sigaddset(&background, SIGTTIN);
    pthread_sigmask(SIG_BLOCK, &background, nullptr);
    for (;;) {
        const bool ours = m_source.mayRead();
        pollfd waits[2] = {{m_end[0], POLLIN, 0}, {m_source.descriptor, POLLIN, 0}};
        // What is typed meanwhile is for the other program, and nothing tells when that gives the terminal back.
        if (poll(waits, ours ? 2 : 1, ours ? -1 : static_cast<int>(m_source.lookAgain.count())) < 0 && errno != EINTR)
            break;
        if (waits[0].revents != 0)
            return;
        if (waits[1].revents != 0 && !take())
            break;
    }
    m_log(LogLevel::Info, "standard input has ended: no typed command is heard any more");
}

/// False when nothing more will come.
bool LineReader::take()
{
    if (!m_source.mayRead())
        return true;
    char bytes[512];
    const ssize_t count = ::read(m_source.descriptor, bytes, sizeof bytes);
    if (count <= 0)
        return count < 0 && (errno == EINTR || errno == EAGAIN || (errno == EIO && !m_source.mayRead()));
    for (const char byte : std::string_view(bytes, static_cast<std::size_t>(count))) {
        if (byte != '\n') {
            m_overlong = m_overlong || m_pending.size() == longestLine;
            if (!m_overlong)
                m_pending += byte;
            continue;
        }
        if (!m_overlong)
            m_use(m_pending);
        m_pending.clear();
        m_overlong = false;
    }
    return true;
}

} // namespace liena::devices
