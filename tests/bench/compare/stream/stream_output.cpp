// Framing on the way out.
#include "stream/stream_output.hpp"

#include <span>

namespace liena::compare {

namespace {

template <typename T>
void appendBytes(std::vector<std::byte>& out, const T& value)
{
    const auto bytes = std::as_bytes(std::span(&value, 1));
    out.insert(out.end(), bytes.begin(), bytes.end());
}

} // namespace

std::vector<std::byte>& StreamOutput::openChunk()
{
    if (m_waiting.empty() || m_waiting.back().pixels)
        m_waiting.emplace_back();
    return m_waiting.back().bytes;
}

void StreamOutput::append(const Command& command)
{
    auto& out = openChunk();
    appendBytes(out, StreamHeader{StreamHeader::Kind::Command, sizeof command});
    appendBytes(out, command);
}

void StreamOutput::append(const Stamp& stamp, Pixels pixels)
{
    auto& out = openChunk();
    appendBytes(out, StreamHeader{StreamHeader::Kind::Frame, static_cast<std::uint32_t>(sizeof stamp + pixels->size())});
    appendBytes(out, stamp);
    m_waiting.back().pixels = std::move(pixels);
}

} // namespace liena::compare
