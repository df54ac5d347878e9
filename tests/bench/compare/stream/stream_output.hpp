// What waits to be written to a stream: commands side by side, frames without a copy. The framing of the baselines.
#pragma once

#include "measure/stamp.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace liena::compare {

struct StreamHeader {
    enum class Kind : std::uint32_t { Command = 1, Frame = 2 };
    Kind kind = Kind::Command;
    std::uint32_t size = 0; ///< of what follows
};

/// In host order: both ends are on one computer.
class StreamOutput {
public:
    using Pixels = std::shared_ptr<const std::vector<std::byte>>;

    /// Bytes, and the frame that follows them, if any.
    struct Chunk {
        std::vector<std::byte> bytes;
        Pixels pixels;
    };

    void append(const Command& command);
    void append(const Stamp& stamp, Pixels pixels);

    bool empty() const { return m_waiting.empty(); }

    /// All that waits, in its order.
    std::vector<Chunk> take() { return std::exchange(m_waiting, {}); }

private:
    std::vector<std::byte>& openChunk();

    std::vector<Chunk> m_waiting;
};

} // namespace liena::compare
