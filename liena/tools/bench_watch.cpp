// Descriptors for everything that can be waited for.
#include "bench_watch.hpp"

#include <algorithm>
#include <array>

#include <poll.h>
#include <sys/eventfd.h>
#include <sys/signalfd.h>
#include <unistd.h>

namespace liena::tools {

BenchWatch::BenchWatch() : m_bell(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)), m_signals(-1)
{
    sigset_t ends;
    sigemptyset(&ends);
    sigaddset(&ends, SIGINT);
    sigaddset(&ends, SIGTERM);
    ::pthread_sigmask(SIG_BLOCK, &ends, &m_before);
    m_signals = ::signalfd(-1, &ends, SFD_CLOEXEC | SFD_NONBLOCK);
}

BenchWatch::~BenchWatch()
{
    signalfd_siginfo late;
    while (::read(m_signals, &late, sizeof late) == sizeof late) {
    }
    ::close(m_bell);
    ::close(m_signals);
    ::pthread_sigmask(SIG_SETMASK, &m_before, nullptr);
}

void BenchWatch::ring() { ::eventfd_write(m_bell, 1); }

BenchWatch::Outcome BenchWatch::wait(std::chrono::steady_clock::time_point limit, int socket)
{
    while (true) {
        const auto now = std::chrono::steady_clock::now();
        if (now >= limit)
            return Outcome::TimedOut;
        const auto left =
            std::chrono::ceil<std::chrono::milliseconds>(std::min<std::chrono::nanoseconds>(limit - now, std::chrono::hours(1)));
        std::array<pollfd, 3> waits{{{m_bell, POLLIN, 0}, {m_signals, POLLIN, 0}, {socket, POLLIN, 0}}};
        if (::poll(waits.data(), waits.size(), static_cast<int>(left.count())) <= 0)
            continue;
        if (signalfd_siginfo ignored; ::read(m_signals, &ignored, sizeof ignored) == sizeof ignored)
            return Outcome::Told;
        eventfd_t count = 0;
        if (::eventfd_read(m_bell, &count) == 0 || waits[2].revents != 0)
            return Outcome::Rang;
    }
}

} // namespace liena::tools
