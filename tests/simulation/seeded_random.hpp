// Random numbers that are the same with every compiler: integers only, one stream per purpose.
#pragma once

#include <chrono>
#include <cstdint>
#include <string_view>

namespace liena::simulation {

/// splitmix64. A stream is named, so that a new draw in one place does not shift the draws of another.
class SeededRandom {
public:
    explicit constexpr SeededRandom(std::uint64_t seed, std::string_view stream = {}) : m_state(mixed(seed))
    {
        for (const char letter : stream)
            m_state = mixed(m_state ^ static_cast<unsigned char>(letter));
    }

    constexpr std::uint64_t next()
    {
        m_state += 0x9E3779B97F4A7C15U;
        return mixed(m_state);
    }

    /// 0 to bound − 1; bound is far below 2^64, so the remainder's bias does not matter.
    constexpr std::uint64_t below(std::uint64_t bound) { return next() % bound; }

    constexpr std::uint64_t between(std::uint64_t low, std::uint64_t high) { return low + below(high - low + 1); }

    constexpr std::chrono::nanoseconds between(std::chrono::nanoseconds low, std::chrono::nanoseconds high)
    {
        return low + std::chrono::nanoseconds(static_cast<std::int64_t>(below(static_cast<std::uint64_t>((high - low).count()) + 1)));
    }

    constexpr bool chance(std::uint64_t perMillion) { return perMillion != 0 && below(1'000'000) < perMillion; }

    /// Of its own, and it does not shift this one's draws further than one step.
    constexpr SeededRandom fork() { return SeededRandom(next()); }

private:
    static constexpr std::uint64_t mixed(std::uint64_t z)
    {
        z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
        z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
        return z ^ (z >> 31U);
    }

    std::uint64_t m_state;
};

} // namespace liena::simulation
