// Loading of topologies, and look-ups in them.
#include "liena/system_topology.hpp"

#include "topology/file_bytes.hpp"
#include "topology/nearest_name.hpp"
#include "topology/topology_reader.hpp"
#include "topology/xml_text.hpp"

#include <algorithm>

namespace liena {

bool TopologyLink::carries(std::string_view message, DeviceId from) const
{
    return flows.empty() ||
           std::any_of(flows.begin(), flows.end(), [&](const TopologyFlow& flow) { return flow.from == from && flow.message == message; });
}

Result<SystemTopology> SystemTopology::parse(std::string_view xml, const std::string& file, Findings* findings)
{
    FindingList list(file, xml);
    const auto document = XmlDocument::read(xml, list);
    auto topology = document ? TopologyReader::read(*document, xml) : std::nullopt;
    if (findings) {
        const auto sorted = list.sorted();
        findings->insert(findings->end(), sorted.begin(), sorted.end());
    }
    if (!topology)
        return list.summary(document ? Errc::TopologyInvalid : Errc::XmlInvalid);
    return std::move(*topology);
}

Result<SystemTopology> SystemTopology::load(const std::filesystem::path& file, Findings* findings)
{
    const auto bytes = readFile(file, XmlLimits::bytes);
    if (bytes)
        return parse(bytes.value(), file.string(), findings);
    if (findings)
        findings->push_back({Severity::Error, file.string(), 0, 0, bytes.error().what, {}});
    return bytes.as_failure();
}

const TopologyDevice* SystemTopology::find(DeviceId id) const
{
    const auto found = std::find_if(m_devices.begin(), m_devices.end(), [id](const TopologyDevice& device) { return device.id == id; });
    return found == m_devices.end() ? nullptr : &*found;
}

const TopologyDevice* SystemTopology::find(std::string_view name) const
{
    const auto found =
        std::find_if(m_devices.begin(), m_devices.end(), [name](const TopologyDevice& device) { return device.name == name; });
    return found == m_devices.end() ? nullptr : &*found;
}

Result<TopologyDevice> SystemTopology::device(std::string_view nameOrId) const
{
    if (const auto* named = find(nameOrId))
        return *named;
    if (const auto id = DeviceId::fromString(nameOrId))
        if (const auto* numbered = find(*id))
            return *numbered;
    std::vector<std::string_view> known;
    for (const auto& device : m_devices)
        known.push_back(device.name);
    const auto hint = suggestion(nameOrId, known);
    return fail(Errc::UnknownDevice,
                inQuotes(nameOrId) + " is no device of the topology '" + m_name + "'" + (hint.empty() ? "" : "; " + hint));
}

const TopologyLink* SystemTopology::link(DeviceId x, DeviceId y) const
{
    const auto found = std::find_if(m_links.begin(), m_links.end(), [x, y](const TopologyLink& link) { return link.joins(x, y); });
    return found == m_links.end() ? nullptr : &*found;
}

std::vector<const TopologyLink*> SystemTopology::linksOf(DeviceId id) const
{
    std::vector<const TopologyLink*> result;
    for (const auto& link : m_links)
        if (link.a == id || link.b == id)
            result.push_back(&link);
    return result;
}

} // namespace liena
