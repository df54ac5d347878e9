// What a device does besides its sessions: the robot moves, the cockpit commands, the X-ray system sends pictures.
#pragma once

#include "liena/distributed_system.hpp"

#include <sstream>
#include <string>

namespace liena::lab {

/// Everything runs on the network thread.
class DevicePart {
public:
    virtual ~DevicePart() = default;
    virtual void handle(const SessionEvent&) {}
    virtual void tick(std::chrono::steady_clock::time_point) {} ///< each 2 ms

    /// A person's command that is not about sessions; false when it is none of ours.
    virtual bool obey(const std::string&, std::istringstream&) { return false; }
};

} // namespace liena::lab
