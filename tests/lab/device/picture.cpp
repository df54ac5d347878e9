// Pictures whose every byte follows from their number: implementation.
#include "device/picture.hpp"

namespace liena::lab {

namespace {

// Two multipliers that share no factor with 256 make a shifted or repeated segment visible.
std::byte byteAt(std::uint32_t frame, std::size_t place)
{
    return static_cast<std::byte>((frame * 131U + static_cast<std::uint32_t>(place) * 7U + static_cast<std::uint32_t>(place >> 13U)) &
                                  0xFFU);
}

} // namespace

std::vector<std::byte> pictureOf(std::uint32_t frame, std::size_t size)
{
    std::vector<std::byte> bytes(size);
    for (std::size_t i = 0; i < size; ++i)
        bytes[i] = byteAt(frame, i);
    return bytes;
}

bool isPictureOf(std::uint32_t frame, std::span<const std::byte> bytes)
{
    for (std::size_t i = 0; i < bytes.size(); ++i)
        if (bytes[i] != byteAt(frame, i))
            return false;
    return !bytes.empty();
}

} // namespace liena::lab
