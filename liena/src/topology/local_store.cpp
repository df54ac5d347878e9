// Files of the local store: `<64 hex digits>.xml` per set, and `pins`: a line of device type and hash per pin, with ` accepted` behind it
// when a person has accepted that set.
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
constexpr std::string_view acceptedMark = " accepted";

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
        const auto held = sets();
        if (!held)
            return held.as_failure();
        if (held.value().size() >= mostSets)
            return fail(Errc::FileUnwritable, fmt::format("{} holds {} message sets, the most that are kept; delete those no longer used",
                                                          m_directory.path().string(), held.value().size()));
    }
    return m_directory.write(name, set.xml());
}

Result<std::vector<Sha256>> LocalStore::sets() const
{
    const auto names = m_directory.names();
    if (!names)
        return names.as_failure();
    std::vector<Sha256> hashes;
    for (const auto& name : names.value())
        if (isSetName(name))
            hashes.push_back(*Sha256::fromHex(std::string_view(name).substr(0, name.size() - suffix.size())));
    std::sort(hashes.begin(), hashes.end(), [](const Sha256& a, const Sha256& b) { return a.toHex() < b.toHex(); });
    return hashes;
}

Result<std::optional<LocalStore::Pin>> LocalStore::pinFor(DeviceId type) const
{
    const auto pins = readPins();
    if (!pins)
        return pins.as_failure();
    const auto found = pins.value().find(type.deviceType());
    return found == pins.value().end() ? std::optional<Pin>() : std::optional(found->second);
}

Result<void> LocalStore::accept(DeviceId type, const Sha256& hash)
{
    const auto lock = m_directory.lock();
    if (!lock)
        return lock.as_failure();
    auto pins = readPins();
    if (!pins)
        return pins.as_failure();
    pins.value()[type.deviceType()] = {hash, true};
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
    const auto [held, isNew] = pins.value().try_emplace(type.deviceType(), Pin{hash, false});
    if (isNew) {
        const auto written = writePins(pins.value());
        if (!written)
            return written.as_failure();
    }
    return held->second.hash;
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
        const bool accepted = text.ends_with(acceptedMark);
        const auto digits = text.substr(std::min<std::size_t>(text.size(), 11));
        const auto hash = text.size() > 11 && text[10] == ' '
                              ? Sha256::fromHex(digits.substr(0, digits.size() - (accepted ? acceptedMark.size() : 0)))
                              : std::nullopt;
        // A pin that cannot be read must not count as none: another set would then be taken for the first one met.
        if (end == std::string_view::npos || !type || *type != type->deviceType() || !hash ||
            !pins.emplace(*type, Pin{*hash, accepted}).second)
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
    for (const auto& [type, pin] : pins)
        text += fmt::format("{} {}{}\n", type.toString(), pin.hash.toHex(), pin.accepted ? acceptedMark : "");
    if (text.size() > mostPinBytes)
        return fail(Errc::FileUnwritable, fmt::format("{} holds as many pins as it can", (m_directory.path() / pinsName).string()));
    return m_directory.write(pinsName, text);
}

} // namespace liena
