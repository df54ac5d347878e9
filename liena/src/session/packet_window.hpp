// Which packet numbers of the datagram path were heard already (protocol section 6, ruling B4).
#pragma once

#include <bitset>
#include <cstddef>
#include <cstdint>

namespace liena::session {

/// One per peer and token. Ask first, and note only what has proved genuine: a forged number must not move the window.
class PacketWindow {
public:
    static constexpr std::uint64_t reach = 1024; ///< numbers further behind the newest are refused

    bool isNew(std::uint64_t number) const
    {
        if (number == 0 || (m_newest > reach && number < m_newest - reach))
            return false;
        return number > m_newest || !m_seen[place(number)];
    }

    /// `number` is new.
    void note(std::uint64_t number)
    {
        if (number > m_newest) {
            if (number - m_newest >= span)
                m_seen.reset();
            else
                for (auto skipped = m_newest + 1; skipped < number; ++skipped)
                    m_seen.reset(place(skipped));
            m_newest = number;
        }
        m_seen.set(place(number));
    }

    std::uint64_t newest() const { return m_newest; }

private:
    static constexpr std::size_t span = 2048; ///< more than `reach` + 1, and a power of two

    static std::size_t place(std::uint64_t number) { return static_cast<std::size_t>(number % span); }

    std::uint64_t m_newest = 0;
    std::bitset<span> m_seen;
};

} // namespace liena::session
