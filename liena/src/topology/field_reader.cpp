// Types, shapes, lengths, bounds and defaults of fields, and what goes with what (protocol section 3, rulings B12 and B13).
#include "topology/field_reader.hpp"

#include "topology/attribute_values.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace liena {

namespace {

constexpr std::int64_t mostElements = 65'535;
constexpr std::int64_t longestString = 65'535;
constexpr std::int64_t largestBytes = 32LL * 1024 * 1024;

bool isReal(FieldType type) { return type == FieldType::Float32 || type == FieldType::Float64; }
bool isText(FieldType type) { return type == FieldType::String || type == FieldType::Bytes; }
bool isSigned(FieldType type)
{
    return type == FieldType::Int8 || type == FieldType::Int16 || type == FieldType::Int32 || type == FieldType::Int64;
}

std::optional<Number> realNumber(std::string_view text, FieldType type)
{
    const auto value = realFrom(text);
    if (!value)
        return std::nullopt;
    if (type == FieldType::Float64)
        return Number(*value);
    // Beyond the largest float the conversion is undefined, so it is asked first; half a step above it would round down to it.
    if (std::fabs(*value) > static_cast<double>(std::numeric_limits<float>::max()))
        return std::nullopt;
    return Number(static_cast<double>(static_cast<float>(*value)));
}

std::optional<Number> wholeNumber(std::string_view text, FieldType type)
{
    const auto bits = sizeOf(type) * 8;
    if (isSigned(type)) {
        const auto value = signedFrom(text);
        const auto highest = std::numeric_limits<std::int64_t>::max() >> (64 - bits);
        return value && *value <= highest && *value >= -highest - 1 ? std::optional<Number>(*value) : std::nullopt;
    }
    const auto value = unsignedFrom(text);
    return value && *value <= std::numeric_limits<std::uint64_t>::max() >> (64 - bits) ? std::optional<Number>(*value) : std::nullopt;
}

class FieldReader {
public:
    FieldReader(const Element& element, const EnumTable& enums) : m_element(element), m_enums(enums) {}

    std::optional<FieldDefinition> read();

private:
    bool readType();
    bool readShape(std::string_view suffix, const Attribute& type);
    void readLength();
    void readBounds();
    void readDefault();
    std::optional<Number> numberFrom(const std::optional<Attribute>& attribute) const;
    std::optional<Number> enumNumber(const Attribute& attribute) const;
    void refuse(std::string_view attribute, const std::string& why) const;
    std::string typeText() const { return std::string(m_field.enumeration ? m_field.enumeration->name : toString(m_field.type)); }

