// A TAP device in a network namespace: one end of the wire.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace liena::lab {

using MacAddress = std::array<std::uint8_t, 6>;

/// What stands on the cable: every packet by itself, or up to 64 KiB of one TCP stream in one frame, as a program hands them to a network
/// card that cuts and joins them, with fewer calls.
enum class Frames : std::uint8_t { Single, Long };

/// The address of the device at a port, from 0.
MacAddress macOfPort(std::size_t port);

/// Goes with the object: the kernel removes the device when its descriptor is closed.
class Tap {
public:
    /// Makes `eth0` in the namespace that `namespaceDescriptor` refers to. Throws std::system_error.
    Tap(int namespaceDescriptor, std::size_t port, Frames frames);
    ~Tap();
    Tap(Tap&& other) noexcept;
    Tap(const Tap&) = delete;
    Tap& operator=(const Tap&) = delete;
    Tap& operator=(Tap&&) = delete;

    int descriptor() const { return m_descriptor; }

    /// Bytes in front of each frame's Ethernet header, which belong to it when it is read and written (virtio_net.h); 0 for single packets.
    std::size_t prefix() const;

    /// One frame with its prefix; 0 when none waits.
    std::size_t read(std::span<std::byte> buffer);

    /// A frame that the device does not take (it is down) is gone, as on a real wire.
    void write(std::span<const std::byte> frame);

    void setCarrier(bool on);

private:
    int m_descriptor = -1;
    Frames m_frames;
};

/// What a frame, prefix and all, takes of a cable when it is cut into packets, each with headers of its own.
std::size_t lengthOnTheCable(std::span<const std::byte> frame, std::size_t prefix);

} // namespace liena::lab
