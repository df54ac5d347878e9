// X-ray frames made for tests: a known picture in every depth and encoding.
#include "sample_frames.hpp"

#include <charls/charls.h>
#include <turbojpeg.h>

#include <stdexcept>

namespace console::samples {

namespace {

std::vector<std::byte> rawBytes(const std::vector<std::uint16_t>& values, int bits)
{
    std::vector<std::byte> bytes;
    bytes.reserve(values.size() * 2);
    for (const std::uint16_t value : values) {
        bytes.push_back(static_cast<std::byte>(value & 0xFFU));
        if (bits > 8)
            bytes.push_back(static_cast<std::byte>(value >> 8U));
    }
    return bytes;
}

std::vector<std::byte> jpegLsBytes(const std::vector<std::byte>& raw, QSize size, int bits, int near)
{
    charls::jpegls_encoder encoder;
    encoder.frame_info({static_cast<std::uint32_t>(size.width()), static_cast<std::uint32_t>(size.height()), bits, 1}).near_lossless(near);
    std::vector<std::byte> bytes(encoder.estimated_destination_size());
    encoder.destination(bytes.data(), bytes.size());
    bytes.resize(encoder.encode(raw.data(), raw.size()));
    return bytes;
}

std::vector<std::byte> jpegBytes(const std::vector<std::byte>& raw, QSize size, int quality)
{
    const std::unique_ptr<void, int (*)(tjhandle)> encoder(tjInitCompress(), tjDestroy);
    unsigned char* encoded = nullptr;
    unsigned long length = 0;
    if (tjCompress2(encoder.get(), reinterpret_cast<const unsigned char*>(raw.data()), size.width(), 0, size.height(), TJPF_GRAY, &encoded,
                    &length, TJSAMP_GRAY, quality, 0) != 0)
        throw std::runtime_error("the sample picture could not be encoded as JPEG");
    const auto* first = reinterpret_cast<const std::byte*>(encoded);
    std::vector<std::byte> bytes(first, first + length);
    tjFree(encoded);
    return bytes;
}

} // namespace

std::vector<std::uint16_t> storedValues(QSize size, int bits)
{
    std::vector<std::uint16_t> values;
    values.reserve(static_cast<std::size_t>(size.width()) * static_cast<std::size_t>(size.height()));
    const unsigned largest = (1U << static_cast<unsigned>(bits)) - 1U;
    for (int row = 0; row < size.height(); ++row)
        for (int column = 0; column < size.width(); ++column) {
            const double ramp = static_cast<double>(column + row) / (size.width() + size.height() - 2);
            const auto texture = static_cast<unsigned>(row * 7 + column * 3) % 5U;
            values.push_back(static_cast<std::uint16_t>(std::min(largest, static_cast<unsigned>(ramp * largest) + texture)));
        }
    return values;
}

std::vector<std::byte> encode(const std::vector<std::uint16_t>& values, QSize size, int bits, PixelEncoding encoding, int quality)
{
    std::vector<std::byte> raw = rawBytes(values, bits);
    switch (encoding) {
    case PixelEncoding::Raw:
        return raw;
    case PixelEncoding::JpegLs:
        return jpegLsBytes(raw, size, std::max(bits, 2), quality);
    case PixelEncoding::Jpeg:
        return jpegBytes(raw, size, quality);
    }
    throw std::logic_error("unknown encoding");
}

std::shared_ptr<XrayFrame> withBytes(const XrayFrame& frame, std::vector<std::byte> bytes)
{
    auto copy = std::make_shared<XrayFrame>(frame);
    const auto owner = std::make_shared<const std::vector<std::byte>>(std::move(bytes));
    copy->pixels = *owner;
    copy->owner = owner;
    return copy;
}

std::shared_ptr<XrayFrame> frame(quint32 number, QSize size, int bits, PixelEncoding encoding, int quality)
{
    XrayFrame made;
    made.frame = number;
    made.acquisition = 1;
    made.source = PictureSource::Simulated;
    made.rows = size.height();
    made.columns = size.width();
    made.bitsStored = bits;
    made.encoding = encoding;
    made.quality = quality;
    made.imagerPixelSpacing = 0.3;
    made.windowCentre = 1 << (bits - 1);
    made.windowWidth = 1 << bits;
    made.geometry.sourceDetectorDistance = 1100;
    made.geometry.sourceObjectDistance = 750;
    made.captureNs = 1'700'000'000'000'000'000ULL + number * 66'000'000ULL;
    made.arrival = std::chrono::steady_clock::now();
    made.ageAtArrival = std::chrono::milliseconds(20);
    auto values = storedValues(size, bits);
    const unsigned largest = (1U << static_cast<unsigned>(bits)) - 1U;
    // No two pulses give the same picture; by little, since some tests hold one against another.
    for (std::size_t place = 1, rest = number - 1; rest != 0; ++place, rest >>= 3U)
        values.at(values.size() - place) = static_cast<std::uint16_t>(values.at(values.size() - place) ^ (rest & 7U & largest));
    return withBytes(made, encode(values, size, bits, encoding, quality));
}

int linearGrey(int stored, int centre, int width)
{
    // Everything twice as large, so that the halves of the formula are whole numbers.
    const long long offset = 2LL * stored - 2LL * centre + 1;
    const long long half = width - 1;
    if (offset <= -half)
        return 0;
    if (offset > half)
        return 255;
    const long long numerator = (offset + half) * 255;
    const long long denominator = 2 * half;
    return static_cast<int>((2 * numerator + denominator) / (2 * denominator));
}

} // namespace console::samples
