// The one writer of bytes that leave.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

namespace liena::protocol {

/// Appends little-endian values to any container of std::byte with size, resize and data.
template <typename Container>
class ByteWriter {
public:
    explicit ByteWriter(Container& bytes) : m_bytes(bytes) {}

    template <typename T>
    requires std::is_arithmetic_v<T> ByteWriter& write(T value) { return append(std::as_bytes(std::span(&value, 1))); }

    ByteWriter& append(std::span<const std::byte> bytes)
    {
        const auto at = m_bytes.size();
        m_bytes.resize(at + bytes.size());
        if (!bytes.empty())
            std::memcpy(m_bytes.data() + at, bytes.data(), bytes.size());
        return *this;
    }

    ByteWriter& append(std::string_view text) { return append(std::as_bytes(std::span(text.data(), text.size()))); }

private:
    Container& m_bytes;
};

} // namespace liena::protocol
