// From pixels to the bytes of an XrayFrame: implementation.
#include "frame_encoder.hpp"

#include <charls/charls.h>
#include <turbojpeg.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>

namespace liena::devices {

namespace {

// Through the window into 8 bits: what JPEG can hold is for display only.
void showInEightBits(Picture& picture)
{
    PictureFormat& format = picture.format;
    const double width = format.windowWidth > 0 ? format.windowWidth : 1 << format.bitsStored;
    const double low = (format.windowWidth > 0 ? format.windowCentre : width / 2) - width / 2;
    for (std::uint16_t& pixel : picture.pixels)
        pixel = static_cast<std::uint16_t>(std::clamp((pixel - low) * 255 / width + 0.5, 0.0, 255.0));
    format.bitsStored = 8;
    format.relationship = IntensityRelationship::Display;
    format.windowCentre = 128;
    format.windowWidth = 256;
}

auto failed(const char* codec, const std::string& why)
{
    return fail(Errc::InvalidArgument, std::string("a picture could not be encoded as ") + codec + ": " + why + "; try --encoding raw");
}

} // namespace

std::optional<Encoding> encodingFrom(std::string_view name)
{
    if (name == "raw")
        return Encoding::Raw;
    if (name == "jpeg-ls")
        return Encoding::JpegLs;
    if (name == "jpeg")
        return Encoding::Jpeg;
    return std::nullopt;
}

FrameEncoder::Bytes FrameEncoder::pack(const Picture& picture)
{
    const bool wide = picture.format.bitsStored > 8;
    Bytes packed(picture.pixels.size() * (wide ? 2 : 1));
    auto out = packed.begin();
    for (const std::uint16_t pixel : picture.pixels) {
        *out++ = static_cast<std::byte>(pixel & 0xFFU);
        if (wide)
            *out++ = static_cast<std::byte>(pixel >> 8U);
    }
    return packed;
}

Result<EncodedPicture> FrameEncoder::encode(Picture& picture)
{
    const auto& format = picture.format;
    if (picture.pixels.size() != std::size_t{format.rows} * format.columns) // the codecs read as many as the format says
        return fail(Errc::InvalidArgument, "a picture of " + std::to_string(format.columns) + " x " + std::to_string(format.rows) +
                                               " has " + std::to_string(picture.pixels.size()) + " pixels; its source must fill it");
    if (m_encoding == Encoding::Jpeg && picture.format.bitsStored > 8)
        showInEightBits(picture);
    if (m_encoding == Encoding::Raw)
        return std::make_shared<const Bytes>(pack(picture));
    Result<Bytes> encoded = m_encoding == Encoding::JpegLs ? encodeJpegLs(picture) : encodeJpeg(picture);
    if (!encoded)
        return encoded.error();
    return std::make_shared<const Bytes>(std::move(encoded.value()));
}

Result<FrameEncoder::Bytes> FrameEncoder::encodeJpegLs(const Picture& picture) const
{
    const auto bits = std::max<std::int32_t>(2, picture.format.bitsStored);
    const Bytes packed = pack(picture);
    try {
        charls::jpegls_encoder encoder;
        encoder.frame_info({picture.format.columns, picture.format.rows, bits, 1});
        encoder.near_lossless(static_cast<std::int32_t>(m_quality));
        Bytes encoded(encoder.estimated_destination_size());
        encoder.destination(encoded.data(), encoded.size());
        encoded.resize(encoder.encode(packed.data(), packed.size()));
        return encoded;
    } catch (const std::exception& error) {
        return failed("JPEG-LS", error.what());
    }
}

Result<FrameEncoder::Bytes> FrameEncoder::encodeJpeg(const Picture& picture) const
{
    const std::unique_ptr<void, int (*)(tjhandle)> codec(tjInitCompress(), tjDestroy);
    const int columns = picture.format.columns;
    const int rows = picture.format.rows;
    const Bytes packed = pack(picture);
    Bytes encoded(tjBufSize(columns, rows, TJSAMP_GRAY));
    auto* out = reinterpret_cast<unsigned char*>(encoded.data());
    unsigned long size = encoded.size();
    const auto* in = reinterpret_cast<const unsigned char*>(packed.data());
    if (!codec || tjCompress2(codec.get(), in, columns, 0, rows, TJPF_GRAY, &out, &size, TJSAMP_GRAY, static_cast<int>(m_quality),
                              TJFLAG_NOREALLOC) != 0)
        return failed("JPEG", tjGetErrorStr2(codec.get()));
    encoded.resize(size);
    return encoded;
}

} // namespace liena::devices
