// Buffer keeping of the datagram decoder.
#include "protocol/datagram_decoder.hpp"

#include <cstring>

namespace liena::protocol {

std::span<std::byte> DatagramDecoder::writable()
{
    if (m_begin > 0) {
        std::memmove(m_buffer.get(), m_buffer.get() + m_begin, buffered());
        m_end -= m_begin;
        m_begin = 0;
    }
    return {m_buffer.get() + m_end, bufferSize - m_end};
}

} // namespace liena::protocol
