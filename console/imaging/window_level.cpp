// Window and level: stored values to 8-bit display values.
#include "imaging/window_level.hpp"

#include "imaging/voi.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace console {

namespace {

constexpr int tableSize = 65536;
constexpr double largestStep = 0.05;
constexpr double largestGrey = 255;

std::uint8_t rounded(double grey) { return static_cast<std::uint8_t>(std::clamp(std::floor(grey + 0.5), 0.0, largestGrey)); }

template <typename Stored, typename Shown>
void mapRows(const cv::Mat& stored, const std::vector<Shown>& table, QImage& image)
{
    for (int row = 0; row < stored.rows; ++row) {
        const Stored* from = stored.ptr<Stored>(row);
        auto* to = reinterpret_cast<Shown*>(image.scanLine(row));
        for (int column = 0; column < stored.cols; ++column)
            to[column] = table[from[column]];
    }
}

template <typename Shown>
void mapAll(const cv::Mat& stored, const std::vector<Shown>& table, QImage& image)
{
    if (stored.type() == CV_8UC1)
        mapRows<std::uint8_t>(stored, table, image);
    else
        mapRows<std::uint16_t>(stored, table, image);
}

// Every fourth pixel of every second row is enough for a percentile, and an eighth of the time.
template <typename Stored>
std::vector<std::uint32_t> sampledHistogram(const cv::Mat& stored, const Shutter& shutter)
{
    const int columnStep = stored.cols >= 64 ? 4 : 1;
    const int rowStep = stored.rows >= 64 ? 2 : 1;
    std::vector<std::uint32_t> histogram(tableSize, 0);
    for (int row = 0; row < stored.rows; row += rowStep) {
        const Stored* from = stored.ptr<Stored>(row);
        const Shutter::Opening opening = shutter.isOpen() ? Shutter::Opening{0, stored.cols} : shutter.opening(row);
        for (int column = opening.first; column < opening.end; column += columnStep)
            ++histogram[from[column]];
    }
    return histogram;
}

// The smallest value that at least this share of the pixels does not exceed.
int percentile(const std::vector<std::uint32_t>& histogram, std::uint64_t total, double share)
{
    const auto wanted = std::max<std::uint64_t>(1, static_cast<std::uint64_t>(std::ceil(static_cast<double>(total) * share)));
    std::uint64_t seen = 0;
    for (std::size_t value = 0; value < histogram.size(); ++value) {
        seen += histogram[value];
        if (seen >= wanted)
            return static_cast<int>(value);
    }
    return tableSize - 1;
}

// LINEAR's lowest value of the ramp and its highest: c − 0.5 ∓ (w − 1)/2.
GreyWindow windowBetween(double low, double high) { return {(low + high) / 2 + 0.5, std::max(high - low, 1.0) + 1}; }

} // namespace

std::uint8_t displayValue(double stored, const Tone& tone, const GreyScale& greyScale)
{
    const double shown = voiValue(stored, tone.window, tone.function, largestGrey);
    const bool inverse = tone.polarity == Polarity::LowIsWhite;
    if (greyScale.isCalibrated())
        return rounded(greyScale.level((inverse ? largestGrey - shown : shown) / largestGrey));
    const std::uint8_t grey = rounded(shown);
    return inverse ? static_cast<std::uint8_t>(largestGrey - grey) : grey;
}

WindowLevelTable::WindowLevelTable() : m_pixels(tableSize, qRgb(0, 0, 0)), m_tone{{32768, 65536}} { compute(); }

void WindowLevelTable::prepare(const Tone& tone, int fractionBits)
{
    if (tone == m_tone && fractionBits == m_fractionBits)
        return;
    m_tone = tone;
    m_fractionBits = fractionBits;
    compute();
}

void WindowLevelTable::setGreyScale(const GreyScale& greyScale)
{
    m_greyScale = greyScale;
    compute();
}

void WindowLevelTable::compute()
{
    const double step = std::ldexp(1.0, -m_fractionBits);
    for (int place = 0; place < tableSize; ++place) {
        const int grey = displayValue(place * step, m_tone, m_greyScale);
        m_pixels[static_cast<std::size_t>(place)] = qRgb(grey, grey, grey);
    }
    m_presentation.resize(m_greyScale.isCalibrated() ? m_pixels.size() : 0);
    for (std::size_t place = 0; place < m_presentation.size(); ++place)
        m_presentation[place] = displayValue(static_cast<double>(place) * step, m_tone);
}

bool WindowLevelTable::apply(const cv::Mat& stored, QImage& image) const
{
    if (stored.empty() || (stored.type() != CV_8UC1 && stored.type() != CV_16UC1))
        return false;
    if (image.width() != stored.cols || image.height() != stored.rows || image.format() != QImage::Format_RGB32)
        image = QImage(stored.cols, stored.rows, QImage::Format_RGB32);
    if (image.isNull())
        return false;
    mapAll(stored, m_pixels, image);
    return true;
}

QImage WindowLevelTable::presentation(const cv::Mat& stored) const
{
    if (m_presentation.empty() || stored.empty() || (stored.type() != CV_8UC1 && stored.type() != CV_16UC1))
        return {};
    QImage image(stored.cols, stored.rows, QImage::Format_Grayscale8);
    if (!image.isNull())
        mapAll(stored, m_presentation, image);
    return image;
}

QImage WindowLevelTable::apply(const cv::Mat& stored) const
{
    QImage image;
    return apply(stored, image) ? image : QImage();
}

GreyWindow percentileWindow(const cv::Mat& stored, const Shutter& shutter)
{
    if (stored.empty() || (stored.type() != CV_8UC1 && stored.type() != CV_16UC1))
        return {};
    const auto histogram =
        stored.type() == CV_8UC1 ? sampledHistogram<std::uint8_t>(stored, shutter) : sampledHistogram<std::uint16_t>(stored, shutter);
    std::uint64_t total = 0;
    for (const std::uint32_t count : histogram)
        total += count;
    if (total == 0)
        return {};
    return windowBetween(percentile(histogram, total, 0.01), percentile(histogram, total, 0.99));
}

GreyWindow AutoWindow::next(const cv::Mat& stored, const Shutter& shutter)
{
    const GreyWindow wanted = percentileWindow(stored, shutter);
    if (!wanted.isKnown())
        return m_window;
    const double wantedLow = wanted.centre - wanted.width / 2;
    const double wantedHigh = wanted.centre + wanted.width / 2;
    const double oldLow = m_window.centre - m_window.width / 2;
    const double oldHigh = m_window.centre + m_window.width / 2;
    const bool beside = wantedLow >= oldHigh || wantedHigh <= oldLow;
    const bool besideAgain = std::exchange(m_wasBeside, beside) && beside;
    if (!m_window.isKnown() || besideAgain) {
        m_wasBeside = false;
        m_window = wanted;
        return m_window;
    }
    // Of the wider one: from a narrow window, as a flat picture has it, steps of its own width would take minutes.
    const double step = largestStep * std::max(m_window.width, wanted.width);
    const double low = oldLow + std::clamp(wantedLow - oldLow, -step, step);
    const double high = std::max(oldHigh + std::clamp(wantedHigh - oldHigh, -step, step), low + 2);
    m_window = {(low + high) / 2, high - low};
    return m_window;
}

} // namespace console
