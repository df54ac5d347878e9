// From pixels to the bytes of an XrayFrame.
#pragma once

#include "image_source.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

namespace liena::devices {

/// The numbers are those of `Encoding` in the X-ray system's message set.
enum class Encoding : std::uint8_t { Raw = 0, JpegLs = 1, Jpeg = 2 };

std::optional<Encoding> encodingFrom(std::string_view name);

/// A picture as it travels; whoever sends it lends it.
using EncodedPicture = std::shared_ptr<const std::vector<std::byte>>;

/// Not for two threads at once.
class FrameEncoder {
public:
    /// `quality`: JPEG-LS: no pixel is off by more than this; JPEG: 1 to 100.
    FrameEncoder(Encoding encoding, unsigned quality) : m_encoding(encoding), m_quality(quality) {}

    /// From the next picture on.
    void use(Encoding encoding, unsigned quality)
    {
        m_encoding = encoding;
        m_quality = quality;
    }

    /// JPEG has 8 bits: a deeper picture is first brought through its window, and `picture.format` then says what it has become.
    Result<EncodedPicture> encode(Picture& picture);

    Encoding encoding() const { return m_encoding; }
    unsigned quality() const { return m_encoding == Encoding::Raw ? 0 : m_quality; }

private:
    using Bytes = std::vector<std::byte>;

    static Bytes pack(const Picture& picture);
    Result<Bytes> encodeJpegLs(const Picture& picture) const;
    Result<Bytes> encodeJpeg(const Picture& picture) const;

    Encoding m_encoding;
    unsigned m_quality;
};

} // namespace liena::devices
