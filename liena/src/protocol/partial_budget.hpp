// The memory of all partial messages of a process: how much of it is used, and the buffers that are used again.
#pragma once

#include "liena/message.hpp"

#include <chrono>
#include <cstddef>
#include <vector>

namespace liena::protocol {

/// Network thread. What partial messages hold never exceeds the limit; room that is kept before its bytes come, in their buffers and in
/// spare ones, never exceeds a quarter of it, and is only taken while there is that much.
class PartialBudget {
public:
    explicit PartialBudget(std::size_t limit = std::size_t{64} << 20U) : m_limit(limit) {}

    /// For a lane that has taken `held` so far. No lane may have more than is left for the others: one that fills up what it can leaves
    /// half of the limit, n of them leave an (n + 1)th (dynamic thresholds: Choudhury and Hahne, IEEE/ACM Transactions on Networking 6(2),
    /// 1998). A peer that never ends its messages so does not keep those of others out.
    bool take(std::size_t bytes, std::size_t held)
    {
        const auto left = m_limit - m_used;
        if (bytes > left || held + bytes > left - bytes)
            return false;
        m_used += bytes;
        return true;
    }
    void giveBack(std::size_t bytes) { m_used -= bytes; }
    std::size_t used() const { return m_used; }

    struct Buffer {
        FieldBytes bytes;     ///< empty
        std::size_t room = 0; ///< that was kept for it, to be released when its message is whole or given up
    };

    /// With room for `bytes` where that much may be kept.
    Buffer buffer(std::size_t bytes);
    void release(std::size_t room) { m_kept -= room; }

    /// What the application has no use for any more serves the next long message.
    void recycle(FieldBytes&& used);

    /// From time to time: of the spare buffers that nothing has needed for `idleAfter`, one is given back to the heap each time. A burst of
    /// images leaves nothing behind.
    void trim(std::chrono::steady_clock::time_point now);
    static constexpr std::chrono::seconds idleAfter{2};

    /// Room that is kept and holds nothing that is counted as used.
    std::size_t kept() const { return m_kept; }

private:
    bool keep(std::size_t bytes);
    void dropOldest();

    std::size_t m_limit;
    std::size_t m_used = 0;
    std::size_t m_kept = 0;
    std::vector<FieldBytes> m_spare;
    std::size_t m_unneeded = 0; ///< the fewest spare ones since the last look
    std::chrono::steady_clock::time_point m_looked{};
};

} // namespace liena::protocol
