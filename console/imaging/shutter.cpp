// The display shutter.
#include "imaging/shutter.hpp"

#include <algorithm>
#include <cmath>

namespace console {

namespace {

constexpr double rectangleMargin = 0.05; ///< of the edge, on each side: where collimators leave a bright rim

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
    for (int row = 0; row < image.height(); ++row) {
        auto* pixels = reinterpret_cast<QRgb*>(image.scanLine(row));
        const Shutter::Opening opening = shutter.opening(row);
        std::fill(pixels, pixels + opening.first, qRgb(0, 0, 0));
        std::fill(pixels + opening.end, pixels + image.width(), qRgb(0, 0, 0));
    }
}

} // namespace console
