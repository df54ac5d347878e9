// Hands values from one thread to another: the newest only, with one wake-up for a burst.
#pragma once

#include <cstdint>
#include <mutex>
#include <optional>
#include <utility>

namespace console {

/// The giving thread calls put(), and wakes the taker only when it says so; the taker calls take(). Nothing queues up: a value that was not
/// taken is replaced and counted.
template <typename Value>
class NewestHandover {
public:
    /// True when the taker must be woken; false while an earlier wake-up is still on its way.
    bool put(Value value)
    {
        const std::lock_guard lock(m_mutex);
        if (m_value)
            ++m_replaced;
        const bool mustWake = !m_value;
        m_value = std::move(value);
        return mustWake;
    }

    std::optional<Value> take()
    {
        const std::lock_guard lock(m_mutex);
        return std::exchange(m_value, std::nullopt);
    }

    std::uint64_t replaced() const
    {
        const std::lock_guard lock(m_mutex);
        return m_replaced;
    }

private:
    mutable std::mutex m_mutex;
    std::optional<Value> m_value;
    std::uint64_t m_replaced = 0;
};

} // namespace console
