// Cuts the byte stream of one lane into datagrams, asking about each header before its body is awaited.
#pragma once

#include "protocol/datagram.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace liena::protocol {

enum class HeaderVerdict : std::uint8_t {
    Take,
    Skip,   ///< pass over the body
    Refuse, ///< the stream ends here
};

/// A fixed buffer that one datagram always fits. A datagram's body is valid until the next call of writable().
class DatagramDecoder {
public:
    DatagramDecoder() : m_buffer(bufferSize) {}

    /// Where the next bytes of the stream go.
    std::span<std::byte> writable();
    void commit(std::size_t bytes) { m_end += bytes; }

    /// Calls `judge(const DatagramHeader&) -> HeaderVerdict` once per header and `take(const DatagramHeader&, span body) -> bool` for each
    /// datagram that is whole. Ends when bytes are missing (true), or at once when either refuses (false).
    template <typename Judge, typename Take>
    bool process(Judge&& judge, Take&& take)
    {
        for (;;) {
            if (!m_judged) {
                if (buffered() < headerSize)
                    return true;
                m_header = decodeHeader(std::span<const std::byte, headerSize>(m_buffer.data() + m_begin, headerSize));
                m_verdict = judge(m_header);
                if (m_verdict == HeaderVerdict::Refuse)
                    return false;
                m_judged = true;
            }
            if (buffered() < headerSize + m_header.length)
                return true;
            const auto body = std::span<const std::byte>(m_buffer).subspan(m_begin + headerSize, m_header.length);
            m_begin += headerSize + m_header.length;
            m_judged = false;
            if (m_verdict == HeaderVerdict::Take && !take(m_header, body))
                return false;
        }
    }

    std::size_t buffered() const { return m_end - m_begin; }

private:
    static constexpr std::size_t bufferSize = 2 * (headerSize + maximumBody);

    std::vector<std::byte> m_buffer;
    std::size_t m_begin = 0;
    std::size_t m_end = 0;
    DatagramHeader m_header;
    HeaderVerdict m_verdict = HeaderVerdict::Take;
    bool m_judged = false;
};

} // namespace liena::protocol
