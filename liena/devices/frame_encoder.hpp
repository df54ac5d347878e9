// From pixels to the bytes of an XrayFrame.
#pragma once

#include "image_source.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace liena::devices {

/// The numbers are those of `Encoding` in the X-ray system's message set.
enum class Encoding : std::uint8_t { Raw = 0, JpegLs = 1, Jpeg = 2 };

std::optional<Encoding> encodingFrom(std::string_view name);

/// Not for two threads at once; the memory is used again from picture to picture.
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

    /// The bytes stay valid until the next call. JPEG has 8 bits: a deeper picture is first brought through its window, and
    /// `picture.format` then says what it has become.
    Result<std::span<const std::byte>> encode(Picture& picture);

    Encoding encoding() const { return m_encoding; }
    unsigned quality() const { return m_encoding == Encoding::Raw ? 0 : m_quality; }

private:
    void pack(const Picture& picture);
    Result<std::size_t> encodeJpegLs(const Picture& picture);
    Result<std::size_t> encodeJpeg(const Picture& picture);

    Encoding m_encoding;
    unsigned m_quality;
    std::vector<std::byte> m_packed;
    std::vector<std::byte> m_encoded;
};

} // namespace liena::devices
