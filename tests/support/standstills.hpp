// When something stands still, and for how long, by chance.
#pragma once

#include <chrono>
#include <cmath>
#include <random>

namespace liena::test {

/// So often a second on the average, each for 0.5 ms to `longest`, short ones as often as long ones in proportion.
class Standstills {
public:
    using Nanoseconds = std::chrono::nanoseconds;

    Standstills(double perSecond, std::chrono::microseconds longest, unsigned seed)
        : m_untilNext(perSecond), m_times(static_cast<double>(longest.count()) / shortest), m_random(seed)
    {}

    Nanoseconds untilNext() { return Nanoseconds(static_cast<Nanoseconds::rep>(m_untilNext(m_random) * 1e9)); }

    std::chrono::microseconds length()
    {
        return std::chrono::microseconds(
            static_cast<int>(shortest * std::pow(m_times, std::uniform_real_distribution(0.0, 1.0)(m_random))));
    }

    bool coin() { return std::bernoulli_distribution(0.5)(m_random); }

private:
    static constexpr double shortest = 500; // µs

    std::exponential_distribution<> m_untilNext;
    double m_times;
    std::mt19937_64 m_random;
};

} // namespace liena::test
