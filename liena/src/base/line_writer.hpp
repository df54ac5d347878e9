// Lines for a file descriptor, from those who must not wait for it: a thread of its own writes them.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace liena::base {

/// Any thread may put lines. It waits for nothing, not even for a lock: a terminal that is stopped, a pipe that nobody reads and a disk
/// that hangs hold up the writer's thread alone. Lines leave in the order in which they came; those that find no room are counted, and a
/// line in their place says how many they were. The thread starts with the first line, and where there is none to be had the lines wait.
class LineWriter {
public:
    static constexpr std::size_t mostWaiting = std::size_t{1} << 20U; ///< bytes

    /// The line, with its end, that says how many were lost.
    using LostText = std::string (*)(std::uint64_t count);

    explicit LineWriter(int descriptor, std::size_t most = mostWaiting);
    ~LineWriter(); ///< finishes, and waits for at most half a second
    LineWriter(const LineWriter&) = delete;
    LineWriter& operator=(const LineWriter&) = delete;

    /// `line` with its end.
    void put(std::string line, LostText lost);

    /// Waits until all is written that was put; false when `limit` has passed before.
    bool flush(std::chrono::milliseconds limit);

    /// Flushes, and ends the thread. A line that is put afterwards is written at once if the descriptor takes it, else it is lost.
    void finish(std::chrono::milliseconds limit);

    /// In the child of a fork() before anything else: it has no thread yet, and what the parent has put is the parent's to write.
    void beginAnew();

private:
    struct Core;

    void startThread();

    int m_descriptor;
    std::size_t m_most;
    std::shared_ptr<Core> m_core; ///< shared with the thread, which may be held up for longer than this object lives
    std::vector<std::shared_ptr<Core>> m_ofParents;
    std::atomic<bool> m_finished = false;
};

/// The process's own, which outlives every static object and flushes when the process exits; a signal that kills it takes with it what the
/// thread had not come to.
LineWriter& stderrWriter();

} // namespace liena::base
