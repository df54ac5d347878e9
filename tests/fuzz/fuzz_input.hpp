// An input of a fuzz target as choices: numbers, flags, bytes. Used up, it gives zeros, so that every input means something.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>

namespace liena::fuzz {

class FuzzInput {
public:
    FuzzInput(const std::uint8_t* data, std::size_t size) : m_bytes(std::as_bytes(std::span(data, size))) {}

    bool isUsedUp() const { return m_bytes.empty(); }

    template <typename T>
    requires std::is_arithmetic_v<T> T number()
    {
        T value{};
        const auto bytes = take(sizeof(T));
        if (!bytes.empty())
            std::memcpy(&value, bytes.data(), bytes.size());
        return value;
    }

    /// 0 to limit - 1, from one byte: `limit` is at most 256.
    std::size_t below(std::size_t limit) { return number<std::uint8_t>() % limit; }
    bool flag() { return (number<std::uint8_t>() & 1U) != 0; }

    /// At most `count` bytes.
    std::span<const std::byte> take(std::size_t count)
    {
        const auto taken = m_bytes.first(std::min(count, m_bytes.size()));
        m_bytes = m_bytes.subspan(taken.size());
        return taken;
    }
    std::span<const std::byte> rest() { return take(m_bytes.size()); }

private:
    std::span<const std::byte> m_bytes;
};

} // namespace liena::fuzz
