// Any bytes as a topology: what is read keeps every promise of section 5 of the protocol.
#include "liena/system_topology.hpp"
#include "xml_checks.hpp"

#include <set>

using namespace liena;
using namespace liena::fuzz;

namespace {

void checkDevices(const SystemTopology& topology)
{
    std::set<DeviceId> ids;
    std::set<std::string_view> names;
    std::set<std::pair<std::string_view, std::uint16_t>> places;
    for (const auto& device : topology.devices()) {
        expect(device.id.isValidDevice() && !device.id.isBroadcast(), "a device has an id that a device may have");
        expect(device.port != 0 && !device.host.empty(), "a device has a place");
        expect(ids.insert(device.id).second && names.insert(device.name).second, "ids and names are unique");
        expect(places.insert({device.host, device.port}).second, "no two devices share a place");
        expect(topology.find(device.id) == &device && topology.find(device.name) == &device, "each device is found");
    }
}

void checkLink(const SystemTopology& topology, const TopologyLink& link)
{
    expect(link.a < link.b, "a link's ends are in order");
    expect(topology.find(link.a) != nullptr && topology.find(link.b) != nullptr, "a link joins devices");
    expect(topology.link(link.a, link.b) == &link && topology.link(link.b, link.a) == &link, "a pair has one link");
    const auto& timing = link.timing;
    expect(timing.heartbeat.count() > 0, "a heartbeat takes time");
    expect(timing.suspect / 2 >= timing.heartbeat && timing.lost / 3 >= timing.heartbeat, "suspicion and loss take several heartbeats");
    expect(timing.suspect < timing.lost && timing.lost < timing.reconnect, "suspect < lost < reconnect");
    for (const auto& flow : link.flows)
        expect(flow.from == link.a || flow.from == link.b, "a flow comes from one end of its link");
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const std::string_view xml(reinterpret_cast<const char*>(data), size);
    Findings findings;
    const auto topology = SystemTopology::parse(xml, "topology.xml", &findings);
    checkFindings(findings, topology.has_value(), xml);
    if (!topology)
        return 0;
    expect(topology.value().hash() == Sha256::of(xml), "a topology's identity is its bytes");
    checkDevices(topology.value());
    for (const auto& link : topology.value().links())
        checkLink(topology.value(), link);
    return 0;
}
