// Seeded noise that is the same on every machine.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>

namespace liena::devices {

class NoiseSource {
public:
    explicit NoiseSource(std::uint64_t seed) : m_engine(seed) {}

    /// Evenly from 0 to below 1.
    double uniform() { return static_cast<double>(m_engine() >> 11U) * 0x1.0p-53; }

    /// Normal, mean 0 and deviation 1 (Box and Muller).
    double normal()
    {
        const double radius = std::sqrt(-2 * std::log(1 - uniform()));
        return radius * std::cos(6.283185307179586 * uniform());
    }

    std::uint64_t bits() { return m_engine(); }

private:
    std::mt19937_64 m_engine; // its sequence is prescribed by the standard; that of the distributions is not
};

} // namespace liena::devices
