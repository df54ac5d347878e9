// Loading of the register, in the order of the files' names so that its findings are the same everywhere.
#include "topology/registry.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace liena {

namespace {

std::vector<std::filesystem::path> setFilesIn(const std::filesystem::path& folder, Findings& findings)
{
    std::vector<std::filesystem::path> files;
    std::error_code failure;
    for (auto entry = std::filesystem::directory_iterator(folder, failure); !failure && entry != std::filesystem::directory_iterator();
         entry.increment(failure))
        if (entry->path().extension() == ".xml")
            files.push_back(entry->path());
    if (failure)
        findings.push_back({Severity::Error, folder.string(), 0, 0, "the folder cannot be read: " + failure.message(),
                            "give the folder of the message sets, such as resources/devices"});
    std::sort(files.begin(), files.end());
    return files;
}

} // namespace

Result<Registry> Registry::load(const std::vector<std::filesystem::path>& folders, Findings* findings)
{
    Registry registry;
    Findings all;
    for (const auto& folder : folders)
        for (const auto& file : setFilesIn(folder, all)) {
            const auto set = MessageSet::load(file, &all);
            if (set)
                registry.add(set.value(), file, all);
        }
    if (findings)
        findings->insert(findings->end(), all.begin(), all.end());
    const auto first = std::find_if(all.begin(), all.end(), [](const Finding& f) { return f.severity == Severity::Error; });
    if (first != all.end())
        return fail(Errc::MessageSetInvalid, first->toString());
    return registry;
}

void Registry::add(std::shared_ptr<const MessageSet> set, const std::filesystem::path& file, Findings& findings)
{
    const auto type = set->deviceType();
    const auto hash = set->hash();
    const auto [held, isNew] = m_entries.try_emplace(type, Entry{std::move(set), file});
    if (isNew)
        return;
    const auto& other = held->second;
    if (other.set->hash() == hash && other.file.parent_path() != file.parent_path())
        return;
    findings.push_back({Severity::Error, file.string(), 0, 0,
                        fmt::format("it describes the device type {}, as {} does", type.toString(), other.file.string()),
                        "remove one, or give one another type or device-version"});
}

std::shared_ptr<const MessageSet> Registry::find(DeviceId device) const
{
    const auto found = m_entries.find(device.deviceType());
    return found == m_entries.end() ? nullptr : found->second.set;
}

std::shared_ptr<const MessageSet> Registry::find(const Sha256& hash) const
{
    const auto found =
        std::find_if(m_entries.begin(), m_entries.end(), [&hash](const auto& entry) { return entry.second.set->hash() == hash; });
    return found == m_entries.end() ? nullptr : found->second.set;
}

std::vector<std::shared_ptr<const MessageSet>> Registry::all() const
{
    std::vector<std::shared_ptr<const MessageSet>> sets;
    for (const auto& [type, entry] : m_entries)
        sets.push_back(entry.set);
    return sets;
}

} // namespace liena
