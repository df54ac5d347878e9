// Reading UTF-8, byte by byte.
#include "base/characters.hpp"

namespace liena::base {

std::size_t sequenceLength(std::string_view text)
{
    const auto lead = static_cast<unsigned char>(text.front());
    const std::size_t length = lead < 0x80                   ? 1
                               : lead >= 0xC2 && lead < 0xE0 ? 2
                               : lead >= 0xE0 && lead < 0xF0 ? 3
                               : lead >= 0xF0 && lead < 0xF5 ? 4
                                                             : 0;
    if (length == 0 || text.size() < length)
        return 0;
    for (std::size_t i = 1; i < length; ++i)
        if ((static_cast<unsigned char>(text[i]) & 0xC0U) != 0x80U)
            return 0;
    const auto second = length > 1 ? static_cast<unsigned char>(text[1]) : 0U;
    const bool overlong = (lead == 0xE0 && second < 0xA0) || (lead == 0xF0 && second < 0x90);
    const bool outside = (lead == 0xED && second >= 0xA0) || (lead == 0xF4 && second >= 0x90); // surrogates, beyond U+10FFFF
    return overlong || outside ? 0 : length;
}

bool isUnsafe(std::string_view sequence)
{
    const auto lead = static_cast<unsigned char>(sequence.front());
    if (sequence.size() == 1)
        return lead < 0x20 || lead == 0x7F;
    if (sequence.size() == 2)
        return (lead == 0xC2 && static_cast<unsigned char>(sequence[1]) < 0xA0) || sequence == "\xD8\x9C";
    if (sequence.starts_with("\xE2\x80"))
        return (sequence[2] >= '\xA8' && sequence[2] <= '\xAE') || sequence[2] == '\x8E' || sequence[2] == '\x8F';
    return sequence.starts_with("\xE2\x81") && sequence[2] >= '\xA6' && sequence[2] <= '\xA9';
}

} // namespace liena::base
