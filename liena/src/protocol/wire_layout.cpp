// Compiling a definition, and judging bytes by what came of it.
#include "protocol/wire_layout.hpp"

#include "protocol/information_part.hpp"

#include <bit>
#include <variant>

namespace liena::protocol {

namespace {

constexpr std::size_t longestUnrolled = 16;

/// The default, or 0, or the bound nearest to 0, or the enum's first value.
Number initialNumber(const FieldDefinition& field)
{
    if (field.initial)
        return *field.initial;
    if (field.enumeration)
        return field.enumeration->values.front().number;
    const auto real = [](const Number& n) { return std::visit([](auto v) { return static_cast<double>(v); }, n); };
    if (field.min && real(*field.min) > 0)
        return *field.min;
    if (field.max && real(*field.max) < 0)
        return *field.max;
    return std::uint64_t{0};
}

/// Of the length and of what stands at both ends: names that differ only in the middle share a place in the table, and are compared.
std::uint64_t hashOf(std::string_view name)
{
    const auto* bytes = reinterpret_cast<const std::byte*>(name.data());
    std::uint64_t head = 0;
    std::uint64_t end = name.size();
    if (name.size() >= sizeof(std::uint64_t)) {
        head = load<std::uint64_t>(bytes);
        end += load<std::uint64_t>(bytes + name.size() - sizeof(std::uint64_t));
    } else {
        for (const char c : name)
            head = head << 8U | static_cast<unsigned char>(c);
    }
    const auto mixed = (head ^ std::rotl(end, 29)) * 0x9E3779B97F4A7C15U;
    return mixed ^ mixed >> 32U;
}

} // namespace

WireLayout::WireLayout(const MessageDefinition& definition)
    : m_blocks(1), m_names(std::bit_ceil(2 * definition.fields.size() + 1), std::uint32_t{0})
{
    for (const auto& field : definition.fields) {
        addName(field.name, m_slots.size());
        m_maximum += field.maximumSize();
        if (field.hasFixedSize())
            addFixed(field);
        else
            addTail(field);
    }
}

void WireLayout::addFixed(const FieldDefinition& field)
{
    auto& block = m_blocks.back();
    FieldSlot slot;
    if (field.shape == FieldShape::Scalar && m_blocks.size() == 1) {
        slot = slotOf(field);
        slot.offset = static_cast<std::uint32_t>(block.size);
    }
    m_slots.push_back(slot);
    m_places.push_back({m_blocks.size() - 1, block.size, field.maximumSize(), false});
    addCheck(field);
    block.size += field.maximumSize();
    const auto value = initialNumber(field);
    for (std::size_t size = 0; size < field.maximumSize(); size += sizeOf(field.type)) {
        m_defaults.resize(m_defaults.size() + sizeOf(field.type));
        writeNumber(field.type, value, m_defaults.data() + m_defaults.size() - sizeOf(field.type));
    }
}

void WireLayout::addCheck(const FieldDefinition& field)
{
    auto& block = m_blocks.back();
    auto check = checkOf(field);
    const std::size_t count = field.shape == FieldShape::FixedArray ? field.count : 1;
    const auto kind = static_cast<std::size_t>(check.kind);
    if (check.kind == RangeCheck::Kind::Nothing)
        return;
    if (kind >= Block::kinds || count > longestUnrolled)
        return block.runs.push_back({block.size, count, std::move(check)});
    for (std::size_t i = 0; i < count; ++i) {
        const Bounded bounded{static_cast<std::uint32_t>(block.size + i * sizeOf(field.type)), check.low, check.high};
        block.bounded.insert(block.bounded.begin() + static_cast<std::ptrdiff_t>(block.ends[kind]), bounded);
        for (auto later = kind; later < Block::kinds; ++later)
            ++block.ends[later];
    }
}

void WireLayout::addTail(const FieldDefinition& field)
{
    auto& tail = m_blocks.back().tail;
    tail.isText = field.type == FieldType::String;
    tail.lengthSize = field.minimumSize();
    tail.elementSize = field.type == FieldType::String || field.type == FieldType::Bytes ? 1 : sizeOf(field.type);
    tail.most = field.count;
    tail.check = checkOf(field);
    m_slots.emplace_back();
    m_places.push_back({m_blocks.size() - 1, m_blocks.back().size, 0, true});
    m_defaults.resize(m_defaults.size() + tail.lengthSize);
    m_blocks.emplace_back();
}

void WireLayout::addName(std::string_view name, std::size_t index)
{
    const auto mask = m_names.size() - 1;
    auto at = hashOf(name) & mask;
    while (m_names[at] != 0)
        at = (at + 1) & mask;
    m_names[at] = static_cast<std::uint32_t>(index + 1);
}

std::optional<std::size_t> WireLayout::indexOf(const MessageDefinition& definition, std::string_view field) const
{
    const auto mask = m_names.size() - 1;
    for (auto at = hashOf(field) & mask; m_names[at] != 0; at = (at + 1) & mask)
        if (definition.fields[m_names[at] - 1].name == field)
            return m_names[at] - 1;
    return std::nullopt;
}

bool WireLayout::accepts(std::span<const std::byte> bytes) const
{
    for (const auto& block : m_blocks) {
        if (bytes.size() < block.size || !holds(block, bytes.data()))
            return false;
        bytes = bytes.subspan(block.size);
        if (block.tail.lengthSize > 0 && !takeTail(block.tail, bytes))
            return false;
    }
    return bytes.empty();
}

/// Without a branch for each number: bytes that are refused are rare, and asked about in full.
template <typename T>
bool WireLayout::areWithin(const Block& block, RangeCheck::Kind kind, const std::byte* bytes)
{
    const auto index = static_cast<std::size_t>(kind);
    const auto* at = block.bounded.data() + (index == 0 ? 0 : block.ends[index - 1]);
    const auto* const end = block.bounded.data() + block.ends[index];
    bool within = true;
    for (; at != end; ++at)
        within &= isWithin(load<T>(bytes + at->offset), at->low, at->high);
    return within;
}

bool WireLayout::holds(const Block& block, const std::byte* bytes)
{
    using Kind = RangeCheck::Kind;
    bool within = areWithin<std::uint8_t>(block, Kind::Whole8, bytes);
    within &= areWithin<std::uint16_t>(block, Kind::Whole16, bytes);
    within &= areWithin<std::uint32_t>(block, Kind::Whole32, bytes);
    within &= areWithin<std::uint64_t>(block, Kind::Whole64, bytes);
    within &= areWithin<float>(block, Kind::Real32, bytes);
    within &= areWithin<double>(block, Kind::Real64, bytes);
    for (const auto& run : block.runs)
        within = within && protocol::holds(run.check, bytes + run.offset, run.count);
    return within;
}

bool WireLayout::takeTail(const Tail& tail, std::span<const std::byte>& bytes)
{
    if (bytes.size() < tail.lengthSize)
        return false;
    const auto size = sizeOfTail(tail, bytes.data());
    const auto count = (size - tail.lengthSize) / tail.elementSize;
    if (count > tail.most || bytes.size() < size)
        return false;
    const auto elements = bytes.subspan(tail.lengthSize, size - tail.lengthSize);
    if (tail.isText && !isUtf8({reinterpret_cast<const char*>(elements.data()), elements.size()}))
        return false;
    bytes = bytes.subspan(size);
    return protocol::holds(tail.check, elements.data(), count);
}

std::size_t WireLayout::sizeOfTail(const Tail& tail, const std::byte* bytes)
{
    const std::size_t length = tail.lengthSize == sizeof(std::uint16_t) ? load<std::uint16_t>(bytes) : load<std::uint32_t>(bytes);
    return tail.lengthSize + length * tail.elementSize;
}

FieldSpan WireLayout::locate(std::span<const std::byte> bytes, std::size_t index) const
{
    const auto& place = m_places[index];
    std::size_t begin = 0;
    for (std::size_t i = 0; i < place.block; ++i) {
        begin += m_blocks[i].size;
        begin += sizeOfTail(m_blocks[i].tail, bytes.data() + begin);
    }
    begin += place.offset;
    return {begin, place.isTail ? sizeOfTail(m_blocks[place.block].tail, bytes.data() + begin) : place.size};
}

} // namespace liena::protocol
