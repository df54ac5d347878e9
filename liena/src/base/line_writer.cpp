// The queue without a lock, its thread, and the process's own writer.
#include "base/line_writer.hpp"

#include "base/ordinary_thread.hpp"

#include <cerrno>
#include <condition_variable>
#include <csignal>
#include <cstdlib>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>

#include <poll.h>
#include <pthread.h>
#include <unistd.h>

namespace liena::base {

using namespace std::chrono_literals;

namespace {

constexpr auto atExit = 500ms; // a terminal that is stopped must not keep a program from ending

/// One write per line keeps lines of several processes whole.
void writeWhole(int descriptor, const std::string& line)
{
    std::size_t done = 0;
    while (done < line.size()) {
        const auto written = ::write(descriptor, line.data() + done, line.size() - done);
        if (written >= 0) {
            done += static_cast<std::size_t>(written);
        } else if (errno == EAGAIN) {
            pollfd waiting{descriptor, POLLOUT, 0};
            (void)::poll(&waiting, 1, -1);
        } else if (errno != EINTR) {
            return; // there is nobody to tell
        }
    }
}

bool takesNow(int descriptor)
{
    pollfd asked{descriptor, POLLOUT, 0};
    return ::poll(&asked, 1, 0) > 0 && (asked.revents & (POLLOUT | POLLERR)) == POLLOUT;
}

} // namespace

struct LineWriter::Core {
    struct Waiting {
        std::string line;
        Waiting* before;
    };

    Core(int writesTo, std::size_t mostBytes) : descriptor(writesTo), most(mostBytes) {}
    ~Core()
    {
        for (auto* one = newest.load(); one != nullptr;)
            delete std::exchange(one, one->before);
    }
    Core(const Core&) = delete;
    Core& operator=(const Core&) = delete;

    void push(std::string&& line)
    {
        bytes += line.size();
        auto* added = new Waiting{std::move(line), newest.load()};
        while (!newest.compare_exchange_weak(added->before, added)) {
        }
    }

    void wake()
    {
        ++turn;
        turn.notify_one();
    }

    bool isIdle() const { return bytes == 0 && lost == 0 && !writing; }

    /// The oldest first.
    Waiting* takeAll()
    {
        Waiting* oldest = nullptr;
        for (auto* one = newest.exchange(nullptr); one != nullptr;)
            oldest = std::exchange(one, std::exchange(one->before, oldest));
        return oldest;
    }

    void writeAll()
    {
        writing = true;
        for (auto* one = takeAll(); one != nullptr; one = one != nullptr ? one : takeAll()) {
            if (!abandoned)
                writeWhole(descriptor, one->line);
            bytes -= one->line.size();
            delete std::exchange(one, one->before);
        }
        if (const auto count = lost.exchange(0); count > 0 && !abandoned)
            writeWhole(descriptor, lostText.load()(count));
        writing = false;
    }

    void run()
    {
        runAsOrdinaryThread(); // a network thread may have put the first line
        for (bool last = false; !last;) {
            const auto seen = turn.load();
            last = ending;
            writeAll();
            {
                const std::lock_guard lock(mutex);
                ended = last;
            }
            written.notify_all();
            if (!last)
                turn.wait(seen);
        }
    }

    const int descriptor;
    const std::size_t most;
    std::atomic<Waiting*> newest = nullptr;
    std::atomic<std::size_t> bytes = 0; ///< not written yet
    std::atomic<std::uint64_t> lost = 0;
    std::atomic<LostText> lostText = nullptr;
    std::atomic<std::uint32_t> turn = 0; ///< on which the thread sleeps
    std::atomic<bool> writing = false;   ///< also what is not in `bytes`
    std::atomic<bool> hasThread = false;
    std::atomic<bool> ending = false;
    std::atomic<bool> abandoned = false; ///< nobody waits any more: the descriptor may be another's by now

    // Never taken by who puts a line
    std::mutex mutex;
    std::condition_variable written;
    bool ended = false;
};

LineWriter::LineWriter(int descriptor, std::size_t most)
    : m_descriptor(descriptor), m_most(most), m_core(std::make_shared<Core>(descriptor, most))
{}

LineWriter::~LineWriter() { finish(atExit); }

void LineWriter::put(std::string line, LostText lost)
{
    if (m_finished) {
        if (takesNow(m_descriptor))
            writeWhole(m_descriptor, line);
        return;
    }
    auto& core = *m_core;
    // Once full, it is to become half empty: else every other line would say that one was lost.
    const auto most = core.lost > 0 ? core.most / 2 : core.most;
    if (core.bytes + line.size() > most) {
        core.lostText = lost;
        ++core.lost;
    } else {
        if (const auto count = core.lost.exchange(0))
            core.push(lost(count));
        core.push(std::move(line));
    }
    startThread();
    core.wake();
}

void LineWriter::startThread()
{
    if (m_core->hasThread.exchange(true))
        return;
    // The application's signals are not for this thread, and a pipe that is closed must not end the process.
    sigset_t all;
    sigset_t before;
    ::sigfillset(&all);
    ::pthread_sigmask(SIG_SETMASK, &all, &before);
    try {
        std::thread([core = m_core] { core->run(); }).detach();
    } catch (const std::system_error&) {
        m_core->hasThread = false; // the next line tries again
    }
    ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

bool LineWriter::flush(std::chrono::milliseconds limit)
{
    auto& core = *m_core;
    std::unique_lock lock(core.mutex);
    return core.written.wait_for(lock, limit, [&] { return core.isIdle(); });
}

void LineWriter::finish(std::chrono::milliseconds limit)
{
    if (m_finished.exchange(true))
        return;
    auto& core = *m_core;
    core.ending = true;
    core.wake();
    if (core.hasThread) {
        std::unique_lock lock(core.mutex);
        core.abandoned = !core.written.wait_for(lock, limit, [&] { return core.ended; });
    }
    if (!core.abandoned && takesNow(m_descriptor))
        core.writeAll(); // what came while the thread ended, or all where there was none
}

void LineWriter::beginAnew() { m_ofParents.push_back(std::exchange(m_core, std::make_shared<Core>(m_descriptor, m_most))); }

LineWriter& stderrWriter()
{
    // There is one stderr. Its writer is never destroyed, since its thread may be held up for longer than static objects live.
    static auto* const writer = [] {
        auto* made = new LineWriter(STDERR_FILENO);
        (void)std::atexit([] { stderrWriter().finish(atExit); });
        (void)::pthread_atfork(nullptr, nullptr, [] { stderrWriter().beginAnew(); });
        return made;
    }();
    return *writer;
}

} // namespace liena::base
