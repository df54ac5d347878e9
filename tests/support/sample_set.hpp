// A small message set with a field of every kind.
#pragma once

#include "liena/message.hpp"

#include <memory>
#include <stdexcept>
#include <string_view>

namespace liena::test {

inline constexpr std::string_view sampleSetXml = R"(<message-set xmlns="urn:liena:message-set:1" name="sample-device" version="1.0"
    class="hand" manufacturer="7" type="3" device-version="2" vendor="Sample" title="A device for tests">
  <enum name="Mode" base="uint8">
    <value name="slow" number="3"/>
    <value name="fast" number="9"/>
  </enum>
  <message number="0x0100" name="Move" role="command" priority="control" lifespan="50ms" history="1" max-age="50ms" title="Moves">
    <field name="permit" type="uint32" title="Permit"/>
    <field name="engaged" type="bool" title="Engaged"/>
    <field name="speed" type="float32" unit="mm/s" min="-40" max="40" default="0" title="Speed"/>
    <field name="force" type="float64" unit="N" min="0.5" max="30" title="Force"/>
    <field name="mode" type="Mode" title="Mode"/>
  </message>
  <message number="0x0101" name="Stop" role="command" priority="safety" title="Stops"/>
  <message number="0x0200" name="State" role="report" priority="status" deadline="50ms" history="2" title="State">
    <field name="count" type="uint16" default="7" title="Count"/>
    <field name="offset" type="int16" min="-100" max="-10" title="Offset"/>
    <field name="note" type="string" max-length="12" title="Note"/>
    <field name="raw" type="bytes" max-length="6" title="Raw"/>
    <field name="axes" type="float32[3]" min="-1" max="1" title="Axes"/>
    <field name="trace" type="int16[]" max-count="4" title="Trace"/>
    <field name="mode" type="Mode" default="fast" title="Mode"/>
    <field name="total" type="uint64" title="Total"/>
  </message>
  <message number="0x0201" name="Log" role="report" priority="status" title="A line that is kept until it is taken">
    <field name="line" type="string" max-length="200" title="Line"/>
  </message>
  <message number="0x0202" name="Picture" role="report" priority="bulk" history="1" title="A picture">
    <field name="pixels" type="bytes" max-length="1000000" title="Pixels"/>
  </message>
</message-set>
)";

inline std::shared_ptr<const MessageSet> sampleSet()
{
    Findings findings;
    auto set = MessageSet::parse(sampleSetXml, "sample-device.xml", &findings);
    if (!set)
        throw std::runtime_error(findings.empty() ? set.error().what : findings.front().toString());
    return set.value();
}

inline Message sampleMessage(const std::shared_ptr<const MessageSet>& set, std::string_view name) { return {set, *set->find(name)}; }

} // namespace liena::test
