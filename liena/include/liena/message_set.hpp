// What one type of device says and understands: the definitions of its messages, read from XML (protocol sections 3 and 4).
#pragma once

#include "liena/device_id.hpp"
#include "liena/error.hpp"
#include "liena/finding.hpp"
#include "liena/hash.hpp"

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace liena {

enum class FieldType : std::uint8_t { Bool, Int8, Int16, Int32, Int64, UInt8, UInt16, UInt32, UInt64, Float32, Float64, String, Bytes };

std::string_view toString(FieldType type);
std::optional<FieldType> fieldTypeFrom(std::string_view name);

/// Bytes of one element on the wire; 0 for String and Bytes, whose size varies.
std::size_t sizeOf(FieldType type);

enum class FieldShape : std::uint8_t { Scalar, FixedArray, Sequence };

/// A bound or a default in the widest type of its kind.
using Number = std::variant<std::int64_t, std::uint64_t, double>;

struct EnumValue {
    std::string name;
    std::int64_t number = 0;
    std::string title;
};

struct EnumDefinition {
    std::string name;
    FieldType base = FieldType::UInt8;
    std::vector<EnumValue> values;

    // Null when there is none; valid as long as the definition.
    const EnumValue* find(std::int64_t number) const;
    const EnumValue* find(std::string_view name) const;
};

struct FieldDefinition {
    std::string name;
    std::string title;
    std::string unit; ///< UCUM, empty for a number without unit
    std::string description;
    FieldType type = FieldType::UInt8;                 ///< of one element; the base of an enumeration
    std::shared_ptr<const EnumDefinition> enumeration; ///< null unless the type is an enum's name
    FieldShape shape = FieldShape::Scalar;
    std::uint32_t count = 1; ///< FixedArray: n; Sequence: max-count; String and Bytes: max-length in bytes; else 1
    std::optional<Number> min;
    std::optional<Number> max;
    std::optional<Number> initial; ///< the attribute `default`
    bool nonfinite = false;        ///< NaN and infinities are values, not errors

    bool hasFixedSize() const { return shape != FieldShape::Sequence && type != FieldType::String && type != FieldType::Bytes; }
    std::size_t minimumSize() const; ///< on the wire, in bytes
    std::size_t maximumSize() const; ///< on the wire, in bytes
};

namespace protocol {
class WireLayout;
}

/// The library's compiled form of a definition's fields. A copy of a definition begins without it, since its fields may be changed.
class CompiledLayout {
public:
    CompiledLayout() = default;
    explicit CompiledLayout(std::shared_ptr<const protocol::WireLayout> layout) : m_layout(std::move(layout)) {}
    CompiledLayout(const CompiledLayout& /*other*/) noexcept {}
    CompiledLayout(CompiledLayout&&) noexcept = default;
    CompiledLayout& operator=(const CompiledLayout& /*other*/) noexcept
    {
        m_layout.reset();
        return *this;
    }
    CompiledLayout& operator=(CompiledLayout&&) noexcept = default;
    ~CompiledLayout() = default;

    /// Null unless the definition is that of a set that was read.
    const protocol::WireLayout* get() const { return m_layout.get(); }

private:
    std::shared_ptr<const protocol::WireLayout> m_layout; ///< one owner; shared only because the type is not known here
};

enum class Role : std::uint8_t { Command, Report };

/// In the order in which they are sent: strict between classes, fair within one. Session management ranks with Safety.
enum class Priority : std::uint8_t { Safety, Control, Status, Bulk };

enum class Path : std::uint8_t { Stream, Datagram };

std::string_view toString(Role role);
std::string_view toString(Priority priority);

struct MessageDefinition {
    std::uint16_t number = 0;
    std::string name;
    std::string title;
    std::string description;
    Role role = Role::Report;
    Priority priority = Priority::Status;
    bool allowedInStandBy = true;
    std::optional<std::chrono::nanoseconds> period;   ///< expected from one to the next; for planning
    std::optional<std::chrono::nanoseconds> deadline; ///< a longer gap is told to the receiver's application (DeadlineMissed)
    std::optional<std::chrono::nanoseconds> lifespan; ///< an older one is neither sent nor, once the clock offset is known, delivered
    std::optional<std::chrono::nanoseconds> maxAge;   ///< control only; absent: the link's `lost`
    std::uint32_t history = 0;                        ///< undelivered messages a queue keeps; 0: up to the queue's bound
    Path path = Path::Stream;                         ///< Datagram: by UDP while packets pass, else on lane 0
    std::vector<FieldDefinition> fields;
    CompiledLayout layout;

    /// Bytes of the safety record before the fields: 16 for control messages, else 0.
    std::size_t recordSize() const { return priority == Priority::Control ? 16 : 0; }

    /// Largest information part on the wire in bytes, with the safety record.
    std::size_t maximumSize() const;

    /// Position in `fields`, or nothing.
    std::optional<std::size_t> indexOf(std::string_view field) const;
};

/// Immutable once read; shared by every message of its device type.
class MessageSet {
public:
    /// Reads and checks a whole file; every error and warning is added to `findings` with its place in `file`.
    /// The result is an error (MessageSetInvalid or XmlInvalid) when there is at least one finding of severity Error;
    /// FileUnreadable from load() when there is nothing to read.
    static Result<std::shared_ptr<const MessageSet>> parse(std::string_view xml, const std::string& file, Findings* findings = nullptr);
    static Result<std::shared_ptr<const MessageSet>> load(const std::filesystem::path& file, Findings* findings = nullptr);

    const std::string& name() const { return m_name; }
    const std::string& version() const { return m_version; }
    const std::string& vendor() const { return m_vendor; }
    const std::string& title() const { return m_title; }
    const std::string& description() const { return m_description; }

    /// The id of this type's devices, with index 0.
    DeviceId deviceType() const { return m_deviceType; }

    /// Of the file's bytes as they are: the set's identity.
    const Sha256& hash() const { return m_hash; }

    /// The file's bytes as they are.
    const std::string& xml() const { return m_xml; }

    const std::vector<std::shared_ptr<const EnumDefinition>>& enums() const { return m_enums; }

    /// In ascending order of their numbers.
    const std::vector<MessageDefinition>& messages() const { return m_messages; }

    // Null when there is none; valid as long as the set.
    const MessageDefinition* find(std::uint16_t number) const;
    const MessageDefinition* find(std::string_view name) const;

private:
    friend class MessageSetReader;
    MessageSet() = default;

    std::string m_name;
    std::string m_version;
    std::string m_vendor;
    std::string m_title;
    std::string m_description;
    DeviceId m_deviceType;
    Sha256 m_hash;
    std::string m_xml;
    std::vector<std::shared_ptr<const EnumDefinition>> m_enums;
    std::vector<MessageDefinition> m_messages;
};

} // namespace liena
