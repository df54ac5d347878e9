// One message: its meta-data and its fields, kept in the form in which they travel (protocol section 3).
#pragma once

#include "liena/device_id.hpp"
#include "liena/error.hpp"
#include "liena/field_slot.hpp"
#include "liena/message_id.hpp"
#include "liena/message_set.hpp"
#include "liena/timestamp.hpp"

#include <boost/container/small_vector.hpp>

#include <chrono>
#include <concepts>
#include <cstddef>
#include <initializer_list>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace liena {

namespace protocol {
class BoundMessage;
}

/// The encoded fields. Messages of the control path fit the inline part, so they need no allocation.
using FieldBytes = boost::container::small_vector<std::byte, 192>;

/// Bytes that are sent from where they lie. Whoever lends them does not change them as long as `owner` is held.
struct LentBytes {
    std::shared_ptr<const void> owner;
    std::span<const std::byte> bytes;
};

/// A value type; copying copies the fields, moving does not. Not for use by two threads at once.
///
/// A field is named by its name, or in hot loops by its position in `definition().fields`. A name that the definition does not have and a
/// type that does not fit are mistakes in the program: they throw std::logic_error. A *value* that the definition refuses (a number out of
/// bounds, a text too long) is remembered, and the send returns it as an Error.
class Message {
public:
    /// Every field at its default; without one at zero, or at the bound next to zero; enums at their first value.
    Message(std::shared_ptr<const MessageSet> set, const MessageDefinition& definition);

    const MessageDefinition& definition() const { return *m_definition; }
    const MessageSet& messageSet() const { return *m_set; }
    const std::string& name() const { return m_definition->name; }

    // Meta-data: written by the library when it sends or receives.
    DeviceId origin() const { return m_origin; }
    DeviceId target() const { return m_target; }
    Timestamp timestamp() const { return m_timestamp; }
    MessageId id() const { return {m_origin, m_definition->number}; }

    /// When the last byte arrived here, on the monotonic clock; the epoch for a message that was not received.
    std::chrono::steady_clock::time_point arrival() const { return m_arrival; }

    /// Age at arrival by both clocks (arrival − (timestamp − offset), the offset being the peer's clock − ours); nothing while the clock
    /// offset is unknown.
    std::optional<std::chrono::nanoseconds> latency() const { return m_latency; }

    /// T: bool, an integer, a floating-point type, std::string_view (String fields, and the name of an enum's value),
    /// std::span<const std::byte> (Bytes fields), std::vector<double> (arrays and sequences). Texts and spans are valid while the message
    /// lives unchanged. An integer is converted unchecked: one that is too narrow for the field cuts, one of the other sign wraps. An
    /// integer of a floating-point field is a mistake; a floating-point T reads every number.
    template <typename T>
    T get(std::string_view field) const
    {
        return get<T>(position(field));
    }

    template <typename T>
    T get(std::size_t field) const
    {
        if constexpr (std::floating_point<T>)
            return real<T>(field);
        else if constexpr (std::is_enum_v<T> || std::integral<T>)
            return whole<T>(field);
        else if constexpr (std::same_as<T, std::string_view> || std::same_as<T, std::string>)
            return T(textAt(field));
        else if constexpr (std::same_as<T, std::span<const std::byte>>)
            return bytesAt(field);
        else {
            static_assert(std::same_as<T, std::vector<double>>, "a field cannot be read as this type");
            return realsAt(field);
        }
    }

    /// Chainable: `message.set("engaged", true).set("guidewire_velocity", 2.5)`.
    template <typename T>
    Message& set(std::string_view field, const T& value)
    {
        return set(position(field), value);
    }

    template <typename T>
    Message& set(std::size_t field, const T& value)
    {
        if constexpr (std::floating_point<T>)
            setReal(field, static_cast<std::conditional_t<std::same_as<T, float>, float, double>>(value));
        else if constexpr (std::is_enum_v<T> || std::integral<T>)
            setWhole(field, value);
        else if constexpr (std::convertible_to<const T&, std::string_view>)
            assignText(field, value);
        else if constexpr (std::convertible_to<const T&, std::span<const std::byte>>)
            assignBytes(field, value);
        else {
            static_assert(std::convertible_to<const T&, std::span<const double>>, "a field cannot hold this type");
            assignReals(field, value);
        }
        return *this;
    }

    /// Sets a String field to words for people, on which it must not depend whether the message leaves: what is no UTF-8 or would break a
    /// line is escaped, and what does not fit is cut at a character, with "…" behind it. Never refused.
    Message& setPrintable(std::string_view field, std::string_view words) { return setPrintable(position(field), words); }
    Message& setPrintable(std::size_t field, std::string_view words);

