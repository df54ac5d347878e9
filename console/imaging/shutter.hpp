// The display shutter: what lies outside it is painted black and is not asked about brightness (DICOM PS3.3 C.7.6.11).
#pragma once

#include "model/display_settings.hpp"

#include <QImage>
#include <QSize>

namespace console {

/// The largest of its shape that is centred in a picture.
class Shutter {
public:
    Shutter() = default;
    Shutter(ShutterShape shape, QSize picture);

    /// Of a row: the first column inside, and the first behind them; equal when the whole row is outside.
    struct Opening {
        int first = 0;
        int end = 0;
    };
    Opening opening(int row) const;

    bool isOpen() const { return m_shape == ShutterShape::None; }

private:
    ShutterShape m_shape = ShutterShape::None;
    QSize m_picture;
};

/// Everything outside is black whatever the polarity: Shutter Presentation Value (0018,1622) of 0. `image` has the format RGB32 or
/// Grayscale8.
void applyShutter(QImage& image, const Shutter& shutter);

} // namespace console
