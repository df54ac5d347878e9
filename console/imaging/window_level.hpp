// Window and level: stored values to 8-bit display values, by DICOM PS3.3 C.11.2.1.2 (VOI LUT function LINEAR).
#pragma once

#include <QImage>

#include <opencv2/core.hpp>

#include <cstdint>
#include <vector>

namespace console {

/// Centre and width in stored values. A width of 1 is a threshold; smaller widths do not exist.
struct GreyWindow {
    double centre = 0;
    double width = 0;

    /// False for "unknown" (width 0) and for numbers that mean nothing.
    bool isKnown() const;
    bool operator==(const GreyWindow&) const = default;
};

enum class Polarity : std::uint8_t {
    LowIsBlack, ///< MONOCHROME2
    LowIsWhite, ///< MONOCHROME1
};

/// The formula for one stored value, rounded to the nearest of 0 … 255.
std::uint8_t displayValue(int stored, GreyWindow window, Polarity polarity);

/// Every 16-bit value's display value, ready as a grey 0xffRRGGBB pixel. One thread at a time.
class WindowLevelTable {
public:
    WindowLevelTable();

    /// Computes the table anew only when something changed.
    void prepare(GreyWindow window, Polarity polarity);

    /// `stored` is CV_8UC1 or CV_16UC1; anything else gives a null image. Format_RGB32.
    QImage apply(const cv::Mat& stored) const;

private:
    std::vector<QRgb> m_pixels;
    GreyWindow m_window;
    Polarity m_polarity = Polarity::LowIsBlack;
};

/// The window for pictures that come without one: from the 1st to the 99th percentile of the picture. Its edges move by at most 5 % of the
/// width from one frame to the next, so that a moving instrument does not make the whole picture flicker.
class AutoWindow {
public:
    GreyWindow next(const cv::Mat& stored);
    void reset() { m_window = {}; }

private:
    GreyWindow m_window;
};

/// From the 1st to the 99th percentile of this one picture.
GreyWindow percentileWindow(const cv::Mat& stored);

} // namespace console
