// The message sets that this computer knows, and the decision of a person to take another (protocol section 4).
#pragma once

#include "liena/error.hpp"
#include "liena/message_set.hpp"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace liena {

/// Where learnt sets and pins are kept unless Settings::store says otherwise: `liena/sets` in the user's folder for state. Empty when the
/// user has none.
std::filesystem::path defaultSetStore();

/// Why the set of a device type counts.
enum class SetSource : std::uint8_t {
    Register, ///< a file of the register's folders
    Met,      ///< shown by the first device of that type that was met
    Accepted, ///< by a person, who may so overrule both
};

struct KnownSet {
    DeviceId type;
    SetSource source = SetSource::Register;
    std::shared_ptr<const MessageSet> set; ///< null when it is pinned and its file is not here
    Sha256 hash;
};

/// For each device type the one set that its devices may show here. `store` need not exist. Blocks on files; any thread.
/// MessageSetInvalid or FileUnreadable when a file of either is not what it should be.
Result<std::vector<KnownSet>> knownSets(const std::vector<std::filesystem::path>& registry, const std::filesystem::path& store);

/// What differs, one line each in a person's words: messages that came, went or changed, with every attribute and field. Empty only for
/// sets that mean the same.
std::vector<std::string> describeChanges(const MessageSet& before, const MessageSet& now);

/// From now on the devices of this set's type may show this set and no other. For a person who has read the changes; running sessions go
/// on with the set they opened with. Makes the folder. Blocks on files; any thread. FileUnwritable when the store does not take it.
Result<void> acceptSet(const std::filesystem::path& store, const MessageSet& set);

} // namespace liena
