// What the library says of the ways to the viewers, as the picture ladder reads it.
#pragma once

#include "picture_ladder.hpp"

#include "liena/session_event.hpp"

#include <cstdint>
#include <map>
#include <vector>

namespace liena::devices {

/// Keeps the counters of the last look. Not for two threads at once.
class ViewerPaths {
public:
    /// `pictures`: the number of the message that brings them.
    ViewerPaths(const std::vector<DeviceId>& viewers, std::uint16_t pictures);

    /// One reading for each viewer whose session carries messages: pictures replaced by newer ones since the last call, and those that were
    /// accepted and lost (`lost`, by viewer).
    std::vector<PathReading> read(const std::vector<LinkStatus>& links, const std::map<DeviceId, std::uint64_t>& lost);

private:
    std::uint16_t m_pictures;
    std::map<DeviceId, std::uint64_t> m_superseded;
};

} // namespace liena::devices
