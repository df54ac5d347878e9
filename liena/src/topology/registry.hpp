// The register of message sets: all that stand in given folders, by device type and by hash (protocol section 10).
#pragma once

#include "liena/device_id.hpp"
#include "liena/error.hpp"
#include "liena/finding.hpp"
#include "liena/hash.hpp"
#include "liena/message_set.hpp"

#include <filesystem>
#include <map>
#include <memory>
#include <vector>

namespace liena {

/// Immutable once loaded. Only devices' own folders are given here, never the local store.
class Registry {
public:
    /// Reads every `*.xml` of the folders. An unreadable folder, an invalid set and a second set of one device type are errors; the same
    /// bytes in two folders are one set.
    static Result<Registry> load(const std::vector<std::filesystem::path>& folders, Findings* findings = nullptr);

    /// The set of a device's type, whatever its index; null when the register has none.
    std::shared_ptr<const MessageSet> find(DeviceId device) const;
    std::shared_ptr<const MessageSet> find(const Sha256& hash) const;

    std::vector<std::shared_ptr<const MessageSet>> all() const;

    std::size_t size() const { return m_entries.size(); }

private:
    struct Entry {
        std::shared_ptr<const MessageSet> set;
        std::filesystem::path file;
    };

    void add(std::shared_ptr<const MessageSet> set, const std::filesystem::path& file, Findings& findings);

    std::map<DeviceId, Entry> m_entries;
};

} // namespace liena
