// Network namespaces without a name: implementation.
#include "runner/network.hpp"

#include "runner/process.hpp"

#include <fcntl.h>
#include <sched.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>
#include <system_error>

namespace liena::lab {

namespace {

int openOwnNetwork()
{
    // /proc/thread-self: setns and unshare concern the thread.
    const int descriptor = ::open("/proc/thread-self/ns/net", O_RDONLY | O_CLOEXEC);
    if (descriptor < 0)
        throw std::system_error(errno, std::generic_category(), "cannot open /proc/thread-self/ns/net");
    return descriptor;
}

} // namespace

InNetwork::InNetwork(int namespaceDescriptor) : m_home(openOwnNetwork())
{
    if (::setns(namespaceDescriptor, CLONE_NEWNET) != 0)
        throw std::system_error(errno, std::generic_category(), "cannot enter a network namespace; be root");
}

InNetwork::~InNetwork()
{
    if (::setns(m_home, CLONE_NEWNET) != 0)
        ::_exit(1); // nothing of ours may run on in the wrong network
    ::close(m_home);
}

Networks::Networks(std::size_t count)
{
    const int home = openOwnNetwork();
    for (std::size_t i = 0; i < count; ++i) {
        if (::unshare(CLONE_NEWNET) != 0)
            throw std::system_error(errno, std::generic_category(), "cannot make a network namespace; be root");
        m_descriptors.push_back(openOwnNetwork());
    }
    if (::setns(home, CLONE_NEWNET) != 0)
        throw std::system_error(errno, std::generic_category(), "cannot return to the first network namespace");
    ::close(home);
}

Networks::~Networks()
{
    for (const int descriptor : m_descriptors)
        ::close(descriptor);
}

std::string Networks::addressOf(std::size_t port) { return "10.77.0." + std::to_string(port + 1); }

void Networks::configure()
{
    for (std::size_t port = 0; port < m_descriptors.size(); ++port) {
        writeSetting(port, "ipv6/conf/all/disable_ipv6", "1");
        run(port, {"ip", "link", "set", "lo", "up"});
        run(port, {"ip", "link", "set", "eth0", "mtu", "1500", "up"});
        run(port, {"ip", "addr", "add", addressOf(port) + "/24", "dev", "eth0", "noprefixroute"});
        setRoute(port);
    }
}

void Networks::setRoute(std::size_t port) const
{
    // The congestion control is named, since its default differs between kernels; a namespace may not change the default itself.
    run(port, {"ip", "route", "replace", "10.77.0.0/24", "dev", "eth0", "src", addressOf(port), "congctl", "cubic"});
}

void Networks::run(std::size_t port, const std::vector<std::string>& command) const
{
    const auto [status, output] = runToEnd(command, m_descriptors[port]);
    if (status != 0)
        throw std::runtime_error("`" + command.front() + " " + command.at(1) + " …` failed in network " + std::to_string(port + 1) + ": " +
                                 output);
}

void Networks::writeSetting(std::size_t port, const std::string& file, const std::string& value) const
{
    const InNetwork inside(m_descriptors[port]);
    const std::string path = "/proc/sys/net/" + file;
    const int descriptor = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
    const bool written = descriptor >= 0 && ::write(descriptor, value.data(), value.size()) == static_cast<ssize_t>(value.size());
    const int error = errno;
    if (descriptor >= 0)
        ::close(descriptor);
    if (!written)
        throw std::system_error(error, std::generic_category(), "cannot write " + path);
}

} // namespace liena::lab
