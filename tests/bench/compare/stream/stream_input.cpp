// Framing on the way in.
#include "stream/stream_input.hpp"

#include "stream/stream_output.hpp"

#include <algorithm>
#include <cstring>
#include <stdexcept>

namespace liena::compare {

std::span<std::byte> StreamInput::space()
{
    if (inFrame())
        return std::span(m_frame).subspan(m_filled);
    return std::span(m_buffer).subspan(m_end);
}

void StreamInput::read(std::size_t count, LinkEvents& events)
{
    if (inFrame())
        return fillFrame(count, events);
    m_end += count;
    while (takeNext(events)) {
    }
    std::copy(m_buffer.begin() + static_cast<std::ptrdiff_t>(m_begin), m_buffer.begin() + static_cast<std::ptrdiff_t>(m_end),
              m_buffer.begin());
    m_end -= m_begin;
    m_begin = 0;
}

void StreamInput::fillFrame(std::size_t count, LinkEvents& events)
{
    m_filled += count;
    if (!inFrame())
        events.frameReceived(m_stamp, m_frame.size());
}

/// False when what is there is no whole command, nor the whole beginning of a frame.
bool StreamInput::takeNext(LinkEvents& events)
{
    StreamHeader header;
    if (m_end - m_begin < sizeof header)
        return false;
    std::memcpy(&header, m_buffer.data() + m_begin, sizeof header);
    const auto* body = m_buffer.data() + m_begin + sizeof header;
    const auto there = m_end - m_begin - sizeof header;
    if (header.kind == StreamHeader::Kind::Command) {
        Command command;
        if (there < sizeof command)
            return false;
        std::memcpy(&command, body, sizeof command);
        m_begin += sizeof header + sizeof command;
        events.commandReceived(command);
        return true;
    }
    if (header.kind != StreamHeader::Kind::Frame || header.size <= sizeof m_stamp)
        throw std::runtime_error("what arrived is neither a command nor a frame");
    if (there < sizeof m_stamp)
        return false;
    std::memcpy(&m_stamp, body, sizeof m_stamp);
    m_frame.resize(header.size - sizeof m_stamp);
    m_filled = 0;
    const auto part = std::min(there - sizeof m_stamp, m_frame.size());
    std::memcpy(m_frame.data(), body + sizeof m_stamp, part);
    m_begin += sizeof header + sizeof m_stamp + part;
    fillFrame(part, events);
    return true;
}

} // namespace liena::compare
