// A robot's status of twelve fields, as a message set declares it and as a plain structure, for the measuring programs.
#pragma once

#include "liena/message.hpp"
#include "liena/message_binding.hpp"

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string_view>

namespace liena::bench {

inline constexpr std::string_view statusSetXml = R"(<message-set xmlns="urn:liena:message-set:1" name="bench-robot" version="1.0"
    class="hand" manufacturer="7" type="5" device-version="1" vendor="Sample" title="What the measuring programs send">
  <enum name="Mode" base="uint8">
    <value name="off" number="0"/>
    <value name="ready" number="1"/>
    <value name="moving" number="2"/>
    <value name="holding" number="3"/>
  </enum>
  <message number="0x0101" name="MotionCommand" role="command" priority="control" max-age="50ms" history="1" title="Moves">
    <field name="permit" type="uint32" min="0" max="4294967295" title="Permit"/>
    <field name="sequence" type="uint32" min="0" max="4294967295" title="Sequence"/>
    <field name="engaged" type="bool" title="Engaged"/>
    <field name="guidewire_velocity" type="float32" unit="mm/s" min="-40" max="40" title="Guidewire"/>
    <field name="guidewire_rotation" type="float32" unit="deg/s" min="-720" max="720" title="Guidewire, turning"/>
    <field name="catheter_velocity" type="float32" unit="mm/s" min="-40" max="40" title="Catheter"/>
    <field name="catheter_rotation" type="float32" unit="deg/s" min="-720" max="720" title="Catheter, turning"/>
  </message>
  <message number="0x0201" name="RobotStatus" role="report" priority="status" title="State">
    <field name="sequence" type="uint32" title="Sequence"/>
    <field name="uptime" type="uint64" unit="ns" title="Uptime"/>
    <field name="mode" type="Mode" title="Mode"/>
    <field name="engaged" type="bool" title="Engaged"/>
    <field name="referenced" type="bool" title="Referenced"/>
    <field name="guidewire_position" type="float32" unit="mm" min="-2000" max="2000" title="Guidewire"/>
    <field name="guidewire_velocity" type="float32" unit="mm/s" min="-40" max="40" title="Guidewire, speed"/>
    <field name="catheter_position" type="float32" unit="mm" min="-2000" max="2000" title="Catheter"/>
    <field name="catheter_velocity" type="float32" unit="mm/s" min="-40" max="40" title="Catheter, speed"/>
    <field name="force" type="float32" unit="N" min="-20" max="20" title="Force"/>
    <field name="temperature" type="float32" unit="Cel" min="-40" max="125" title="Temperature"/>
    <field name="faults" type="uint16" min="0" max="9999" title="Faults"/>
  </message>
</message-set>
)";

inline std::shared_ptr<const MessageSet> statusSet()
{
    auto set = MessageSet::parse(statusSetXml, "bench-robot.xml");
    if (!set)
        throw std::runtime_error(set.error().what);
    return set.value();
}

enum class Mode : std::uint8_t { Off, Ready, Moving, Holding };

/// A program's own variables, not in the order of the wire.
struct Status {
    float guidewirePosition = 812.5F;
    float guidewireVelocity = -3.25F;
    float catheterPosition = 640.0F;
    float catheterVelocity = 0.5F;
    float force = 1.75F;
    float temperature = 36.5F;
    std::uint64_t uptime = 1'000'000'007;
    std::uint32_t sequence = 17;
    std::uint16_t faults = 3;
    Mode mode = Mode::Moving;
    bool engaged = true;
    bool referenced = true;

    friend bool operator==(const Status&, const Status&) = default;
};

inline void write(const Status& status, Message& message)
{
    message.set(std::size_t{0}, status.sequence).set(1, status.uptime).set(2, status.mode);
    message.set(3, status.engaged).set(4, status.referenced);
    message.set(5, status.guidewirePosition).set(6, status.guidewireVelocity);
    message.set(7, status.catheterPosition).set(8, status.catheterVelocity);
    message.set(9, status.force).set(10, status.temperature).set(11, status.faults);
}

/// Of a Message, or of anything else that is asked for its fields in the same way.
template <typename Source>
void read(const Source& source, Status& status)
{
    status.sequence = source.template get<std::uint32_t>(std::size_t{0});
    status.uptime = source.template get<std::uint64_t>(1);
    status.mode = source.template get<Mode>(2);
    status.engaged = source.template get<bool>(3);
    status.referenced = source.template get<bool>(4);
    status.guidewirePosition = source.template get<float>(5);
    status.guidewireVelocity = source.template get<float>(6);
    status.catheterPosition = source.template get<float>(7);
    status.catheterVelocity = source.template get<float>(8);
    status.force = source.template get<float>(9);
    status.temperature = source.template get<float>(10);
    status.faults = source.template get<std::uint16_t>(11);
}

using StatusBinding =
    MessageBinding<Status, Bind<"sequence", &Status::sequence>, Bind<"uptime", &Status::uptime>, Bind<"mode", &Status::mode>,
                   Bind<"engaged", &Status::engaged>, Bind<"referenced", &Status::referenced>,
                   Bind<"guidewire_position", &Status::guidewirePosition>, Bind<"guidewire_velocity", &Status::guidewireVelocity>,
                   Bind<"catheter_position", &Status::catheterPosition>, Bind<"catheter_velocity", &Status::catheterVelocity>,
                   Bind<"force", &Status::force>, Bind<"temperature", &Status::temperature>, Bind<"faults", &Status::faults>>;

} // namespace liena::bench
