// One robotic system: its devices, the links they may open, and the timing of those links (protocol section 5).
#pragma once

#include "liena/device_id.hpp"
#include "liena/error.hpp"
#include "liena/finding.hpp"
#include "liena/hash.hpp"

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace liena {

/// Protocol section 8 says what each does.
struct LinkTiming {
    std::chrono::nanoseconds heartbeat = std::chrono::milliseconds(20);
    std::chrono::nanoseconds suspect = std::chrono::milliseconds(70);
    std::chrono::nanoseconds lost = std::chrono::milliseconds(110);
    std::chrono::nanoseconds reconnect = std::chrono::milliseconds(500);

    friend bool operator==(const LinkTiming&, const LinkTiming&) = default;
};

enum class SecurityMode : std::uint8_t { Tls, None };

struct TopologyDevice {
    std::string name;
    DeviceId id;
    std::string messageSet; ///< the set's name, for people; the id decides
    std::string host;
    std::uint16_t port = 0;
    std::string title;
    std::string site;        ///< free text, for people: where the device stands
    bool onLoopback = false; ///< its host is a loopback address or `localhost`: programs of one computer reach it, nobody else
};

/// Only these application messages flow on the link that carries a flow; `message` is a report of `from`'s set or a command of the other's.
struct TopologyFlow {
    std::string message;
    DeviceId from;
};

struct TopologyLink {
    DeviceId a; ///< the lower id
    DeviceId b;
    LinkTiming timing;
    std::vector<TopologyFlow> flows; ///< empty: everything that the sets allow

    bool joins(DeviceId x, DeviceId y) const { return (x == a && y == b) || (x == b && y == a); }
    DeviceId otherEnd(DeviceId end) const { return end == a ? b : a; }

    /// Whether the flows let that message of `from` through.
    bool carries(std::string_view message, DeviceId from) const;
};

class SystemTopology {
public:
    /// Reads and checks a whole file; every error and warning is added to `findings` with its place in `file`. TopologyInvalid or
    /// XmlInvalid when there is an error among them; FileUnreadable from load() when there is nothing to read.
    static Result<SystemTopology> parse(std::string_view xml, const std::string& file, Findings* findings = nullptr);
    static Result<SystemTopology> load(const std::filesystem::path& file, Findings* findings = nullptr);

    const std::string& name() const { return m_name; }
    const std::string& version() const { return m_version; }
    const std::string& title() const { return m_title; }
    SecurityMode security() const { return m_security; }
    const Sha256& hash() const { return m_hash; }
    const std::vector<TopologyDevice>& devices() const { return m_devices; }
    const std::vector<TopologyLink>& links() const { return m_links; }

    // Null when there is none. These pointers, and those of linksOf(), live as long as the topology.
    const TopologyDevice* find(DeviceId id) const;
    const TopologyDevice* find(std::string_view name) const;

    /// The device that a person named, by its name or by its id as `0x40018208`; else UnknownDevice.
    Result<TopologyDevice> device(std::string_view nameOrId) const;

    const TopologyLink* link(DeviceId x, DeviceId y) const; ///< null when there is none
    std::vector<const TopologyLink*> linksOf(DeviceId id) const;

private:
    friend class TopologyReader;

    std::string m_name;
    std::string m_version;
    std::string m_title;
    SecurityMode m_security = SecurityMode::Tls;
    Sha256 m_hash;
    std::vector<TopologyDevice> m_devices;
    std::vector<TopologyLink> m_links;
};

/// Checks files of either kind together, as `liena check` does: each by itself, then the topologies' devices and flows and the register's
/// uniqueness against the message sets among `files`. All findings of all files, in the order of the files.
Findings checkFiles(const std::vector<std::filesystem::path>& files);

} // namespace liena
