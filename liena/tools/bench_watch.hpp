// Waits for news of other threads, for the order to end, and for a socket, all at once.
#pragma once

#include <chrono>
#include <csignal>

namespace liena::tools {

/// While it lives, SIGINT and SIGTERM are orders to end; make it before any thread. Waiting is for the thread that made it, and its end is.
/// Then a signal that came too late for wait() is forgotten: it must not end the program before its report. The next one ends it again.
class BenchWatch {
public:
    BenchWatch();
    ~BenchWatch();
    BenchWatch(const BenchWatch&) = delete;
    BenchWatch& operator=(const BenchWatch&) = delete;

    void ring(); ///< any thread

    enum class Outcome { Rang, Told, TimedOut };

    /// `socket`, when it is one, rings by what it brings.
    Outcome wait(std::chrono::steady_clock::time_point limit, int socket = -1);

private:
    int m_bell;
    int m_signals;
    sigset_t m_before{}; ///< what was blocked
};

} // namespace liena::tools
