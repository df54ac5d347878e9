// Register, store and pins seen together.
#include "liena/known_sets.hpp"

#include "topology/local_store.hpp"
#include "topology/registry.hpp"

#include <cstdlib>
#include <map>

namespace liena {

std::filesystem::path defaultSetStore()
{
    if (const char* state = std::getenv("XDG_STATE_HOME"); state != nullptr && *state != '\0')
        return std::filesystem::path(state) / "liena" / "sets";
    if (const char* home = std::getenv("HOME"); home != nullptr && *home != '\0')
        return std::filesystem::path(home) / ".local" / "state" / "liena" / "sets";
    return {};
}

namespace {

Result<LocalStore> openStore(const std::filesystem::path& folder)
{
    std::error_code ignored; // the store itself says what it cannot open
    std::filesystem::create_directories(folder.parent_path(), ignored);
    return LocalStore::open(folder);
}

} // namespace

Result<std::vector<KnownSet>> knownSets(const std::vector<std::filesystem::path>& registry, const std::filesystem::path& store)
{
    const auto sets = Registry::load(registry);
    if (!sets)
        return sets.as_failure();
    std::map<DeviceId, KnownSet> known;
    for (const auto& set : sets.value().all())
        known[set->deviceType()] = {set->deviceType(), SetSource::Register, set, set->hash()};
    if (!store.empty() && std::filesystem::exists(store)) {
        const auto opened = LocalStore::open(store);
        if (!opened)
            return opened.as_failure();
        const auto pins = opened.value().pins();
        if (!pins)
            return pins.as_failure();
        for (const auto& [type, pin] : pins.value()) {
            if (!pin.accepted && known.contains(type))
                continue;
            const auto set = opened.value().find(pin.hash);
            if (!set)
                return set.as_failure();
            known[type] = {type, pin.accepted ? SetSource::Accepted : SetSource::Met, set.value(), pin.hash};
        }
    }
    std::vector<KnownSet> all;
    for (auto& [type, one] : known)
        all.push_back(std::move(one));
    return all;
}

Result<void> acceptSet(const std::filesystem::path& store, const MessageSet& set)
{
    auto opened = openStore(store);
    if (!opened)
        return opened.as_failure();
    if (auto saved = opened.value().save(set); !saved)
        return saved;
    return opened.value().accept(set.deviceType(), set.hash());
}

} // namespace liena
