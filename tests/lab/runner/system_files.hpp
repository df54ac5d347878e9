// The files of a lab's robotic system in a temporary folder: topology, certificates, a store per device.
#pragma once

#include "liena/certificates.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace liena::lab {

struct DevicePlan {
    std::string name;
    std::string id;
    std::string set;
    std::optional<std::size_t> beside; ///< a device on the same computer; nothing: on one of its own
};

struct SystemPlan {
    std::vector<DevicePlan> devices; ///< device i stands at port i of the wire, or beside another
    std::vector<std::string> links;  ///< "cockpit robot"
    std::vector<std::string> flags;  ///< of every lab_device

    std::size_t portOf(std::size_t device) const { return devices[device].beside.value_or(device); }
};

namespace plans {
SystemPlan pair();                    ///< cockpit and robot
SystemPlan withPictures();            ///< … and an X-ray system, linked to the cockpit
SystemPlan twoViewers();              ///< … and a second cockpit on the first one's computer, linked to both
SystemPlan mesh(std::size_t devices); ///< a cockpit and robots, every pair linked
SystemPlan star(std::size_t devices); ///< a cockpit with a link to each robot, no others
} // namespace plans

/// Goes with the object unless it is kept.
class SystemFiles {
public:
    explicit SystemFiles(const SystemPlan& plan);
    ~SystemFiles();
    SystemFiles(const SystemFiles&) = delete;
    SystemFiles& operator=(const SystemFiles&) = delete;

    void keep() { m_kept = true; }
    const std::filesystem::path& folder() const { return m_folder; }
    std::filesystem::path storeOf(const std::string& device) const { return m_folder / ("store-" + device); }

    /// A folder like the project's register, without the sets of these names.
    std::filesystem::path registryWithout(const std::vector<std::string>& sets) const;

    /// Arguments of lab_device.
    std::vector<std::string> argumentsOf(const std::string& device, const std::optional<std::filesystem::path>& registry = {}) const;

private:
    void writeTopology(const SystemPlan& plan) const;
    void issueCertificates(const SystemPlan& plan) const;

    std::filesystem::path m_folder;
    std::vector<std::string> m_flags;
    bool m_kept = false;
};

} // namespace liena::lab
