// What differs between two message sets, in words.
#include "liena/known_sets.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace liena {

namespace {

using Lines = std::vector<std::string>;
using Attributes = std::vector<std::pair<std::string_view, std::string>>;

std::string textOf(const std::optional<Number>& number)
{
    return number ? std::visit([](auto value) { return fmt::format("{}", value); }, *number) : "none";
}

std::string textOf(const std::optional<std::chrono::nanoseconds>& time)
{
    return time ? fmt::format("{} us", std::chrono::duration_cast<std::chrono::microseconds>(*time).count()) : "none";
}

std::string typeOf(const FieldDefinition& field)
{
    const auto type = field.enumeration ? field.enumeration->name : std::string(toString(field.type));
    switch (field.shape) {
    case FieldShape::FixedArray:
        return fmt::format("{}[{}]", type, field.count);
    case FieldShape::Sequence:
        return fmt::format("{}[] of at most {}", type, field.count);
    case FieldShape::Scalar:
        break;
    }
    const bool varies = field.type == FieldType::String || field.type == FieldType::Bytes;
    return varies ? fmt::format("{} of at most {} bytes", type, field.count) : type;
}

Attributes attributesOf(const FieldDefinition& field)
{
    return {{"type", typeOf(field)},
            {"unit", field.unit.empty() ? "none" : field.unit},
            {"min", textOf(field.min)},
            {"max", textOf(field.max)},
            {"default", textOf(field.initial)},
            {"nonfinite", field.nonfinite ? "true" : "false"}};
}

Attributes attributesOf(const MessageDefinition& message)
{
    return {{"name", message.name},
            {"role", std::string(toString(message.role))},
            {"priority", std::string(toString(message.priority))},
            {"in-standby", message.allowedInStandBy ? "allow" : "refuse"},
            {"period", textOf(message.period)},
            {"deadline", textOf(message.deadline)},
            {"lifespan", textOf(message.lifespan)},
            {"max-age", textOf(message.maxAge)},
            {"history", message.history == 0 ? "none" : fmt::format("{}", message.history)},
            {"path", message.path == Path::Datagram ? "datagram" : "stream"}};
}

void compare(const std::string& place, const Attributes& before, const Attributes& now, Lines& lines)
{
    for (std::size_t i = 0; i < now.size(); ++i)
        if (before[i].second != now[i].second)
            lines.push_back(fmt::format("{}: {} was {}, is {}", place, now[i].first, before[i].second, now[i].second));
}

/// Fields have no numbers: what stands in the same place on the wire is compared.
void compareFields(const MessageDefinition& before, const MessageDefinition& now, Lines& lines)
{
    const auto both = std::min(before.fields.size(), now.fields.size());
    for (std::size_t i = 0; i < both; ++i) {
        const auto place = fmt::format("{}.{}", now.name, now.fields[i].name);
        if (before.fields[i].name != now.fields[i].name)
            lines.push_back(fmt::format("{}: stands where {} stood", place, before.fields[i].name));
        compare(place, attributesOf(before.fields[i]), attributesOf(now.fields[i]), lines);
    }
    for (std::size_t i = both; i < before.fields.size(); ++i)
        lines.push_back(fmt::format("{}.{}: is gone", now.name, before.fields[i].name));
    for (std::size_t i = both; i < now.fields.size(); ++i)
        lines.push_back(fmt::format("{}.{}: is new, {}", now.name, now.fields[i].name, typeOf(now.fields[i])));
}

void compareMessages(const MessageSet& before, const MessageSet& now, Lines& lines)
{
    for (const auto& message : before.messages())
        if (now.find(message.number) == nullptr)
            lines.push_back(fmt::format("{} (0x{:04x}): is gone", message.name, message.number));
    for (const auto& message : now.messages()) {
        const auto* old = before.find(message.number);
        if (old == nullptr) {
            lines.push_back(fmt::format("{} (0x{:04x}): is new, a {} of priority {}", message.name, message.number, toString(message.role),
                                        toString(message.priority)));
            continue;
        }
        compare(fmt::format("{} (0x{:04x})", message.name, message.number), attributesOf(*old), attributesOf(message), lines);
        compareFields(*old, message, lines);
    }
}

const EnumDefinition* enumOf(const MessageSet& set, const std::string& name)
{
    for (const auto& one : set.enums())
        if (one->name == name)
            return one.get();
    return nullptr;
}

void compareEnums(const MessageSet& before, const MessageSet& now, Lines& lines)
{
    for (const auto& one : before.enums())
        if (enumOf(now, one->name) == nullptr)
            lines.push_back(fmt::format("enum {}: is gone", one->name));
    for (const auto& one : now.enums()) {
        const auto* old = enumOf(before, one->name);
        if (old == nullptr) {
            lines.push_back(fmt::format("enum {}: is new", one->name));
            continue;
        }
        if (old->base != one->base)
            lines.push_back(fmt::format("enum {}: base was {}, is {}", one->name, toString(old->base), toString(one->base)));
        for (const auto& value : old->values)
            if (one->find(value.number) == nullptr)
                lines.push_back(fmt::format("enum {}: {} ({}) is gone", one->name, value.name, value.number));
        for (const auto& value : one->values) {
            const auto* known = old->find(value.number);
            if (known == nullptr)
                lines.push_back(fmt::format("enum {}: {} ({}) is new", one->name, value.name, value.number));
            else if (known->name != value.name)
                lines.push_back(fmt::format("enum {}: {} was {}, is {}", one->name, value.number, known->name, value.name));
        }
    }
}

} // namespace

std::vector<std::string> describeChanges(const MessageSet& before, const MessageSet& now)
{
    Lines lines;
    if (before.deviceType() != now.deviceType())
        lines.push_back(fmt::format("device type: was {}, is {}", before.deviceType().toString(), now.deviceType().toString()));
    compareEnums(before, now, lines);
    compareMessages(before, now, lines);
    return lines;
}

} // namespace liena
