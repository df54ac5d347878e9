// Lines from standard input: implementation.
#include "line_reader.hpp"

#include <poll.h>
#include <unistd.h>

#include <cerrno>

namespace liena::devices {

namespace {

constexpr std::size_t longestLine = 1024;

// Reading a terminal from the background would stop the whole process (SIGTTIN).
bool mayRead() { return isatty(STDIN_FILENO) == 0 || tcgetpgrp(STDIN_FILENO) == getpgrp(); }

} // namespace

LineReader::LineReader(std::function<void(std::string_view)> use) : m_use(std::move(use))
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
    while (mayRead()) {
        pollfd waits[2] = {{m_end[0], POLLIN, 0}, {STDIN_FILENO, POLLIN, 0}};
        if (poll(waits, 2, -1) < 0 && errno != EINTR)
            return;
        if (waits[0].revents != 0)
            return;
        if (waits[1].revents != 0 && !take())
            return;
    }
}

bool LineReader::take()
{
    char bytes[512];
    const ssize_t count = mayRead() ? ::read(STDIN_FILENO, bytes, sizeof bytes) : -1;
    if (count <= 0)
        return count < 0 && errno == EINTR;
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
