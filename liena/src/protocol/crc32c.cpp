// CRC-32C: by the processor's own instruction where it has one, else eight bytes at a time by tables.
#include "protocol/crc32c.hpp"

#include <array>
#include <cstring>

#if defined(__x86_64__)
#include <nmmintrin.h>
#endif

namespace liena::protocol {

namespace {

constexpr std::uint32_t reversedPolynomial = 0x82F63B78U;
constexpr std::size_t wordSize = sizeof(std::uint64_t);

/// Row k: what a byte does to the sum that k more bytes follow.
constexpr std::array<std::array<std::uint32_t, 256>, wordSize> makeTables()
{
    std::array<std::array<std::uint32_t, 256>, wordSize> tables{};
    for (std::uint32_t i = 0; i < 256; ++i) {
        std::uint32_t value = i;
        for (int bit = 0; bit < 8; ++bit)
            value = (value >> 1U) ^ ((value & 1U) != 0 ? reversedPolynomial : 0U);
        tables[0][i] = value;
    }
    for (std::size_t row = 1; row < wordSize; ++row)
        for (std::size_t i = 0; i < 256; ++i)
            tables[row][i] = (tables[row - 1][i] >> 8U) ^ tables[0][tables[row - 1][i] & 0xFFU];
    return tables;
}

constexpr auto tables = makeTables();

std::uint64_t wordAt(const std::byte* bytes)
{
    std::uint64_t word = 0;
    std::memcpy(&word, bytes, wordSize);
    return word;
}

#if defined(__x86_64__)
[[gnu::target("sse4.2")]] std::uint32_t byInstruction(std::span<const std::byte> bytes, std::uint32_t crc)
{
    const auto* at = bytes.data();
    auto remaining = bytes.size();
    std::uint64_t wide = crc;
    for (; remaining >= wordSize; at += wordSize, remaining -= wordSize)
        wide = _mm_crc32_u64(wide, wordAt(at));
    crc = static_cast<std::uint32_t>(wide);
    for (; remaining > 0; ++at, --remaining)
        crc = _mm_crc32_u8(crc, static_cast<std::uint8_t>(*at));
    return crc;
}

bool hasInstruction() { return __builtin_cpu_supports("sse4.2") != 0; }
#else
std::uint32_t byInstruction(std::span<const std::byte>, std::uint32_t crc) { return crc; }

bool hasInstruction() { return false; }
#endif

} // namespace

std::uint32_t crc32cByTables(std::span<const std::byte> bytes, std::uint32_t previous)
{
    std::uint32_t crc = ~previous;
    const auto* at = bytes.data();
    auto remaining = bytes.size();
    for (; remaining >= wordSize; at += wordSize, remaining -= wordSize) {
        const auto word = wordAt(at) ^ crc;
        crc = 0;
        for (std::size_t i = 0; i < wordSize; ++i)
            crc ^= tables[wordSize - 1 - i][word >> 8U * i & 0xFFU];
    }
    for (; remaining > 0; ++at, --remaining)
        crc = (crc >> 8U) ^ tables[0][(crc ^ static_cast<std::uint32_t>(*at)) & 0xFFU];
    return ~crc;
}

std::uint32_t crc32c(std::span<const std::byte> bytes, std::uint32_t previous)
{
    return hasInstruction() ? ~byInstruction(bytes, ~previous) : crc32cByTables(bytes, previous);
}

} // namespace liena::protocol
