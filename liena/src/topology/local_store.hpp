// The message sets learnt over the wire and the pins of device types, in one folder (protocol section 10, ruling B14).
#pragma once

#include "liena/device_id.hpp"
#include "liena/error.hpp"
#include "liena/hash.hpp"
#include "liena/message_set.hpp"
#include "topology/directory.hpp"

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace liena {

/// A file's name comes from a hash and from nothing that a peer chose. Several processes may share the folder. Not for two threads at once.
/// Every call reads or writes the disk before it returns; writing waits for the disk.
class LocalStore {
public:
    static constexpr std::size_t mostSets = 64;

    /// Makes the folder when it is not there.
    static Result<LocalStore> open(const std::filesystem::path& folder);

    /// A null pointer when the set is not here; an error when what is here is not the set of that hash.
    Result<std::shared_ptr<const MessageSet>> find(const Sha256& hash) const;

    /// Keeps the set's bytes as they are; a set that is here already is no error.
    Result<void> save(const MessageSet& set);

    struct Pin {
        Sha256 hash;
        bool accepted = false; ///< by a person: it stands above the register

        friend bool operator==(const Pin&, const Pin&) = default;
    };

    /// The only hash that is accepted for this device type (an id of any index), or nothing when none was met yet.
    Result<std::optional<Pin>> pinFor(DeviceId type) const;

    /// Replaces the pin by a hash that a person has accepted.
    Result<void> accept(DeviceId type, const Sha256& hash);

    /// Pins when there is no pin yet, for the first valid set met; returns the pin that holds now, which may be another.
    Result<Sha256> pinFirst(DeviceId type, const Sha256& hash);

    using Pins = std::map<DeviceId, Pin>; ///< by device type
    Result<Pins> pins() const { return readPins(); }

    /// Every set that is here, in the order of the hashes.
    Result<std::vector<Sha256>> sets() const;

private:
    explicit LocalStore(Directory directory) : m_directory(std::move(directory)) {}

    Result<Pins> readPins() const;
    Result<void> writePins(const Pins& pins) const;

    Directory m_directory;
};

} // namespace liena
