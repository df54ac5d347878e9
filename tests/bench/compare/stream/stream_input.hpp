// Finds commands and frames in the bytes of a stream; a frame's bytes are read to where they stay.
#pragma once

#include "measure/transport.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace liena::compare {

class StreamInput {
public:
    /// Where the next bytes are to be read to; never empty.
    std::span<std::byte> space();

    /// `count` bytes were read there. Throws std::runtime_error when they are none of ours.
    void read(std::size_t count, LinkEvents& events);

private:
    bool takeNext(LinkEvents& events);
    void fillFrame(std::size_t count, LinkEvents& events);
    bool inFrame() const { return m_filled < m_frame.size(); }

    std::vector<std::byte> m_buffer = std::vector<std::byte>(65536);
    std::size_t m_begin = 0;
    std::size_t m_end = 0;
    std::vector<std::byte> m_frame;
    std::size_t m_filled = 0;
    Stamp m_stamp;
};

} // namespace liena::compare
