// Any bytes as a topology: what is read keeps every promise of section 5 of the protocol.
#include "fuzz_input.hpp"
#include "liena/system_topology.hpp"
#include "xml_checks.hpp"

#include <fmt/format.h>

#include <set>
#include <string>

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

void checkTopology(std::string_view xml)
{
    Findings findings;
    const auto topology = SystemTopology::parse(xml, "topology.xml", &findings);
    checkFindings(findings, topology.has_value(), xml);
    if (!topology)
        return;
    expect(topology.value().hash() == Sha256::of(xml), "a topology's identity is its bytes");
    checkDevices(topology.value());
    for (const auto& link : topology.value().links())
        checkLink(topology.value(), link);
}

/// A <timing> of chosen durations, over those that hold without it.
std::string chosenTiming(FuzzInput& input, LinkTiming& timing)
{
    std::string xml = "<timing";
    const auto choose = [&](std::string_view name, std::chrono::nanoseconds& value) {
        const auto count = input.number<std::uint8_t>();
        if (count == 0)
            return;
        const bool isLong = input.flag();
        value = isLong ? std::chrono::nanoseconds(std::chrono::seconds(count)) : std::chrono::milliseconds(count);
        xml += fmt::format(" {}=\"{}{}\"", name, count, isLong ? "s" : "ms");
    };
    choose("heartbeat", timing.heartbeat);
    choose("suspect", timing.suspect);
    choose("lost", timing.lost);
    choose("reconnect", timing.reconnect);
    return xml + "/>";
}

bool isInOrder(const LinkTiming& timing)
{
    return timing.suspect >= 2 * timing.heartbeat && timing.lost >= 3 * timing.heartbeat && timing.suspect < timing.lost &&
           timing.lost < timing.reconnect;
}

/// Durations are taken when they are in the page's order, and only then.
void checkTimings(FuzzInput& input)
{
    LinkTiming ofAll;
    const auto all = chosenTiming(input, ofAll);
    auto ofLink = ofAll;
    const auto link = chosenTiming(input, ofLink);
    const auto xml = fmt::format("<topology xmlns=\"urn:liena:topology:1\" name=\"pair\" version=\"1.0\">{}<security mode=\"tls\"/>"
                                 "<device name=\"a\" id=\"0x40018208\" message-set=\"a\" host=\"127.0.0.1\" port=\"52200\"/>"
                                 "<device name=\"b\" id=\"0x00008208\" message-set=\"b\" host=\"127.0.0.1\" port=\"52210\"/>"
                                 "<link between=\"a b\">{}</link></topology>",
                                 all, link);
    const auto topology = SystemTopology::parse(xml, "topology.xml");
    expect(topology.has_value() == (isInOrder(ofAll) && isInOrder(ofLink)), "durations are taken in the page's order, and only then");
    expect(!topology || topology.value().links().front().timing == ofLink, "a link has the durations that were written");
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    FuzzInput input(data, size);
    if (size > 0 && input.number<std::uint8_t>() == 0) // no XML begins so
        checkTimings(input);
    else
        checkTopology({reinterpret_cast<const char*>(data), size});
    return 0;
}
