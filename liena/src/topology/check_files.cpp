// All checks over several files at once: device types that exist, flows that fit their direction, one set per device type.
#include "liena/message_set.hpp"
#include "liena/system_topology.hpp"
#include "topology/file_bytes.hpp"
#include "topology/message_set_reader.hpp"
#include "topology/topology_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <map>

namespace liena {

namespace {

double milliseconds(std::chrono::nanoseconds time) { return std::chrono::duration<double, std::milli>(time).count(); }

struct CheckedFile {
    explicit CheckedFile(const std::string& file, std::string_view bytes) : findings(file, bytes) {}

    FindingList findings;
    std::shared_ptr<const MessageSet> set;
    std::optional<SystemTopology> topology;
    TopologyPlaces places;
    std::size_t classAt = 0;
};

class FileChecker {
public:
    explicit FileChecker(const std::vector<std::filesystem::path>& files);
    Findings run();

private:
    void read(CheckedFile& file, std::string_view bytes);
    void collectSet(CheckedFile& file);
    void checkDevices(CheckedFile& file) const;
    void checkFlows(CheckedFile& file) const;
    void checkAges(CheckedFile& file) const;
    void checkFlow(CheckedFile& file, std::size_t place, const TopologyLink& link, const TopologyFlow& flow) const;
    const CheckedFile* setOf(DeviceId device) const;

