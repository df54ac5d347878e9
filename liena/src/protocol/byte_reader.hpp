// The one bounded reader of foreign bytes.
#pragma once

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>

namespace liena::protocol {

static_assert(std::endian::native == std::endian::little,
              "the wire is little-endian; a big-endian host needs swaps here and in ByteWriter");

/// Reads little-endian values from the front of a span. A read past the end yields zero and makes the reader bad for good, so that a
/// whole structure can be read before ok() is asked once.
class ByteReader {
public:
    explicit ByteReader(std::span<const std::byte> bytes) : m_bytes(bytes) {}

    template <typename T>
    requires std::is_arithmetic_v<T> T read()
    {
        T value{};
        if (const auto bytes = take(sizeof(T)); bytes.size() == sizeof(T))
            std::memcpy(&value, bytes.data(), sizeof(T));
        return value;
    }

    /// The next `count` bytes; empty and bad when there are fewer.
    std::span<const std::byte> take(std::size_t count)
    {
        if (count > m_bytes.size()) {
            m_ok = false;
            m_bytes = {};
            return {};
        }
        const auto taken = m_bytes.first(count);
        m_bytes = m_bytes.subspan(count);
        return taken;
    }

    std::string_view takeText(std::size_t count)
    {
        const auto bytes = take(count);
        return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
    }

    bool ok() const { return m_ok; }
    bool atEnd() const { return m_ok && m_bytes.empty(); }
    std::size_t remaining() const { return m_bytes.size(); }

private:
    std::span<const std::byte> m_bytes;
    bool m_ok = true;
};

} // namespace liena::protocol
