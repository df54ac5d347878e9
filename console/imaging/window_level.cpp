// Window and level: stored values to 8-bit display values, by DICOM PS3.3 C.11.2.1.2 (VOI LUT function LINEAR).
#include "imaging/window_level.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace console {

namespace {

constexpr int tableSize = 65536;
constexpr double largestStep = 0.05;

template <typename Stored>
void mapRows(const cv::Mat& stored, const std::vector<QRgb>& table, QImage& image)
{
    for (int row = 0; row < stored.rows; ++row) {
        const Stored* from = stored.ptr<Stored>(row);
        auto* to = reinterpret_cast<QRgb*>(image.scanLine(row));
        for (int column = 0; column < stored.cols; ++column)
            to[column] = table[from[column]];
    }
}

// Every fourth pixel of every second row is enough for a percentile, and an eighth of the time.
template <typename Stored>
std::vector<std::uint32_t> sampledHistogram(const cv::Mat& stored)
{
    const int columnStep = stored.cols >= 64 ? 4 : 1;
    const int rowStep = stored.rows >= 64 ? 2 : 1;
    std::vector<std::uint32_t> histogram(tableSize, 0);
    for (int row = 0; row < stored.rows; row += rowStep) {
        const Stored* from = stored.ptr<Stored>(row);
        for (int column = 0; column < stored.cols; column += columnStep)
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

bool GreyWindow::isKnown() const { return std::isfinite(centre) && std::isfinite(width) && width > 0; }

std::uint8_t displayValue(int stored, GreyWindow window, Polarity polarity)
{
    const double width = std::max(window.width, 1.0);
    const double middle = window.centre - 0.5;
    const double half = (width - 1) / 2;
    const double value = stored;
    double shown = 0;
    if (value <= middle - half)
        shown = 0;
    else if (value > middle + half)
        shown = 255;
    else
        shown = (2 * (value - middle) + (width - 1)) * 255 / (2 * (width - 1)); // one division, so that halves stay exact
    const auto grey = static_cast<std::uint8_t>(std::clamp(std::floor(shown + 0.5), 0.0, 255.0));
    return polarity == Polarity::LowIsWhite ? static_cast<std::uint8_t>(255 - grey) : grey;
}

WindowLevelTable::WindowLevelTable() : m_pixels(tableSize, qRgb(0, 0, 0)) { prepare({32768, 65536}, Polarity::LowIsBlack); }

void WindowLevelTable::prepare(GreyWindow window, Polarity polarity)
{
    if (window == m_window && polarity == m_polarity)
        return;
    m_window = window;
    m_polarity = polarity;
    for (int stored = 0; stored < tableSize; ++stored) {
        const int grey = displayValue(stored, window, polarity);
        m_pixels[static_cast<std::size_t>(stored)] = qRgb(grey, grey, grey);
    }
}

QImage WindowLevelTable::apply(const cv::Mat& stored) const
{
    if (stored.empty() || (stored.type() != CV_8UC1 && stored.type() != CV_16UC1))
        return {};
    QImage image(stored.cols, stored.rows, QImage::Format_RGB32);
    if (image.isNull())
        return {};
    if (stored.type() == CV_8UC1)
        mapRows<std::uint8_t>(stored, m_pixels, image);
    else
        mapRows<std::uint16_t>(stored, m_pixels, image);
    return image;
}

GreyWindow percentileWindow(const cv::Mat& stored)
{
    if (stored.empty() || (stored.type() != CV_8UC1 && stored.type() != CV_16UC1))
        return {};
    const auto histogram = stored.type() == CV_8UC1 ? sampledHistogram<std::uint8_t>(stored) : sampledHistogram<std::uint16_t>(stored);
    std::uint64_t total = 0;
    for (const std::uint32_t count : histogram)
        total += count;
    return windowBetween(percentile(histogram, total, 0.01), percentile(histogram, total, 0.99));
}

GreyWindow AutoWindow::next(const cv::Mat& stored)
{
    const GreyWindow wanted = percentileWindow(stored);
    if (!wanted.isKnown())
        return m_window;
    if (!m_window.isKnown()) {
        m_window = wanted;
        return m_window;
    }
    const double step = largestStep * m_window.width;
    const double wantedLow = wanted.centre - wanted.width / 2;
    const double wantedHigh = wanted.centre + wanted.width / 2;
    const double oldLow = m_window.centre - m_window.width / 2;
    const double oldHigh = m_window.centre + m_window.width / 2;
    const double low = oldLow + std::clamp(wantedLow - oldLow, -step, step);
    const double high = std::max(oldHigh + std::clamp(wantedHigh - oldHigh, -step, step), low + 2);
    m_window = {(low + high) / 2, high - low};
    return m_window;
}

} // namespace console
