// The product's X-ray system with pictures of the lab: its ladder steps down and up with the line.
#pragma once

#include "device/device_part.hpp"

#include "xray_device.hpp"

#include <memory>

namespace liena::lab {

/// Pictures of 512 x 512 pixels of 16 bits while a cockpit's pedal is down; what they show is grey with a little noise, so that each
/// encoding makes them smaller as it does with real ones.
class FluoroscopyPart : public DevicePart {
public:
    /// Throws when the device is no X-ray system.
    explicit FluoroscopyPart(DistributedSystem& system);

private:
    std::unique_ptr<devices::XrayDevice> m_device;
};

} // namespace liena::lab
