// The Grayscale Standard Display Function (DICOM PS3.14), and what it makes of a display whose light was measured.
#pragma once

#include <QString>

#include <array>
#include <optional>
#include <vector>

namespace console {

/// PS3.14 section 7.1: luminance in cd/m² of the index j, 1 … 1023; indices between whole ones are meaningful.
double gsdfLuminance(double index);

/// The index of a luminance; 1 or 1023 for what lies outside.
double gsdfIndex(double luminance);

/// A grey level of the display and its light, cd/m².
struct MeasuredGrey {
    int level = 0;
    double luminance = 0;
};

/// A display as it was measured.
struct DisplayMeasurement {
    double ambient = 0; ///< light that the room adds, cd/m²
    std::vector<MeasuredGrey> greys;
};

/// From P-values to grey levels such that equal steps look equal.
class GreyScale {
public:
    /// Not calibrated: the P-value is the level.
    GreyScale() = default;
    explicit GreyScale(const DisplayMeasurement& measurement);

    bool isCalibrated() const { return m_calibrated; }

    /// The level, 0 … 255, of a P-value between 0 and 1.
    double level(double presentation) const;

private:
    static constexpr int steps = 1023;
    std::array<double, steps + 1> m_levels{};
    bool m_calibrated = false;
};

/// A text file: `ambient 0.4`, then a line `level luminance` for each measured grey, 0 and 255 among them, both rising. `#` begins a
/// remark.
struct DisplayMeasurementResult {
    std::optional<DisplayMeasurement> measurement;
    QString error; ///< one sentence with file, line and what to do
};
DisplayMeasurementResult readDisplayMeasurement(const QString& path);

} // namespace console