    std::vector<std::unique_ptr<CheckedFile>> m_files;
    std::map<DeviceId, const CheckedFile*> m_sets; ///< by device type
    bool m_hasSetFile = false;
};

FileChecker::FileChecker(const std::vector<std::filesystem::path>& files)
{
    std::vector<std::filesystem::path> seen;
    for (const auto& path : files) {
        std::error_code failure;
        const auto canonical = std::filesystem::weakly_canonical(path, failure);
        if (!failure && std::find(seen.begin(), seen.end(), canonical) != seen.end())
            continue;
        seen.push_back(canonical);
        const auto bytes = readFile(path, XmlLimits::bytes);
        auto& file = *m_files.emplace_back(
            std::make_unique<CheckedFile>(path.string(), bytes ? std::string_view(bytes.value()) : std::string_view()));
        if (bytes)
            read(file, bytes.value());
        else
            file.findings.error(FindingList::wholeFile, bytes.error().what);
    }
}

void FileChecker::read(CheckedFile& file, std::string_view bytes)
{
    const auto document = XmlDocument::read(bytes, file.findings);
    if (!document)
        return;
    const auto root = document->root();
    if (root.name() == topologyElement) {
        file.topology = TopologyReader::read(*document, bytes, &file.places);
    } else if (root.name() == messageSetElement) {
        m_hasSetFile = true;
        file.set = MessageSetReader::read(*document, bytes);
        if (const auto deviceClass = root.find("class"))
            file.classAt = deviceClass->nameAt();
    } else {
        root.error("the root element is " + inQuotes(root.name()), "it must be <message-set> or <topology>");
    }
}

Findings FileChecker::run()
{
    for (const auto& file : m_files)
        if (file->set)
            collectSet(*file);
    for (const auto& file : m_files)
        if (file->topology) {
            checkDevices(*file);
            checkFlows(*file);
            checkAges(*file);
        }
    Findings all;
    for (const auto& file : m_files) {
        const auto own = file->findings.sorted();
        all.insert(all.end(), own.begin(), own.end());
    }
    return all;
}

void FileChecker::collectSet(CheckedFile& file)
{
    const auto type = file.set->deviceType();
    const auto [held, isNew] = m_sets.try_emplace(type, &file);
    if (!isNew)
        file.findings.error(file.classAt,
                            fmt::format("it describes the device type {}, as {} does", type.toString(), held->second->findings.file()),
                            "remove one, or give one another type or device-version");
}

const CheckedFile* FileChecker::setOf(DeviceId device) const
{
    const auto found = m_sets.find(device.deviceType());
    return found == m_sets.end() ? nullptr : found->second;
}

void FileChecker::checkDevices(CheckedFile& file) const
{
    if (!m_hasSetFile)
        return;
    const auto& devices = file.topology->devices();
    for (std::size_t i = 0; i < devices.size(); ++i) {
        const auto& device = devices[i];
        const auto& places = file.places.devices[i];
        const auto* owner = setOf(device.id);
        if (!owner)
            file.findings.warning(places.idAt,
                                  fmt::format("no message set among the files describes {}, the type of '{}'",
                                              device.id.deviceType().toString(), device.name),
                                  "correct the id, or name the file of its set too");
        else if (owner->set->name() != device.messageSet)
            file.findings.warning(places.messageSetAt,
                                  fmt::format("'{}' is named, but the id is of the type of '{}'", device.messageSet, owner->set->name()),
                                  "the id decides; correct whichever is wrong");
    }
}

void FileChecker::checkFlows(CheckedFile& file) const
{
    const auto& links = file.topology->links();
    for (std::size_t i = 0; i < links.size(); ++i)
        for (std::size_t j = 0; j < links[i].flows.size(); ++j)
            checkFlow(file, file.places.flows[i][j], links[i], links[i].flows[j]);
}

/// A command is as old as the heartbeat that it echoes, up to a heartbeat's period and both ways of the line: what may be no older than
/// that is refused as stale again and again, and more than ten such in a second end the session.
void FileChecker::checkAges(CheckedFile& file) const
{
    const auto& links = file.topology->links();
    for (std::size_t i = 0; i < links.size(); ++i)
        for (const auto end : {links[i].a, links[i].b}) {
            const auto* owner = setOf(end);
            if (!owner)
                continue;
            for (const auto& message : owner->set->messages()) {
                const auto flows = std::count_if(links[i].flows.begin(), links[i].flows.end(),
                                                 [&](const TopologyFlow& flow) { return flow.message == message.name; });
                const bool mayFlow = links[i].flows.empty() || flows > 0;
                const auto oldest = message.maxAge.value_or(links[i].timing.lost);
                if (message.role == Role::Command && message.priority == Priority::Control && mayFlow &&
                    oldest < 2 * links[i].timing.heartbeat)
                    file.findings.warning(file.places.links[i],
                                          fmt::format("'{}' to '{}' may be {} ms old, and the link's heartbeat comes every {} ms",
                                                      message.name, file.topology->find(end)->name, milliseconds(oldest),
                                                      milliseconds(links[i].timing.heartbeat)),
                                          "its age is that of the last heartbeat: make the heartbeat at least twice as fast");
            }
        }
}

void FileChecker::checkFlow(CheckedFile& file, std::size_t place, const TopologyLink& link, const TopologyFlow& flow) const
{
    const auto* from = setOf(flow.from);
    const auto* to = setOf(link.otherEnd(flow.from));
    if (!from || !to)
        return; // the missing set was reported with its device
    const auto hasRole = [&flow](const CheckedFile& owner, Role role) {
        const auto* message = owner.set->find(flow.message);
        return message && message->role == role;
    };
    const auto fromName = file.topology->find(flow.from)->name;
    const auto toName = file.topology->find(link.otherEnd(flow.from))->name;
    const bool report = hasRole(*from, Role::Report);
    const bool command = hasRole(*to, Role::Command);
    if (report && command)
        file.findings.error(place, fmt::format("'{}' is both a report of '{}' and a command of '{}'", flow.message, fromName, toName),
                            "rename one of the two in its message set");
    else if (!report && !command && (hasRole(*from, Role::Command) || hasRole(*to, Role::Report)))
        file.findings.error(place, fmt::format("'{}' flows from '{}' to '{}', not from '{}'", flow.message, toName, fromName, fromName),
                            fmt::format("write from=\"{}\"", toName));
    else if (!report && !command) {
        std::vector<std::string_view> known;
        for (const auto& message : from->set->messages())
            if (message.role == Role::Report)
                known.push_back(message.name);
        for (const auto& message : to->set->messages())
            if (message.role == Role::Command)
                known.push_back(message.name);
        file.findings.error(place, fmt::format("'{}' is neither a report of '{}' nor a command of '{}'", flow.message, fromName, toName),
                            suggestion(flow.message, known));
    }
}

} // namespace

Findings checkFiles(const std::vector<std::filesystem::path>& files) { return FileChecker(files).run(); }

} // namespace liena
