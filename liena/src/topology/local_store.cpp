// Files of the local store: `<64 hex digits>.xml` per set, and `pins`, one line of device type and hash per pin.
#include "topology/local_store.hpp"

#include "topology/xml_scan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace liena {

namespace {

constexpr const char* pinsName = "pins";
constexpr std::size_t mostPinBytes = 256UL * 1024;
constexpr std::string_view suffix = ".xml";

std::string nameOf(const Sha256& hash) { return hash.toHex() + std::string(suffix); }

bool isSetName(std::string_view name)
{
    return name.ends_with(suffix) && Sha256::fromHex(name.substr(0, name.size() - suffix.size())).has_value();
}

} // namespace

Result<LocalStore> LocalStore::open(const std::filesystem::path& folder)
{
    auto directory = Directory::open(folder);
    if (!directory)
        return directory.as_failure();
    return LocalStore(std::move(directory).value());
}

Result<std::shared_ptr<const MessageSet>> LocalStore::find(const Sha256& hash) const
{
    const auto name = nameOf(hash);
    if (!m_directory.exists(name))
        return std::shared_ptr<const MessageSet>();
    const auto bytes = m_directory.read(name, XmlLimits::bytes);
    if (!bytes)
        return bytes.as_failure();
    const auto file = (m_directory.path() / name).string();
    if (Sha256::of(bytes.value()) != hash)
        return fail(Errc::MessageSetInvalid, file + " does not hold what its name says; delete it, and it is learnt again");
    return MessageSet::parse(bytes.value(), file);
}

Result<void> LocalStore::save(const MessageSet& set)
{
    const auto lock = m_directory.lock();
    if (!lock)
        return lock.as_failure();
    const auto name = nameOf(set.hash());
    if (m_directory.exists(name)) {
        const auto bytes = m_directory.read(name, XmlLimits::bytes);
        if (bytes && bytes.value() == set.xml())
            return ok();
    } else {
        const auto count = countSets();
        if (!count)
            return count.as_failure();
        if (count.value() >= mostSets)
            return fail(Errc::FileUnwritable, fmt::format("{} holds {} message sets, the most that are kept; delete those no longer used",
                                                          m_directory.path().string(), count.value()));
    }
    return m_directory.write(name, set.xml());
}

Result<std::size_t> LocalStore::countSets() const
{
    const auto names = m_directory.names();
    if (!names)
        return names.as_failure();
    return static_cast<std::size_t>(std::count_if(names.value().begin(), names.value().end(), isSetName));
}

Result<std::optional<Sha256>> LocalStore::pinFor(DeviceId type) const
{
    const auto pins = readPins();
    if (!pins)
        return pins.as_failure();
    const auto found = pins.value().find(type.deviceType());
    return found == pins.value().end() ? std::optional<Sha256>() : std::optional(found->second);
}

Result<void> LocalStore::pin(DeviceId type, const Sha256& hash)
{
    const auto lock = m_directory.lock();
    if (!lock)
        return lock.as_failure();
    auto pins = readPins();
    if (!pins)
        return pins.as_failure();
    pins.value()[type.deviceType()] = hash;
    return writePins(pins.value());
}

Result<Sha256> LocalStore::pinFirst(DeviceId type, const Sha256& hash)
{
    const auto lock = m_directory.lock();
    if (!lock)
        return lock.as_failure();
    auto pins = readPins();
    if (!pins)
        return pins.as_failure();
    const auto [held, isNew] = pins.value().try_emplace(type.deviceType(), hash);
    if (isNew) {
        const auto written = writePins(pins.value());
        if (!written)
            return written.as_failure();
    }
    return held->second;
}

Result<LocalStore::Pins> LocalStore::readPins() const
{
    Pins pins;
    if (!m_directory.exists(pinsName))
        return pins;
    const auto bytes = m_directory.read(pinsName, mostPinBytes);
    if (!bytes)
        return bytes.as_failure();
    std::string_view rest = bytes.value();
    for (int line = 1; !rest.empty(); ++line) {
        const auto end = rest.find('\n');
        const auto text = rest.substr(0, end);
        const auto type = DeviceId::fromString(text.substr(0, 10));
        const auto hash = text.size() > 11 && text[10] == ' ' ? Sha256::fromHex(text.substr(11)) : std::nullopt;
        // A pin that cannot be read must not count as none: another set would then be taken for the first one met.
        if (end == std::string_view::npos || !type || *type != type->deviceType() || !hash || !pins.emplace(*type, *hash).second)
            return fail(Errc::FileUnreadable, fmt::format("{}:{}: this pin cannot be read; restore the file, or delete it to accept "
                                                          "the next set met of each device type",
                                                          (m_directory.path() / pinsName).string(), line));
        rest.remove_prefix(end + 1);
    }
    return pins;
}

Result<void> LocalStore::writePins(const Pins& pins) const
{
    std::string text;
    for (const auto& [type, hash] : pins)
        text += fmt::format("{} {}\n", type.toString(), hash.toHex());
    if (text.size() > mostPinBytes)
        return fail(Errc::FileUnwritable, fmt::format("{} holds as many pins as it can", (m_directory.path() / pinsName).string()));
    return m_directory.write(pinsName, text);
}

} // namespace liena
