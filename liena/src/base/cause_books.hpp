// How often each cause of a refusal came up, and when to speak of it: the first time at once, later at most every so often.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>

namespace liena::base {

/// Whatever others send, it stays small: beyond `most` kinds, new ones share one entry.
class CauseBooks {
public:
    using Instant = std::chrono::steady_clock::time_point;

    explicit CauseBooks(std::size_t most, std::chrono::seconds pause = std::chrono::seconds(10)) : m_most(most), m_pause(pause) {}

    /// The count to tell now, of those not told yet and this one; or nothing.
    std::optional<std::uint64_t> count(const std::string& cause, std::uint32_t about, Instant now)
    {
        auto& entry = entryOf({cause, about});
        ++entry.all;
        ++entry.untold;
        if (entry.lastTold && now - *entry.lastTold < m_pause)
            return std::nullopt;
        entry.lastTold = now;
        return std::exchange(entry.untold, 0);
    }

    /// The causes are over; the next one is told at once.
    void forget() { m_entries.clear(); }

    /// Calls `tell(cause, about, count)` for each, with all that came since the beginning.
    template <typename Tell>
    void forEach(Tell&& tell) const
    {
        for (const auto& [key, entry] : m_entries)
            tell(key.first, key.second, entry.all);
    }

    std::size_t size() const { return m_entries.size(); }

private:
    using Key = std::pair<std::string, std::uint32_t>;
    struct Entry {
        std::uint64_t all = 0;
        std::uint64_t untold = 0;
        std::optional<Instant> lastTold;
    };

    Entry& entryOf(const Key& key)
    {
        const auto found = m_entries.find(key);
        if (found != m_entries.end())
            return found->second;
        return m_entries[m_entries.size() < m_most ? key : Key{}];
    }

    std::size_t m_most;
    std::chrono::seconds m_pause;
    std::map<Key, Entry> m_entries;
};

/// ` (3 times)`, or nothing for a single one.
inline std::string timesText(std::uint64_t count) { return count > 1 ? " (" + std::to_string(count) + " times)" : std::string(); }

} // namespace liena::base
