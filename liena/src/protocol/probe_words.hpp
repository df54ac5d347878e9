// Probes written and read without a copy of their padding: an image of a measurement has megabytes of it.
#pragma once

#include "liena/message.hpp"
#include "protocol/session_messages.hpp"

#include <cstddef>
#include <optional>
#include <span>

namespace liena::protocol {

/// Bytes of a Probe without its padding.
inline constexpr std::size_t probeHeadSize = 4 + 1 + 4 + 8 + 4;

struct ProbeHead {
    std::uint32_t run = 0;
    ProbeWay way = ProbeWay::Prompt;
    std::uint32_t sequence = 0;
    std::uint64_t sentNs = 0;

    friend bool operator==(const ProbeHead&, const ProbeHead&) = default;
};

/// The body of the Probe up to its padding, of so many bytes.
FieldBytes encodeProbeHead(const ProbeHead& head, std::size_t padding);

/// Nothing when the body is not exactly a Probe.
std::optional<ProbeHead> decodeProbe(std::span<const std::byte> body);

} // namespace liena::protocol
