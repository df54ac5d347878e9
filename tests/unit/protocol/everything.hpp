// A message with a field of each kind that has a fixed place, and structures bound to it.
#pragma once

#include "liena/message_binding.hpp"

#include <array>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string_view>

namespace liena::test {

inline constexpr std::string_view everythingXml =
    R"(<message-set xmlns="urn:liena:message-set:1" name="everything" version="1.0" class="hand"
    manufacturer="7" type="6" device-version="1" vendor="Sample" title="Fields of every kind">
  <enum name="Mode" base="uint8"><value name="off" number="0"/><value name="on" number="1"/><value name="special" number="9"/></enum>
  <enum name="Side" base="int8"><value name="left" number="-1"/><value name="none" number="0"/><value name="right" number="1"/></enum>
  <message number="0x0201" name="Everything" role="report" priority="status" title="Each kind that has a fixed place">
    <field name="sequence" type="uint32" default="7" title="1"/>
    <field name="offset" type="int16" min="-100" max="-10" title="2"/>
    <field name="mode" type="Mode" default="special" title="3"/>
    <field name="side" type="Side" title="4"/>
    <field name="engaged" type="bool" title="5"/>
    <field name="speed" type="float32" unit="mm/s" min="-40" max="40" title="6"/>
    <field name="level" type="float32" min="0" max="10" nonfinite="true" title="7"/>
    <field name="angle" type="float64" title="8"/>
    <field name="anything" type="float64" nonfinite="true" title="9"/>
    <field name="total" type="uint64" max="9223372036854775818" title="10"/>
    <field name="position" type="int64" min="-5" title="11"/>
    <field name="axes" type="float32[3]" min="-1" max="1" title="12"/>
    <field name="limits" type="bool[2]" title="13"/>
    <field name="modes" type="Mode[2]" title="14"/>
    <field name="small" type="uint8" min="3" max="7" title="15"/>
    <field name="step" type="int32" max="70000" title="16"/>
    <field name="trace" type="float64[20]" min="-1" max="1" title="17"/>
    <field name="tiny" type="int8" title="18"/>
    <field name="faults" type="uint16" min="0" max="9999" title="19"/>
  </message>
  <message number="0x0202" name="Tailed" role="report" priority="status" title="Fields in front of a text and behind it">
    <field name="sequence" type="uint32" default="7" title="1"/>
    <field name="faults" type="uint16" min="0" max="9999" title="2"/>
    <field name="note" type="string" max-length="12" title="3"/>
    <field name="speed" type="float32" min="-40" max="40" title="4"/>
    <field name="marks" type="int16[]" max-count="4" title="5"/>
  </message>
</message-set>)";

enum class Mode : std::uint8_t { Off = 0, On = 1, Special = 9 };
enum class Side : std::int8_t { Left = -1, None = 0, Right = 1 };

struct Everything {
    std::array<double, 20> trace{};
    std::uint32_t sequence = 1;
    std::int16_t offset = -10;
    Mode mode = Mode::On;
    Side side = Side::Left;
    bool engaged = true;
    float speed = 1.5F;
    float level = 2.5F;
    double angle = 3.5;
    double anything = 4.5;
    std::uint64_t total = 5;
    std::int64_t position = 6;
    std::array<float, 3> axes{0.25F, 0.5F, 0.75F};
    std::array<bool, 2> limits{true, false};
    std::array<Mode, 2> modes{Mode::On, Mode::Special};
    std::uint8_t small = 4;
    std::int32_t step = -8;
    std::int8_t tiny = -9;
    std::uint16_t faults = 10;

    friend bool operator==(const Everything&, const Everything&) = default;
};

using E = Everything;
/// All, in the order of the wire.
using WholeBinding =
    MessageBinding<E, Bind<"sequence", &E::sequence>, Bind<"offset", &E::offset>, Bind<"mode", &E::mode>, Bind<"side", &E::side>,
                   Bind<"engaged", &E::engaged>, Bind<"speed", &E::speed>, Bind<"level", &E::level>, Bind<"angle", &E::angle>,
                   Bind<"anything", &E::anything>, Bind<"total", &E::total>, Bind<"position", &E::position>, Bind<"axes", &E::axes>,
                   Bind<"limits", &E::limits>, Bind<"modes", &E::modes>, Bind<"small", &E::small>, Bind<"step", &E::step>,
                   Bind<"trace", &E::trace>, Bind<"tiny", &E::tiny>, Bind<"faults", &E::faults>>;
/// All, in another order.
using ShuffledBinding =
    MessageBinding<E, Bind<"faults", &E::faults>, Bind<"tiny", &E::tiny>, Bind<"trace", &E::trace>, Bind<"step", &E::step>,
                   Bind<"sequence", &E::sequence>, Bind<"offset", &E::offset>, Bind<"mode", &E::mode>, Bind<"side", &E::side>,
                   Bind<"engaged", &E::engaged>, Bind<"speed", &E::speed>, Bind<"level", &E::level>, Bind<"angle", &E::angle>,
                   Bind<"anything", &E::anything>, Bind<"total", &E::total>, Bind<"position", &E::position>, Bind<"axes", &E::axes>,
                   Bind<"limits", &E::limits>, Bind<"modes", &E::modes>, Bind<"small", &E::small>>;
using PartBinding = MessageBinding<E, Bind<"mode", &E::mode>, Bind<"speed", &E::speed>, Bind<"faults", &E::faults>>;
/// The first ones, in front of a text.
using FrontBinding = MessageBinding<E, Bind<"sequence", &E::sequence>, Bind<"faults", &E::faults>>;

template <typename Structure, typename Visit>
void eachField(Structure& e, Visit visit)
{
    visit("sequence", e.sequence), visit("offset", e.offset), visit("mode", e.mode), visit("side", e.side), visit("engaged", e.engaged);
    visit("speed", e.speed), visit("level", e.level), visit("angle", e.angle), visit("anything", e.anything), visit("total", e.total);
    visit("position", e.position), visit("axes", e.axes), visit("limits", e.limits), visit("modes", e.modes), visit("small", e.small);
    visit("step", e.step), visit("trace", e.trace), visit("tiny", e.tiny), visit("faults", e.faults);
}

inline std::shared_ptr<const MessageSet> everythingSet()
{
    Findings findings;
    auto set = MessageSet::parse(everythingXml, "everything.xml", &findings);
    if (!set)
        throw std::runtime_error(findings.empty() ? set.error().what : findings.front().toString());
    return set.value();
}

} // namespace liena::test
