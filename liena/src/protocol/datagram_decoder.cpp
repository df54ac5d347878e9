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

DatagramDecoder::Room DatagramDecoder::room(ReadAhead ahead)
{
    const auto buffer = writable();
    return {m_landing, m_landing.empty() || ahead == ReadAhead::All ? buffer : buffer.first(headerSize)};
}

void DatagramDecoder::commit(std::size_t bytes)
{
    const auto landed = std::min(bytes, m_landing.size());
    m_landed = m_landing.first(landed);
    m_landing = {};
    m_end += bytes - landed;
}

} // namespace liena::protocol
