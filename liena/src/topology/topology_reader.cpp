// Reads topologies: the root, timing and security, then the devices, then the links between them (protocol section 5).
#include "topology/topology_reader.hpp"

#include "topology/host_name.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace liena {

std::optional<SystemTopology> TopologyReader::read(const XmlDocument& document, std::string_view xml, TopologyPlaces* places)
{
    const auto root = document.root(topologyElement, topologyNamespace);
    if (!root)
        return std::nullopt;
    TopologyReader reader(*root);
    reader.readRoot();
    reader.readSecurity();
    reader.readDevices();
    reader.readLinks();
    if (root->findings().hasErrors())
        return std::nullopt;
    reader.warnOfLoneDevices();
    reader.m_topology.m_hash = Sha256::of(xml);
    if (places)
        *places = std::move(reader.m_places);
    return std::move(reader.m_topology);
}

void TopologyReader::readRoot()
{
    m_root.expectAttributes({"xmlns", "name", "version", "title"});
    m_children = m_root.children({"description", "timing", "security", "device", "link"});
    m_topology.m_name = nameFrom(m_root.require("name")).value_or("");
    m_topology.m_version = filledTextFrom(m_root.require("version"));
    m_topology.m_title = textFrom(m_root.find("title"));
    descriptionAmong(m_children);
    allowOnce(m_children, "timing");
    for (const auto& child : m_children)
        if (child.name() == "timing")
            m_timing = readTiming(child, LinkTiming{});
}

void TopologyReader::readSecurity()
{
    allowOnce(m_children, "security");
    for (const auto& child : m_children) {
        if (child.name() != "security")
            continue;
        child.expectAttributes({"mode"});
        child.children({});
        m_topology.m_security = choiceFrom<SecurityMode>(child.require("mode"), {{"tls", SecurityMode::Tls}, {"none", SecurityMode::None}})
                                    .value_or(SecurityMode::Tls);
    }
}

void TopologyReader::readDevices()
{
    std::size_t count = 0;
    for (const auto& child : m_children) {
        if (child.name() != "device")
            continue;
        ++count;
        if (auto device = readDevice(child))
            m_topology.m_devices.push_back(std::move(*device));
    }
    if (count == 0)
        m_root.error("the topology has no device", "add <device name=\"…\" id=\"0x…\" message-set=\"…\" host=\"…\" port=\"…\"/>");
}

std::optional<TopologyDevice> TopologyReader::readDevice(const Element& element)
{
    element.expectAttributes({"name", "id", "message-set", "host", "port", "title", "site"});
    descriptionAmong(element.children({"description"}));
    TopologyDevice device;
    const auto nameAttribute = element.require("name");
    const auto idAttribute = element.require("id");
    const auto name = nameFrom(nameAttribute);
    const auto id = idAttribute ? DeviceId::fromString(idAttribute->value()) : std::nullopt;
    const auto set = element.require("message-set");
    device.messageSet = nameFrom(set).value_or("");
    device.title = textFrom(element.find("title"));
    device.site = textFrom(element.find("site"));
    readHost(element, device);
    if (idAttribute && !id)
        idAttribute->reject(inQuotes(idAttribute->value()) + " is no device id", "write 0x and eight hex digits, as 0x40018208");
    else if (id && !id->isValidDevice())
        idAttribute->reject(fmt::format("no device can have the id {}", id->toString()),
                            "its class is hand, eye, brain, arm or special, and its index 0 to 6");
    const bool newName = name && m_names.take(*name, *nameAttribute, "the device name '" + *name + "'");
    const bool newId = id && m_ids.take(*id, *idAttribute, "the device id " + id->toString());
    if (!newName || !newId)
        return std::nullopt;
    device.name = *name;
    device.id = *id;
    m_places.devices.push_back({idAttribute->valueAt(), set ? set->valueAt() : element.at()});
    return device;
}

void TopologyReader::readHost(const Element& element, TopologyDevice& device)
{
    constexpr std::int64_t lastPort = 65'535;
    const auto host = element.require("host");
    const auto port = integerFrom(element.require("port"), 1, lastPort);
    device.host = textFrom(host);
    device.port = static_cast<std::uint16_t>(port.value_or(0));
    if (!host)
        return;
    std::string why;
    const auto name = hostNameFrom(device.host, why);
    if (!name)
        return host->reject(fmt::format("{} {}", inQuotes(device.host), why),
                            "give the address or the name at which the device is reached");
    device.onLoopback = name->isLoopback;
    if (port)
        m_endpoints.take({name->canonical, device.port}, *host, fmt::format("the endpoint {} port {}", device.host, device.port));
    if (m_topology.m_security == SecurityMode::None && !name->isLoopback)
        element.findings().warning(host->valueAt(), fmt::format("mode none, and {} is not a loopback address", inQuotes(device.host)),
                                   "write <security mode=\"tls\"/>: anybody on the way could read and command");
}

