// Window and level: stored values to 8-bit display values, by a VOI LUT function, the polarity and the display's grey scale.
#pragma once

#include "imaging/grey_scale.hpp"
#include "imaging/shutter.hpp"
#include "model/display_settings.hpp"

#include <QImage>

#include <opencv2/core.hpp>

#include <cstdint>
#include <vector>

namespace console {

enum class Polarity : std::uint8_t {
    LowIsBlack, ///< MONOCHROME2
    LowIsWhite, ///< MONOCHROME1, and Presentation LUT Shape INVERSE
};

/// What a stored value becomes on the screen depends on these and on nothing else.
struct Tone {
    GreyWindow window;
    VoiFunction function = VoiFunction::Linear;
    Polarity polarity = Polarity::LowIsBlack;

    bool operator==(const Tone&) const = default;
};

/// The formula for one stored value, rounded to the nearest of 0 … 255.
std::uint8_t displayValue(double stored, const Tone& tone, const GreyScale& greyScale = {});

/// Every 16-bit value's display value, ready as a grey 0xffRRGGBB pixel. One thread at a time.
class WindowLevelTable {
public:
    WindowLevelTable();

    /// Computes the table anew only when something changed. With `fractionBits` the values of `apply` are stored values times 2 to that
    /// power, so that what filters added between two stored values is not lost.
    void prepare(const Tone& tone, int fractionBits = 0);

    void setGreyScale(const GreyScale& greyScale);
    bool isCalibrated() const { return m_greyScale.isCalibrated(); }

    /// `stored` is CV_8UC1 or CV_16UC1; false for anything else. `image` is made anew (Format_RGB32) when its size does not fit.
    bool apply(const cv::Mat& stored, QImage& image) const;
    QImage apply(const cv::Mat& stored) const;

    /// The P-values (PS3.14) that a calibrated display's levels are made of, Format_Grayscale8. Null without a calibration, where apply()
    /// gives them, for what that refuses, and without memory.
    QImage presentation(const cv::Mat& stored) const;

private:
    void compute();

    std::vector<QRgb> m_pixels;
    std::vector<std::uint8_t> m_presentation; ///< empty without a calibration
    GreyScale m_greyScale;
    Tone m_tone;
    int m_fractionBits = 0;
};

/// The window for pictures that come without one: from the 1st to the 99th percentile of the picture. From one frame to the next its edges
/// move by at most 5 % of the present or the wanted width, whichever is larger, so that a moving instrument does not make the whole picture
/// flicker. Two pictures in a row of which it would show nothing but black or white begin it anew; one alone may be a pulse that failed.
class AutoWindow {
public:
    GreyWindow next(const cv::Mat& stored, const Shutter& shutter = {});
    void reset() { *this = AutoWindow(); }

private:
    GreyWindow m_window;
    bool m_wasBeside = false; ///< the last picture's values lay wholly outside
};

/// From the 1st to the 99th percentile of this one picture, inside the shutter.
GreyWindow percentileWindow(const cv::Mat& stored, const Shutter& shutter = {});

} // namespace console
