// A TAP device in a network namespace: implementation.
#include "wire/tap.hpp"

#include <fcntl.h>
#include <linux/if_tun.h>
#include <net/if.h>
#include <net/if_arp.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

namespace liena::lab {

namespace {

/// As in linux/virtio_net.h (VIRTIO 1.1, section 5.1.6), which is no C++.
struct PacketForm {
    std::uint8_t flags = 0;
    std::uint8_t segmentation = 0; ///< 0: a single packet
    std::uint16_t headerLength = 0;
    std::uint16_t segmentSize = 0;
    std::uint16_t checksumStart = 0;
    std::uint16_t checksumOffset = 0;
};
static_assert(sizeof(PacketForm) == 10);

void check(int result, const char* what)
{
    if (result < 0)
        throw std::system_error(errno, std::generic_category(), what);
}

int openTun()
{
    const int descriptor = ::open("/dev/net/tun", O_RDWR | O_NONBLOCK | O_CLOEXEC);
    check(descriptor, "cannot open /dev/net/tun; load the module 'tun' and be root");
    return descriptor;
}

} // namespace

MacAddress macOfPort(std::size_t port) { return {0x02, 0x4C, 0x41, 0x42, 0x00, static_cast<std::uint8_t>(port + 1)}; }

Tap::Tap(int namespaceDescriptor, std::size_t port, Frames frames) : m_frames(frames)
{
    const int home = ::open("/proc/self/ns/net", O_RDONLY | O_CLOEXEC);
    check(home, "cannot open /proc/self/ns/net");
    check(::setns(namespaceDescriptor, CLONE_NEWNET), "cannot enter the network namespace");
    m_descriptor = openTun();
    ifreq request{};
    std::strncpy(request.ifr_name, "eth0", sizeof request.ifr_name - 1);
    request.ifr_flags = static_cast<short>(IFF_TAP | IFF_NO_PI | (frames == Frames::Long ? IFF_VNET_HDR : 0));
    check(::ioctl(m_descriptor, TUNSETIFF, &request), "cannot make the TAP device eth0");
    // Single: no segments larger than the MTU, checksums filled in.
    check(::ioctl(m_descriptor, TUNSETOFFLOAD, frames == Frames::Long ? TUN_F_CSUM | TUN_F_TSO4 : 0),
          "cannot set the TAP device's offloads");
    const auto mac = macOfPort(port);
    request.ifr_hwaddr.sa_family = ARPHRD_ETHER;
    std::copy(mac.begin(), mac.end(), request.ifr_hwaddr.sa_data);
    check(::ioctl(m_descriptor, SIOCSIFHWADDR, &request), "cannot set the TAP device's address");
    check(::setns(home, CLONE_NEWNET), "cannot return to the first network namespace");
    ::close(home);
}

Tap::~Tap()
{
    if (m_descriptor >= 0)
        ::close(m_descriptor);
}

Tap::Tap(Tap&& other) noexcept : m_descriptor(std::exchange(other.m_descriptor, -1)), m_frames(other.m_frames) {}

std::size_t Tap::prefix() const { return m_frames == Frames::Long ? sizeof(PacketForm) : 0; }

std::size_t Tap::read(std::span<std::byte> buffer)
{
    const auto count = ::read(m_descriptor, buffer.data(), buffer.size());
    return count > 0 ? static_cast<std::size_t>(count) : 0;
}

void Tap::write(std::span<const std::byte> frame)
{
    while (::write(m_descriptor, frame.data(), frame.size()) < 0 && errno == EINTR) {
    }
}

void Tap::setCarrier(bool on)
{
    int carrier = on ? 1 : 0;
    check(::ioctl(m_descriptor, TUNSETCARRIER, &carrier), "cannot set the TAP device's carrier");
}

std::size_t lengthOnTheCable(std::span<const std::byte> frame, std::size_t prefix)
{
    const std::size_t length = frame.size() - prefix;
    PacketForm form;
    if (prefix != sizeof form)
        return length;
    std::memcpy(&form, frame.data(), sizeof form);
    if (form.segmentation == 0 || form.segmentSize == 0 || length <= form.headerLength)
        return length;
    const std::size_t packets = (length - form.headerLength + form.segmentSize - 1) / form.segmentSize;
    return length + (packets - 1) * form.headerLength;
}

} // namespace liena::lab
