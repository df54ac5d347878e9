// The X-ray system of the lab: pictures of a given size at a given rate, to fill a link with.
#pragma once

#include "device/device_part.hpp"

#include <chrono>
#include <cstdint>

namespace liena::lab {

class XrayPart : public DevicePart {
public:
    explicit XrayPart(DistributedSystem& system) : m_system(system) {}

    void tick(std::chrono::steady_clock::time_point now) override;

    /// `pictures BYTES PERIOD-MS`; 0 bytes: none
    bool obey(const std::string& verb, std::istringstream& rest) override;

private:
    DistributedSystem& m_system;
    std::size_t m_size = 0;
    std::chrono::milliseconds m_period{};
    std::chrono::steady_clock::time_point m_next;
    std::uint32_t m_frame = 0;
};

} // namespace liena::lab
