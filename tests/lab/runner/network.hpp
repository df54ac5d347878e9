// Network namespaces without a name: they are gone with the last process that uses them, whatever happens to the runner.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace liena::lab {

/// Brings the calling thread into a network namespace, and home again with the object. Throws std::system_error.
class InNetwork {
public:
    explicit InNetwork(int namespaceDescriptor);
    ~InNetwork();
    InNetwork(const InNetwork&) = delete;
    InNetwork& operator=(const InNetwork&) = delete;

private:
    int m_home = -1;
};

/// One namespace per device, port i of the wire being eth0 of namespace i. No way leads out of them: they hold a loopback and that TAP.
class Networks {
public:
    explicit Networks(std::size_t count);
    ~Networks();
    Networks(const Networks&) = delete;
    Networks& operator=(const Networks&) = delete;

    const std::vector<int>& descriptors() const { return m_descriptors; }

    /// Addresses and routes, once the wire has made the TAP devices.
    void configure();

    /// Runs a program inside; throws std::runtime_error with what it said when it fails.
    void run(std::size_t port, const std::vector<std::string>& command) const;

    void writeSetting(std::size_t port, const std::string& file, const std::string& value) const;

    /// The route to the others; must be set again after the interface was down.
    void setRoute(std::size_t port) const;

    static std::string addressOf(std::size_t port);

private:
    std::vector<int> m_descriptors;
};

} // namespace liena::lab
