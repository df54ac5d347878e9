// A TAP device in a network namespace: one end of the wire.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace liena::lab {

using MacAddress = std::array<std::uint8_t, 6>;

/// The address of the device at a port, from 0.
MacAddress macOfPort(std::size_t port);

/// Goes with the object: the kernel removes the device when its descriptor is closed.
class Tap {
public:
    /// Makes `eth0` in the namespace that `namespaceDescriptor` refers to. Throws std::system_error.
    Tap(int namespaceDescriptor, std::size_t port);
    ~Tap();
    Tap(Tap&& other) noexcept;
    Tap(const Tap&) = delete;
    Tap& operator=(const Tap&) = delete;
    Tap& operator=(Tap&&) = delete;

    int descriptor() const { return m_descriptor; }

    /// One frame; 0 when none waits.
    std::size_t read(std::span<std::byte> buffer);

    /// A frame that the device does not take (it is down) is gone, as on a real wire.
    void write(std::span<const std::byte> frame);

    void setCarrier(bool on);

private:
    int m_descriptor = -1;
};

} // namespace liena::lab
