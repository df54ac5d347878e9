// The lines by which the runner tells the wire what to do.
#pragma once

#include "wire/impairment.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace liena::lab {

/// `link 1>2 drop=0.05 delay=1ms only=udp`: sets everything anew for that direction; `*` stands for every port.
struct LinkOrder {
    std::vector<std::size_t> from; ///< from 0; empty: every port
    std::vector<std::size_t> to;
    Impairment impairment;
};

/// `port 2 rate=1000000 queue=65536`: bits per second towards that port (0: no limit) and the bytes that may wait before it.
struct PortOrder {
    std::size_t port = 0;
    std::uint64_t rate = 0;
    std::size_t queue = 256 * 1024;
};

/// `carrier 2 off`: the cable is out of that port.
struct CarrierOrder {
    std::size_t port = 0;
    bool on = true;
};

/// `counts`: answers with the frames that passed and that were lost since the last asking.
struct CountsOrder {};

/// `late`: answers with the spans, in ms of the monotonic clock, in which frames to ports with a rate waited for this program and not for
/// the line, since the last asking: `ok 1200.25-1200.75 1310.0-1311.5`.
struct LateOrder {};

struct BadOrder {
    std::string why;
};

using WireOrder = std::variant<LinkOrder, PortOrder, CarrierOrder, CountsOrder, LateOrder, BadOrder>;

/// Ports are written from 1.
WireOrder parseWireOrder(std::string_view line, std::size_t ports);

} // namespace liena::lab
