// The wall-clock stamp of a message: nanoseconds since the Unix epoch on the origin's clock (protocol section 1).
#pragma once

#include <chrono>
#include <compare>
#include <cstdint>

namespace liena {

struct Timestamp {
    std::uint64_t ns = 0;

    static Timestamp now()
    {
        const auto since = std::chrono::system_clock::now().time_since_epoch();
        return {static_cast<std::uint64_t>(std::chrono::duration_cast<std::chrono::nanoseconds>(since).count())};
    }

    friend constexpr auto operator<=>(Timestamp, Timestamp) = default;
};

/// Gives strictly increasing stamps whatever the clock does: a tie or a step back yields the previous stamp + 1 ns.
class TimestampSource {
public:
    constexpr Timestamp next(Timestamp clock)
    {
        m_last = clock > m_last ? clock : Timestamp{m_last.ns + 1};
        return m_last;
    }

private:
    Timestamp m_last;
};

} // namespace liena
