// The display shutter.
#include "imaging/shutter.hpp"

#include <algorithm>
#include <cmath>

namespace console {

namespace {

constexpr double rectangleMargin = 0.05; ///< of the edge, on each side: where collimators leave a bright rim

template <typename Pixel>
void blacken(QImage& image, const Shutter& shutter, Pixel black)
{
    for (int row = 0; row < image.height(); ++row) {
        auto* pixels = reinterpret_cast<Pixel*>(image.scanLine(row));
        const Shutter::Opening opening = shutter.opening(row);
        std::fill(pixels, pixels + opening.first, black);
        std::fill(pixels + opening.end, pixels + image.width(), black);
    }
}

} // namespace

Shutter::Shutter(ShutterShape shape, QSize picture) : m_shape(shape), m_picture(picture) {}

Shutter::Opening Shutter::opening(int row) const
{
    const int width = m_picture.width();
    const int height = m_picture.height();
    if (m_shape == ShutterShape::Rectangle) {
        const int top = static_cast<int>(std::lround(height * rectangleMargin));
        const int left = static_cast<int>(std::lround(width * rectangleMargin));
        return row < top || row >= height - top ? Opening{} : Opening{left, width - left};
    }
    if (m_shape == ShutterShape::Circle) {
        const double radius = std::min(width, height) / 2.0;
        const double up = row + 0.5 - height / 2.0;
        if (std::abs(up) >= radius)
            return {};
        const double half = std::sqrt(radius * radius - up * up);
        return {static_cast<int>(std::ceil(width / 2.0 - half - 0.5)), static_cast<int>(std::floor(width / 2.0 + half - 0.5)) + 1};
    }
    return {0, width};
}

void applyShutter(QImage& image, const Shutter& shutter)
{
    if (shutter.isOpen())
        return;
    if (image.format() == QImage::Format_Grayscale8)
        blacken<uchar>(image, shutter, 0);
    else
        blacken<QRgb>(image, shutter, qRgb(0, 0, 0));
}

} // namespace console
