// Comparing a structure's members with a definition, and what a binding asks about in full.
#include "liena/message_binding.hpp"

#include "protocol/information_part.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace liena::protocol {

namespace {

std::string shapeName(std::string_view element, bool isArray, std::size_t count)
{
    return isArray ? fmt::format("{}[{}]", element, count) : std::string(element);
}

std::string shapeOf(const FieldDefinition& field)
{
    const auto base = toString(field.type);
    const auto element = field.enumeration ? fmt::format("{} (an enumeration of {})", field.enumeration->name, base) : std::string(base);
    return shapeName(element, field.shape == FieldShape::FixedArray, field.count);
}

/// `std::array<float, 3>` for float32[3].
std::string memberFor(const FieldDefinition& field)
{
    static constexpr std::array<std::string_view, 11> names{"bool",          "std::int8_t",  "std::int16_t",  "std::int32_t",
                                                            "std::int64_t",  "std::uint8_t", "std::uint16_t", "std::uint32_t",
                                                            "std::uint64_t", "float",        "double"};
    const auto base = names[static_cast<std::size_t>(field.type)];
    const auto element = field.enumeration ? fmt::format("an enum class of {}", base) : std::string(base);
    return field.shape == FieldShape::FixedArray ? fmt::format("std::array<{}, {}>", element, field.count) : element;
}

/// Why the member cannot hold the field, or nothing.
std::optional<std::string> mismatch(const MessageDefinition& definition, std::size_t index, const MemberForm& member)
{
    const auto& field = definition.fields[index];
    const auto varies = [](const FieldDefinition& f) { return !f.hasFixedSize(); };
    if (varies(field))
        return fmt::format("{}.{} varies in size and cannot be bound: leave it out, and use Message::set() and get() for it",
                           definition.name, field.name);
    const auto end = definition.fields.begin() + static_cast<std::ptrdiff_t>(index);
    if (const auto before = std::find_if(definition.fields.begin(), end, varies); before != end)
        return fmt::format("{}.{} stands behind {}, which varies in size, and cannot be bound: leave it out, and use Message::set() and "
                           "get() for it, or declare it in front",
                           definition.name, field.name, before->name);
    const bool isArray = field.shape == FieldShape::FixedArray;
    if (field.type != member.type || isArray != member.isArray || (isArray && field.count != member.count))
        return fmt::format("{}.{} is {}, and the member bound to it is {}: make the member {}", definition.name, field.name, shapeOf(field),
                           shapeName(toString(member.type), member.isArray, member.count), memberFor(field));
    return std::nullopt;
}

/// The longest stretch of an enumeration's numbers without a gap: its first, and how far it reaches.
std::pair<std::int64_t, std::uint64_t> longestStretch(const std::vector<std::int64_t>& numbers)
{
    std::pair<std::int64_t, std::uint64_t> longest{numbers.front(), 0};
    std::size_t first = 0;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        if (i > 0 && static_cast<std::uint64_t>(numbers[i]) - static_cast<std::uint64_t>(numbers[i - 1]) != 1)
            first = i;
        if (i - first > longest.second)
            longest = {numbers[first], i - first};
    }
    return longest;
}

FieldPlace placeOf(const WireLayout& layout, const FieldDefinition& field, std::size_t index)
{
    FieldPlace place{index, layout.locate({}, index).begin, {}, {}}; // needs no bytes: nothing in front varies in size
    const auto check = checkOf(field);
    place.low = check.low;
    place.high = check.high;
    const bool isReal = field.type == FieldType::Float32 || field.type == FieldType::Float64;
    if (check.kind == RangeCheck::Kind::Nothing && !isReal)
        place.high.fill(std::byte{0xFF});
    if (check.kind == RangeCheck::Kind::Declared) {
        const auto [first, reach] = longestStretch(check.declared);
        store(place.low.data(), first);
        store(place.high.data(), reach);
    }
    return place;
}

} // namespace

BoundMessage::BoundMessage(std::shared_ptr<const MessageSet> set, const MessageDefinition& definition, bool isWhole)
    : m_set(std::move(set)),
      m_definition(&definition),
      m_layout(definition.layout.get()),
      m_defaults(m_layout->defaults()),
      m_isWhole(isWhole)
{}

Result<BoundMessage> BoundMessage::to(std::shared_ptr<const MessageSet> set, std::string_view message, std::span<const MemberForm> members,
                                      std::span<FieldPlace> places)
{
    if (set == nullptr)
        return fail(Errc::InvalidArgument, fmt::format("{} cannot be bound: there is no message set", message));
    const auto* definition = set->find(message);
    if (definition == nullptr)
        return fail(Errc::UnknownMessage,
                    fmt::format("message set {} {} has no message {}: bind one that it has", set->name(), set->version(), message));
    for (std::size_t i = 0; i < members.size(); ++i) {
        const auto index = definition->indexOf(members[i].field);
        if (!index)
            return fail(Errc::InvalidArgument, fmt::format("{} of message set {} {} has no field {}: correct the binding, or the set",
                                                           message, set->name(), set->version(), members[i].field));
        if (auto why = mismatch(*definition, *index, members[i]))
            return fail(Errc::InvalidArgument, std::move(*why));
        places[i] = placeOf(*definition->layout.get(), definition->fields[*index], *index);
    }
    return BoundMessage(std::move(set), *definition, members.size() == definition->fields.size());
}

/// A set that was read twice, here and from a peer, is the same as long as its bytes are.
bool BoundMessage::isOfEqualSet(const Message& message) const
{
    if (message.m_set == nullptr || message.messageSet().hash() != m_set->hash())
        return false;
    const auto& other = message.definition();
    return other.number == m_definition->number && message.messageSet().find(other.number) == &other;
}

std::optional<Error> BoundMessage::faultIn(std::span<const std::byte> fields) const
{
    if (auto why = checkFields(*m_definition, fields))
        return Error{Errc::ValueRefused, std::move(*why)};
    return std::nullopt;
}

std::optional<std::string> BoundMessage::faultOf(std::size_t index, std::span<const std::byte> numbers) const
{
    const auto& field = m_definition->fields[index];
    for (std::size_t at = 0; at < numbers.size(); at += sizeOf(field.type))
        if (auto why = checkNumber(*m_definition, field, readNumber(field.type, numbers.data() + at)))
            return why;
    return std::nullopt;
}

bool BoundMessage::allows(std::size_t field, std::span<const std::byte> numbers) const { return !faultOf(field, numbers); }

void BoundMessage::refuse(Message& message, std::size_t field, std::span<const std::byte> numbers) const
{
    if (auto why = faultOf(field, numbers))
        message.refuse(std::move(*why));
}

void BoundMessage::refuseStranger(Message& message) const
{
    message.refuse(fmt::format("{} is not {} of message set {} {}, to which the structure is bound: bind it to the message's own set",
                               message.m_set != nullptr ? message.name() : "a message that was moved away", m_definition->name,
                               m_set->name(), m_set->version()));
}

} // namespace liena::protocol
