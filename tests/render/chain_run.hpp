// A display chain and small pictures for it.
#pragma once

#include "imaging/display_chain.hpp"
#include "sample_frames.hpp"

#include <cmath>

namespace console::samples {

inline constexpr QSize chainSize(64, 48);

/// Every pixel the same; 15 pictures a second.
inline std::shared_ptr<XrayFrame> flatFrame(quint32 number, std::uint16_t value, int bits = 12)
{
    auto made = frame(number, chainSize, bits, PixelEncoding::Raw);
    const std::vector<std::uint16_t> values(static_cast<std::size_t>(chainSize.width() * chainSize.height()), value);
    made->rate = 15;
    return withBytes(*made, encode(values, chainSize, bits, PixelEncoding::Raw, 0));
}

/// From the dark to the bright end of the window that is sent, along each row. In 8 bits as the X-ray system's ladder does it: the window
/// that is sent in 12 becomes the whole.
inline std::shared_ptr<XrayFrame> rampFrame(quint32 number, int bits)
{
    auto made = frame(number, chainSize, bits, PixelEncoding::Raw);
    std::vector<std::uint16_t> values;
    for (int i = 0; i < chainSize.width() * chainSize.height(); ++i) {
        const double share = static_cast<double>(i % chainSize.width()) / chainSize.width();
        values.push_back(static_cast<std::uint16_t>(std::lround(bits > 8 ? 1048 + 2000 * share : 255 * share)));
    }
    made->windowCentre = bits > 8 ? 2048 : 128;
    made->windowWidth = bits > 8 ? 2000 : 256;
    return withBytes(*made, encode(values, chainSize, bits, PixelEncoding::Raw, 0));
}

struct ChainRun {
    DisplayPicture show(const XrayFrame& frame, const DisplaySettings& settings, Duration room = std::chrono::seconds(10))
    {
        DisplayPicture picture;
        refusal = chain.process(frame, settings, room, picture);
        return picture;
    }

    DisplayChain chain;
    QString refusal;
};

} // namespace console::samples