    const Element& m_element;
    const EnumTable& m_enums;
    FieldDefinition m_field;
    bool m_isEnum = false;
};

std::optional<FieldDefinition> FieldReader::read()
{
    m_element.expectAttributes({"name", "type", "unit", "min", "max", "default", "max-length", "max-count", "nonfinite", "title"});
    m_field.description = descriptionAmong(m_element.children({"description"}));
    const auto name = nameFrom(m_element.require("name"));
    const bool hasType = readType();
    m_field.title = textFrom(m_element.find("title"));
    m_field.unit = textFrom(m_element.find("unit"));
    if (!name || !hasType)
        return std::nullopt;
    m_field.name = *name;
    readLength();
    readBounds();
    readDefault();
    return std::move(m_field);
}

bool FieldReader::readType()
{
    const auto type = m_element.require("type");
    if (!type)
        return false;
    const auto bracket = type->value().find('[');
    const auto element = type->value().substr(0, bracket);
    const auto suffix = bracket == std::string_view::npos ? std::string_view() : type->value().substr(bracket);
    if (const auto plain = fieldTypeFrom(element)) {
        m_field.type = *plain;
    } else if (const auto found = m_enums.find(element); found != m_enums.end()) {
        if (!found->second)
            return false;
        m_isEnum = true;
        m_field.enumeration = found->second;
        m_field.type = found->second->base;
    } else {
        std::vector<std::string_view> known{"bool",   "int8",   "int16",   "int32",   "int64",  "uint8", "uint16",
                                            "uint32", "uint64", "float32", "float64", "string", "bytes"};
        for (const auto& [name, definition] : m_enums)
            known.push_back(name);
        const auto nearest = suggestion(element, known);
        type->reject(inQuotes(element) + " is neither a type nor an enum of this set",
                     nearest.empty() ? "declare <enum name=\"…\">, or use a type of the protocol such as float32" : nearest);
        return false;
    }
    return readShape(suffix, *type);
}

bool FieldReader::readShape(std::string_view suffix, const Attribute& type)
{
    if (suffix.empty())
        return true;
    if (isText(m_field.type)) {
        type.reject(fmt::format("{} cannot be repeated", toString(m_field.type)), "arrays and sequences hold fixed-size types only");
        return false;
    }
    if (suffix == "[]") {
        m_field.shape = FieldShape::Sequence;
        return true;
    }
    const auto count = suffix.ends_with(']') ? unsignedFrom(suffix.substr(1, suffix.size() - 2)) : std::nullopt;
    if (!count || *count < 1 || *count > static_cast<std::uint64_t>(mostElements) || suffix[1] == '0') {
        type.reject(inQuotes(type.value()) + " is no array", fmt::format("write T[n] with n from 1 to {}, or T[]", mostElements));
        return false;
    }
    m_field.shape = FieldShape::FixedArray;
    m_field.count = static_cast<std::uint32_t>(*count);
    return true;
}

void FieldReader::readLength()
{
    const bool sequence = m_field.shape == FieldShape::Sequence;
    if (!isText(m_field.type))
        refuse("max-length", "only string and bytes have a length");
    if (!sequence)
        refuse("max-count", "only a sequence T[] has a count");
    if (!isText(m_field.type) && !sequence)
        return;
    const auto highest = m_field.type == FieldType::String ? longestString : largestBytes;
    const auto count = integerFrom(m_element.require(sequence ? "max-count" : "max-length"), 1, highest);
    if (count)
        m_field.count = static_cast<std::uint32_t>(*count);
}

void FieldReader::readBounds()
{
    const auto nonfinite = m_element.find("nonfinite");
    if (nonfinite && !isReal(m_field.type))
        refuse("nonfinite", "only float32 and float64 can hold NaN and infinities");
    else
        m_field.nonfinite = choiceFrom<bool>(nonfinite, {{"true", true}, {"false", false}}).value_or(false);
    if (m_isEnum || isText(m_field.type) || m_field.type == FieldType::Bool) {
        const auto why = fmt::format("{} has no bounds", typeText());
        refuse("min", why);
        refuse("max", why);
        return;
    }
    const auto max = m_element.find("max");
    m_field.min = numberFrom(m_element.find("min"));
    m_field.max = numberFrom(max);
    if (m_field.min && m_field.max && *m_field.max < *m_field.min)
        max->reject(fmt::format("max {} is below min {}", max->value(), m_element.find("min")->value()), "exchange them");
}

void FieldReader::readDefault()
{
    const auto initial = m_element.find("default");
    if (!initial)
        return;
    if (isText(m_field.type) || m_field.shape == FieldShape::Sequence)
        return refuse("default", "texts and sequences start empty");
    if (m_isEnum)
        m_field.initial = enumNumber(*initial);
    else if (m_field.type == FieldType::Bool)
        m_field.initial = choiceFrom<Number>(initial, {{"true", Number(std::uint64_t{1})}, {"false", Number(std::uint64_t{0})}});
    else
        m_field.initial = numberFrom(initial);
    if (!m_field.initial)
        return;
    const bool below = m_field.min && *m_field.initial < *m_field.min;
    const bool above = m_field.max && *m_field.max < *m_field.initial;
    if (below || above)
        initial->reject(fmt::format("the default {} is {}", initial->value(), below ? "below min" : "above max"),
                        "choose a value within the bounds");
}

std::optional<Number> FieldReader::numberFrom(const std::optional<Attribute>& attribute) const
{
    if (!attribute)
        return std::nullopt;
    const auto text = attribute->value();
    const auto number = isReal(m_field.type) ? realNumber(text, m_field.type) : wholeNumber(text, m_field.type);
    if (!number)
        attribute->reject(fmt::format("{} is no {}", inQuotes(text), toString(m_field.type)),
                          fmt::format("'{}' is a {} number of the field's type", attribute->name(),
                                      isReal(m_field.type) ? "finite decimal" : "whole decimal"));
    return number;
}

std::optional<Number> FieldReader::enumNumber(const Attribute& attribute) const
{
    if (const auto* value = m_field.enumeration->find(attribute.value()))
        return isSigned(m_field.type) ? Number(value->number) : Number(static_cast<std::uint64_t>(value->number));
    std::vector<std::string_view> known;
    for (const auto& value : m_field.enumeration->values)
        known.push_back(value.name);
    attribute.reject(fmt::format("{} is no value of {}", inQuotes(attribute.value()), m_field.enumeration->name),
                     suggestion(attribute.value(), known));
    return std::nullopt;
}

void FieldReader::refuse(std::string_view attribute, const std::string& why) const
{
    if (const auto present = m_element.find(attribute))
        present->misplaced(fmt::format("'{}' does not belong to a field of type {}", attribute, textFrom(m_element.find("type"))), why);
}

} // namespace

std::optional<FieldDefinition> readField(const Element& element, const EnumTable& enums) { return FieldReader(element, enums).read(); }

} // namespace liena