void TopologyReader::readLinks()
{
    for (const auto& child : m_children)
        if (child.name() == "link")
            readLink(child);
}

void TopologyReader::readLink(const Element& element)
{
    element.expectAttributes({"between"});
    const auto children = element.children({"description", "timing", "flow"});
    descriptionAmong(children);
    allowOnce(children, "timing");
    TopologyLink link;
    link.timing = m_timing;
    for (const auto& child : children)
        if (child.name() == "timing")
            link.timing = readTiming(child, m_timing);
    const auto ends = readEnds(element);
    if (!ends)
        return;
    link.a = std::min(ends->first->id, ends->second->id);
    link.b = std::max(ends->first->id, ends->second->id);
    const auto what = fmt::format("the link between '{}' and '{}'", ends->first->name, ends->second->name);
    m_pairs.take({link.a, link.b}, *element.find("between"), what);
    readFlows(element, children, link);
    m_topology.m_links.push_back(std::move(link));
}

std::optional<std::pair<const TopologyDevice*, const TopologyDevice*>> TopologyReader::readEnds(const Element& element)
{
    const auto between = element.require("between");
    if (!between)
        return std::nullopt;
    const auto text = collapsed(between->value());
    const auto space = text.find(' ');
    const auto first = std::string_view(text).substr(0, space);
    const auto second = space == std::string::npos ? std::string_view() : std::string_view(text).substr(space + 1);
    if (!isName(first) || !isName(second)) {
        between->reject(inQuotes(between->value()) + " names no two devices", "write the names of both ends, as between=\"cockpit robot\"");
        return std::nullopt;
    }
    for (const auto name : {first, second})
        if (!deviceNamed(name)) {
            between->reject(inQuotes(name) + " is no device of this topology", suggestion(name, deviceNames()));
            return std::nullopt;
        }
    if (first == second) {
        between->reject(inQuotes(first) + " is linked to itself", "a link joins two devices");
        return std::nullopt;
    }
    return std::pair(deviceNamed(first), deviceNamed(second));
}

void TopologyReader::readFlows(const Element& element, const std::vector<Element>& children, TopologyLink& link)
{
    Once<std::pair<std::string, DeviceId>> flows;
    m_places.links.push_back(element.at());
    auto& places = m_places.flows.emplace_back();
    for (const auto& child : children) {
        if (child.name() != "flow")
            continue;
        child.expectAttributes({"message", "from"});
        child.children({});
        const auto attribute = child.require("message");
        const auto message = nameFrom(attribute);
        const auto from = child.require("from");
        const auto* device = from ? deviceNamed(from->value()) : nullptr;
        if (from && (!device || (device->id != link.a && device->id != link.b)))
            from->reject(inQuotes(from->value()) + " is no end of this link",
                         "write one of " + collapsed(element.find("between")->value()));
        else if (device && message &&
                 flows.take({*message, device->id}, *attribute, fmt::format("the flow of '{}' from '{}'", *message, device->name))) {
            link.flows.push_back({*message, device->id});
            places.push_back(attribute->valueAt());
        }
    }
}

const TopologyDevice* TopologyReader::deviceNamed(std::string_view name) const { return m_topology.find(name); }

std::vector<std::string_view> TopologyReader::deviceNames() const
{
    std::vector<std::string_view> names;
    for (const auto& device : m_topology.m_devices)
        names.push_back(device.name);
    return names;
}

void TopologyReader::warnOfLoneDevices() const
{
    for (std::size_t i = 0; i < m_topology.m_devices.size(); ++i) {
        const auto& device = m_topology.m_devices[i];
        if (m_topology.linksOf(device.id).empty())
            m_root.findings().warning(m_places.devices[i].idAt, fmt::format("no link joins '{}' to another device", device.name),
                                      fmt::format("add <link between=\"{} …\"/>, or remove the device", device.name));
    }
}

} // namespace liena
