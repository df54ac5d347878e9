// How a person wants pictures shown: window, curve, filters, shutter. Values only; the picture chain carries them out.
#pragma once

#include <QString>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

namespace console {

/// Centre and width in stored values. In LINEAR a width of 1 is a threshold, and smaller widths do not exist.
struct GreyWindow {
    double centre = 0;
    double width = 0;

    /// False for "unknown" (width 0) and for numbers that mean nothing.
    bool isKnown() const { return std::isfinite(centre) && std::isfinite(width) && width > 0; }
    bool operator==(const GreyWindow&) const = default;
};

/// Of what values a window is: those of a picture of so many bits, sent with this window (unknown: none).
struct WindowBasis {
    int bits = 0;
    GreyWindow sent;

    bool operator==(const WindowBasis&) const = default;
};

/// A window for pictures of another depth, so that the same shows as before: an X-ray system that sends fewer bits brings its sent window
/// to them, linearly. Unchanged for the same depth, whatever window pictures of it are sent with.
GreyWindow carriedOver(GreyWindow window, const WindowBasis& from, const WindowBasis& to);

/// VOI LUT Function (0028,1056).
enum class VoiFunction : std::uint8_t { Linear, LinearExact, Sigmoid };

/// LINEAR, LINEAR_EXACT, SIGMOID: DICOM's own words.
QString word(VoiFunction function);

/// Where the window comes from.
enum class WindowChoice : std::uint8_t {
    AsSent,    ///< the frame's own; automatic for a frame without one
    Automatic, ///< AUTO: from the 1st to the 99th percentile
    FullRange, ///< every value that can be stored
    Narrow,    ///< the frame's own centre, half its width
    Wide,      ///< the frame's own centre, twice its width
    Fixed,     ///< a person's
};
inline constexpr int windowChoiceCount = 6;
QString word(WindowChoice choice);

enum class ShutterShape : std::uint8_t { None, Circle, Rectangle };
QString word(ShutterShape shape);

/// How edges are enhanced.
enum class EdgeMethod : std::uint8_t {
    UnsharpMask, ///< details of a wire's width
    MultiScale,  ///< weak details of every size
};
QString word(EdgeMethod method);

struct DisplaySettings {
    WindowChoice window = WindowChoice::AsSent;
    GreyWindow fixed;    ///< for WindowChoice::Fixed
    WindowBasis fixedOn; ///< of what it was set on
    VoiFunction function = VoiFunction::Linear;
    bool inverted = false;  ///< Presentation LUT Shape INVERSE
    int noiseReduction = 0; ///< 0 … 100 %: strength of the temporal filter
    int edge = 0;           ///< 0 … 100 %: Display Filter Percentage (0028,9411); 0 = none
    EdgeMethod edgeMethod = EdgeMethod::UnsharpMask;
    ShutterShape shutter = ShutterShape::None; ///< the largest that fits into the picture

    bool operator==(const DisplaySettings&) const = default;
};

/// What can be chosen for how far what is measured is above the table's top, mm: half of what a patient is thick.
inline constexpr std::array<int, 5> objectHeights{50, 75, 100, 125, 150};

/// The plane in which lengths are known from the C-arm's geometry.
struct MeasurePlane {
    std::optional<int> object;   ///< mm above the table's top; nothing: the isocentre's plane
    std::optional<int> tableTop; ///< mm that the table's top is below the isocentre at the reported height 0; nothing: not set up

    bool operator==(const MeasurePlane&) const = default;
};

/// Every number brought into its bounds; a fixed window that means nothing becomes the frame's own.
DisplaySettings withinBounds(DisplaySettings settings);

/// The window after a mouse or a key moved it: shares of its width; never narrower than 2 or outside what 16 bits can hold.
GreyWindow moved(GreyWindow window, double centreShare, double widthShare);

} // namespace console
