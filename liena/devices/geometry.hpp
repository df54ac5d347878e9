// Points and directions in the patient's frame (mm; x right, y posterior, z up).
#pragma once

#include <cmath>

namespace liena::devices {

struct Vector {
    double x = 0;
    double y = 0;
    double z = 0;

    friend constexpr Vector operator+(Vector a, Vector b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    friend constexpr Vector operator-(Vector a, Vector b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    friend constexpr Vector operator*(Vector a, double factor) { return {a.x * factor, a.y * factor, a.z * factor}; }
    friend constexpr bool operator==(Vector a, Vector b) = default;
};

constexpr double dot(Vector a, Vector b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr Vector cross(Vector a, Vector b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
inline double length(Vector a) { return std::sqrt(dot(a, a)); }

/// A zero vector stays as it is.
inline Vector normalised(Vector a)
{
    const double size = length(a);
    return size > 0 ? a * (1 / size) : a;
}

constexpr double pi = 3.14159265358979323846;
constexpr double radians(double degrees) { return degrees * pi / 180; }

} // namespace liena::devices
