// From a frame's encoded bytes to stored values.
#include "imaging/frame_decoder.hpp"

#include "imaging/jpeg_ls_decoder.hpp"

#include <QCoreApplication>

#include <turbojpeg.h>

#include <algorithm>
#include <exception>
#include <memory>

namespace console {

namespace {

struct Text {
    Q_DECLARE_TR_FUNCTIONS(console::FrameDecoder)
};

QString checkHeader(const XrayFrame& frame)
{
    if (frame.rows < 1 || frame.rows > largestEdge || frame.columns < 1 || frame.columns > largestEdge)
        return Text::tr("its size %1 x %2 is not within 1 to 4096").arg(frame.columns).arg(frame.rows);
    if (frame.bitsStored < 1 || frame.bitsStored > 16)
        return Text::tr("%1 bits stored are not within 1 to 16").arg(frame.bitsStored);
    if (frame.pixels.empty())
        return Text::tr("it holds no pixels");
    if (frame.pixels.size() > largestEncoding)
        return Text::tr("its %1 encoded bytes are more than 16 MiB").arg(frame.pixels.size());
    return {};
}

int storedType(const XrayFrame& frame) { return frame.bitsStored <= 8 ? CV_8UC1 : CV_16UC1; }

// Bits above those stored may hold anything (DICOM PS3.5, 8.1.1) and would come out as wrong grey.
void clearUnusedBits(cv::Mat& stored, int bits)
{
    if (bits == 8 || bits == 16)
        return;
    const auto mask = static_cast<std::uint16_t>((1U << static_cast<unsigned>(bits)) - 1U);
    for (int row = 0; row < stored.rows; ++row) {
        if (stored.type() == CV_8UC1) {
            auto* values = stored.ptr<std::uint8_t>(row);
            for (int column = 0; column < stored.cols; ++column)
                values[column] = static_cast<std::uint8_t>(values[column] & mask);
        } else {
            auto* values = stored.ptr<std::uint16_t>(row);
            for (int column = 0; column < stored.cols; ++column)
                values[column] = static_cast<std::uint16_t>(values[column] & mask);
        }
    }
}

QString decodeRaw(const XrayFrame& frame, cv::Mat& stored)
{
    const std::size_t bytesPerPixel = frame.bitsStored <= 8 ? 1 : 2;
    const std::size_t count = static_cast<std::size_t>(frame.rows) * static_cast<std::size_t>(frame.columns);
    if (frame.pixels.size() != count * bytesPerPixel)
        return Text::tr("%1 x %2 pixels take %3 bytes, and it has %4")
            .arg(frame.columns)
            .arg(frame.rows)
            .arg(count * bytesPerPixel)
            .arg(frame.pixels.size());
    stored.create(frame.rows, frame.columns, storedType(frame));
    const auto* from = reinterpret_cast<const std::uint8_t*>(frame.pixels.data());
    if (bytesPerPixel == 1) {
        std::copy_n(from, count, stored.ptr<std::uint8_t>());
    } else {
        auto* to = stored.ptr<std::uint16_t>();
        for (std::size_t i = 0; i < count; ++i)
            to[i] = static_cast<std::uint16_t>(from[2 * i] | (from[2 * i + 1] << 8U));
    }
    return {};
}

QString checkJpegLsHeader(const XrayFrame& frame, const JpegLsHeader& header)
{
    if (header.columns != frame.columns || header.rows != frame.rows)
        return Text::tr("the JPEG-LS picture is %1 x %2, the message says %3 x %4")
            .arg(header.columns)
            .arg(header.rows)
            .arg(frame.columns)
            .arg(frame.rows);
    const int container = frame.bitsStored <= 8 ? 8 : 16;
    if (header.bits < frame.bitsStored || header.bits > container)
        return Text::tr("the JPEG-LS picture has %1 bits, the message says %2").arg(header.bits).arg(frame.bitsStored);
    if (header.near > frame.quality)
        return Text::tr("its pixels may be off by %1, the message says by at most %2").arg(header.near).arg(frame.quality);
    return {};
}

QString decodeJpegLs(const XrayFrame& frame, cv::Mat& stored)
{
    JpegLsHeader header;
    if (QString refusal = readJpegLsHeader(frame.pixels, header); !refusal.isEmpty())
        return refusal;
    if (QString refusal = checkJpegLsHeader(frame, header); !refusal.isEmpty())
        return refusal;
    stored.create(frame.rows, frame.columns, storedType(frame));
    return decodeJpegLs(header, stored) ? QString() : Text::tr("the JPEG-LS data are damaged");
}

QString decodeJpeg(const XrayFrame& frame, cv::Mat& stored)
{
    if (frame.bitsStored != 8)
        return Text::tr("a JPEG picture has 8 bits, the message says %1").arg(frame.bitsStored);
    const std::unique_ptr<void, int (*)(tjhandle)> decoder(tjInitDecompress(), tjDestroy);
    if (!decoder)
        return Text::tr("the JPEG decoder could not start");
    const auto* bytes = reinterpret_cast<const unsigned char*>(frame.pixels.data());
    const auto size = static_cast<unsigned long>(frame.pixels.size());
    int width = 0;
    int height = 0;
    int subsampling = 0;
    int colours = 0;
    if (tjDecompressHeader3(decoder.get(), bytes, size, &width, &height, &subsampling, &colours) != 0)
        return Text::tr("the JPEG header cannot be read: %1").arg(QString::fromLocal8Bit(tjGetErrorStr2(decoder.get())));
    if (colours != TJCS_GRAY)
        return Text::tr("the JPEG picture is not grey");
    if (width != frame.columns || height != frame.rows)
        return Text::tr("the JPEG picture is %1 x %2, the message says %3 x %4").arg(width).arg(height).arg(frame.columns).arg(frame.rows);
    stored.create(frame.rows, frame.columns, CV_8UC1);
    // A truncated picture is only a warning to the decoder; to us it is no picture.
    constexpr int flags = TJFLAG_ACCURATEDCT | TJFLAG_STOPONWARNING | TJFLAG_LIMITSCANS;
    if (tjDecompress2(decoder.get(), bytes, size, stored.data, width, width, height, TJPF_GRAY, flags) != 0)
        return Text::tr("the JPEG picture cannot be decoded: %1").arg(QString::fromLocal8Bit(tjGetErrorStr2(decoder.get())));
    return {};
}

QString decodeChecked(const XrayFrame& frame, cv::Mat& stored)
{
    switch (frame.encoding) {
    case PixelEncoding::Raw:
        return decodeRaw(frame, stored);
    case PixelEncoding::JpegLs:
        return decodeJpegLs(frame, stored);
    case PixelEncoding::Jpeg:
        return decodeJpeg(frame, stored);
    }
    return Text::tr("its encoding %1 is unknown").arg(static_cast<int>(frame.encoding));
}

} // namespace

QString decodeFrame(const XrayFrame& frame, cv::Mat& stored)
{
    QString refusal = checkHeader(frame);
    try {
        if (refusal.isEmpty())
            refusal = decodeChecked(frame, stored);
        if (refusal.isEmpty())
            clearUnusedBits(stored, frame.bitsStored);
    } catch (const std::exception& exception) {
        refusal = Text::tr("it cannot be decoded: %1").arg(QString::fromLocal8Bit(exception.what()));
    }
    return refusal;
}

} // namespace console
