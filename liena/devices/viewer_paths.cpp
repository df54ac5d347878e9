// What the library says of the ways to the viewers: implementation.
#include "viewer_paths.hpp"

#include <utility>

namespace liena::devices {

ViewerPaths::ViewerPaths(const std::vector<DeviceId>& viewers, std::uint16_t pictures) : m_pictures(pictures)
{
    for (const DeviceId viewer : viewers)
        m_superseded[viewer] = 0;
}

std::vector<PathReading> ViewerPaths::read(const std::vector<LinkStatus>& links, const std::map<DeviceId, std::uint64_t>& lost)
{
    std::vector<PathReading> readings;
    for (const LinkStatus& link : links) {
        const auto last = m_superseded.find(link.peer);
        if (last == m_superseded.end())
            continue;
        const std::uint64_t before = std::exchange(last->second, link.bulkSuperseded);
        if (!carriesMessages(link.state))
            continue;
        const auto gone = lost.find(link.peer);
        const std::uint64_t replaced = link.bulkSuperseded > before ? link.bulkSuperseded - before : 0;
        readings.push_back({link.bulkRateOf(m_pictures), replaced + (gone != lost.end() ? gone->second : 0)});
    }
    return readings;
}

} // namespace liena::devices
