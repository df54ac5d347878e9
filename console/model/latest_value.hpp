// Hands the newest value from one thread to another without a lock: neither ever waits for the other.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

namespace console {

/// One writer thread, one reader thread. Three slots: one belongs to the writer, one to the reader, one changes hands.
template <typename T>
class LatestValue {
public:
    void write(const T& value)
    {
        m_slots[m_writing] = value;
        m_writing = m_between.exchange(static_cast<std::uint8_t>(m_writing | fresh), std::memory_order_acq_rel) & index;
    }

    /// The newest value written; the same one again when there was no write since.
    const T& read()
    {
        if ((m_between.load(std::memory_order_relaxed) & fresh) != 0)
            m_reading = m_between.exchange(m_reading, std::memory_order_acq_rel) & index;
        return m_slots[m_reading];
    }

private:
    static constexpr std::uint8_t fresh = 4;
    static constexpr std::uint8_t index = 3;

    std::array<T, 3> m_slots{};
    std::uint8_t m_writing = 0;
    std::uint8_t m_reading = 1;
    std::atomic<std::uint8_t> m_between{2};
};

} // namespace console