    /// Sets a Bytes field as set() does, without copying an image: it is sent from where it lies. `owner` keeps the bytes, which must not
    /// change until it is let go: when they have left or never will, by the network thread, or by whoever was refused or calls stop(). Only
    /// the last field can be lent to. What is short, and what does not travel as `bulk`, is copied, and `owner` let go at once.
    Message& lend(std::string_view field, std::shared_ptr<const void> owner, std::span<const std::byte> bytes)
    {
        return lend(position(field), std::move(owner), bytes);
    }
    Message& lend(std::size_t field, std::shared_ptr<const void> owner, std::span<const std::byte> bytes);

    /// The first value that the definition refused, if any: message, field, value and bounds.
    const std::optional<Error>& fault() const { return m_fault; }

    /// The encoded fields in wire form, without the safety record; what was lent comes behind them.
    std::span<const std::byte> fieldBytes() const { return {m_fields.data(), m_fields.size()}; }
    std::span<const std::byte> lentBytes() const { return m_lent ? m_lent->bytes : std::span<const std::byte>(); }

    /// Bytes of both.
    std::size_t encodedSize() const { return m_fields.size() + lentBytes().size(); }

    /// `MotionCommand permit=4 engaged=true …`, for logs and for the tool; long values are cut.
    std::string toString() const;

private:
    friend class MessageAccess;
    friend class protocol::BoundMessage;
    Message(std::shared_ptr<const MessageSet> set, const MessageDefinition& definition, FieldBytes&& fields);

    // Most numbers stand at places that are known beforehand: those are read and written here, all else behind a call.
    const protocol::FieldSlot* slot(std::size_t field, protocol::SlotKind kind) const
    {
        return field < m_slots.size() && m_slots[field].kind == kind ? &m_slots[field] : nullptr;
    }

    template <typename T>
    T real(std::size_t field) const
    {
        using protocol::SlotKind;
        if (const auto* at = slot(field, SlotKind::Real32))
            return static_cast<T>(protocol::load<float>(m_fields.data() + at->offset));
        if (const auto* at = slot(field, SlotKind::Real64))
            return static_cast<T>(protocol::load<double>(m_fields.data() + at->offset));
        return static_cast<T>(realAt(field));
    }

    template <typename T>
    T whole(std::size_t field) const
    {
        if (const auto* at = slot(field, protocol::wholeKind(sizeof(T))))
            return protocol::loadWhole<T>(m_fields.data() + at->offset);
        return static_cast<T>(unsignedAt(field));
    }

    template <typename T>
    void setReal(std::size_t field, T value)
    {
        using protocol::SlotKind;
        const auto wide = static_cast<double>(value);
        if (const auto* at = slot(field, SlotKind::Real64); at != nullptr && at->allows(wide))
            return protocol::store(m_fields.data() + at->offset, wide);
        const auto narrow = static_cast<float>(value);
        if (const auto* at = slot(field, SlotKind::Real32); at != nullptr && at->allows(narrow))
            return protocol::store(m_fields.data() + at->offset, narrow);
        assign(field, Number(wide));
    }

    template <typename T>
    void setWhole(std::size_t field, T value)
    {
        const auto wide = static_cast<std::int64_t>(value);
        const bool wraps = sizeof(T) == sizeof(wide) && !protocol::isSignedWhole<T> && wide < 0;
        if (const auto* at = slot(field, protocol::wholeKind(sizeof(T))); at != nullptr && !wraps && at->allows(wide))
            return protocol::store(m_fields.data() + at->offset, value);
        if constexpr (std::unsigned_integral<T>)
            assign(field, Number(static_cast<std::uint64_t>(value)));
        else
            assign(field, Number(wide));
    }

    void refuse(std::string why);
    std::size_t position(std::string_view field) const;
    const std::byte* numberAt(std::size_t field) const;
    std::uint64_t unsignedAt(std::size_t field) const;
    double realAt(std::size_t field) const;
    std::string_view textAt(std::size_t field) const;
    std::span<const std::byte> bytesAt(std::size_t field) const;
    std::vector<double> realsAt(std::size_t field) const;
    void assign(std::size_t field, const Number& value);
    void assignText(std::size_t field, std::string_view value);
    void assignBytes(std::size_t field, std::span<const std::byte> value);
    void assignReals(std::size_t field, std::span<const double> value);
    void writeLength(std::size_t length);

    std::shared_ptr<const MessageSet> m_set;
    const MessageDefinition* m_definition; ///< inside *m_set
    const protocol::WireLayout* m_layout;  ///< that of the definition
    std::span<const protocol::FieldSlot> m_slots;
    DeviceId m_origin;
    DeviceId m_target;
    Timestamp m_timestamp;
    std::chrono::steady_clock::time_point m_arrival;
    std::optional<std::chrono::nanoseconds> m_latency;
    FieldBytes m_fields;
    std::shared_ptr<const LentBytes> m_lent; ///< the content of the last field, whose length is in m_fields
    std::optional<Error> m_fault;
};

} // namespace liena
