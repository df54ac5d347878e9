// The one writer of bytes that leave.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

namespace liena::protocol {

/// Appends little-endian values to any container of std::byte that inserts ranges.
template <typename Container>
class ByteWriter {
public:
    explicit ByteWriter(Container& bytes) : m_bytes(bytes) {}

    template <typename T>
    requires std::is_arithmetic_v<T> ByteWriter& write(T value) { return append(std::as_bytes(std::span(&value, 1))); }

    ByteWriter& append(std::span<const std::byte> bytes)
    {
        m_bytes.insert(m_bytes.end(), bytes.data(), bytes.data() + bytes.size()); // pointers: one copy, not byte by byte
        return *this;
    }

    ByteWriter& append(std::string_view text) { return append(std::as_bytes(std::span(text.data(), text.size()))); }

private:
    Container& m_bytes;
};

} // namespace liena::protocol
