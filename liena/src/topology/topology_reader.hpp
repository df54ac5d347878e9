// A <topology> as a SystemTopology, and where its devices and flows stand, for checks against message sets.
#pragma once

#include "liena/system_topology.hpp"
#include "topology/attribute_values.hpp"
#include "topology/xml_document.hpp"

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace liena {

inline constexpr std::string_view topologyElement = "topology";
inline constexpr std::string_view topologyNamespace = "urn:liena:topology:1";

/// Offsets in the file, in the order of SystemTopology::devices() and of the links' flows.
struct TopologyPlaces {
    struct Device {
        std::size_t idAt = 0;
        std::size_t messageSetAt = 0;
    };
    std::vector<Device> devices;
    std::vector<std::size_t> links;
    std::vector<std::vector<std::size_t>> flows; ///< of each link
};

class TopologyReader {
public:
    /// `document` of the bytes `xml`. Nothing when there was an error; the document's findings then say which.
    static std::optional<SystemTopology> read(const XmlDocument& document, std::string_view xml, TopologyPlaces* places = nullptr);

private:
    explicit TopologyReader(const Element& root) : m_root(root) {}

    void readRoot();
    void readSecurity();
    void readDevices();
    std::optional<TopologyDevice> readDevice(const Element& element);
    void readHost(const Element& element, TopologyDevice& device);
    void readLinks();
    void readLink(const Element& element);
    std::optional<std::pair<const TopologyDevice*, const TopologyDevice*>> readEnds(const Element& element);
    void readFlows(const Element& element, const std::vector<Element>& children, TopologyLink& link);
    const TopologyDevice* deviceNamed(std::string_view name) const;
    std::vector<std::string_view> deviceNames() const;
    void warnOfLoneDevices() const;

    Element m_root;
    std::vector<Element> m_children;
    SystemTopology m_topology;
    TopologyPlaces m_places;
    LinkTiming m_timing;
    Once<std::string> m_names;
    Once<DeviceId> m_ids;
    Once<std::pair<std::string, std::uint16_t>> m_endpoints;
    Once<std::pair<DeviceId, DeviceId>> m_pairs;
};

/// The timing of one `<timing>` on top of another; every rule between the values is checked on the sum.
LinkTiming readTiming(const Element& element, const LinkTiming& base);

} // namespace liena
