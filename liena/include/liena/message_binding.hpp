// One structure of C++ for one message: names and types are compared once, then all fields are written or read without naming any.
#pragma once

#include "liena/bound_field.hpp"
#include "liena/error.hpp"
#include "liena/message.hpp"
#include "liena/message_set.hpp"

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstring>
#include <memory>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>

namespace liena {

namespace protocol {

/// The part of a binding that does not depend on the structure.
class BoundMessage {
public:
    /// Fills `places`, one for each of `members`.
    static Result<BoundMessage> to(std::shared_ptr<const MessageSet> set, std::string_view message, std::span<const MemberForm> members,
                                   std::span<FieldPlace> places);

    const MessageDefinition& definition() const { return *m_definition; }
    const std::shared_ptr<const MessageSet>& messageSet() const { return m_set; }

    /// Bytes of the fields where those of varying size are empty.
    std::size_t size() const { return m_defaults.size(); }
    std::span<const std::byte> defaults() const { return m_defaults; }

    /// Whether the message has no fields but the bound ones.
    bool isWhole() const { return m_isWhole; }

    /// Null unless the message is of this definition.
    const std::byte* fieldsOf(const Message& message) const { return fits(message) ? message.m_fields.data() : nullptr; }
    std::byte* fieldsOf(Message& message) const { return fits(message) ? message.m_fields.data() : nullptr; }

    std::optional<Error> faultIn(std::span<const std::byte> fields) const;

    /// Whether the definition allows the numbers of a bound field, one behind the other.
    bool allows(std::size_t field, std::span<const std::byte> numbers) const;

    /// Remembers in the message what is wrong with such numbers.
    void refuse(Message& message, std::size_t field, std::span<const std::byte> numbers) const;

    /// Remembers in the message that it is of another definition.
    void refuseStranger(Message& message) const;

private:
    BoundMessage(std::shared_ptr<const MessageSet> set, const MessageDefinition& definition, bool isWhole);

    /// One that was moved away has no fields.
    bool fits(const Message& message) const
    {
        return (message.m_layout == m_layout || isOfEqualSet(message)) && message.m_fields.size() >= m_defaults.size();
    }
    bool isOfEqualSet(const Message& message) const;
    std::optional<std::string> faultOf(std::size_t field, std::span<const std::byte> numbers) const;

    std::shared_ptr<const MessageSet> m_set;
    const MessageDefinition* m_definition; ///< inside *m_set
    const WireLayout* m_layout;            ///< that of the definition
    std::span<const std::byte> m_defaults; ///< of the layout
    bool m_isWhole;
};

} // namespace protocol

/// A field's name as an argument of a template.
template <std::size_t Size>
struct FieldName {
    consteval FieldName(const char (&name)[Size]) { std::copy_n(name, Size, text); } // implicit: Bind<"rate", …>
    constexpr std::string_view view() const { return {text, Size - 1}; }

    char text[Size]{};
};

/// A field and the member that holds it: a number, a bool, an enumeration, or a std::array of them for an array of fixed length.
template <FieldName Name, auto Member>
struct Bind;

template <FieldName Name, typename Structure, typename MemberType, MemberType Structure::*Member>
struct Bind<Name, Member> : protocol::BoundMember<MemberType> {
    static constexpr std::string_view name = Name.view();
    static constexpr auto member = Member;
    using Range = protocol::CertainRange<typename protocol::BoundMember<MemberType>::Number>;
};

/// Immutable; any thread may use it.
///
///     using StatusBinding = MessageBinding<Status, Bind<"permit", &Status::permit>, Bind<"rate", &Status::rate>>;
///     const auto binding = StatusBinding::to(set, "PumpStatus"); // once; an error names message, field and both types
///     binding.value().write(status, message);
///
/// Fields in front of the first of varying size can be bound: not String, Bytes and sequences, nor what stands behind one. Others are
/// set and read in the message as ever. An enumeration of C++ is told from others by its base alone, so its numbers are to be the set's.
template <typename T, typename... Fields>
class MessageBinding {
public:
    static_assert(sizeof...(Fields) > 0, "a binding has at least one field");
    static_assert(
        [] {
            std::array names{Fields::name...};
            std::sort(names.begin(), names.end());
            return std::adjacent_find(names.begin(), names.end()) == names.end();
        }(),
        "a field is bound twice");

    static Result<MessageBinding> to(std::shared_ptr<const MessageSet> set, std::string_view message)
    {
        static constexpr std::array members{
            protocol::MemberForm{Fields::name, protocol::fieldTypeFor<typename Fields::Number>(), Fields::isArray, Fields::count}...};
        std::array<protocol::FieldPlace, sizeof...(Fields)> places;
        auto bound = protocol::BoundMessage::to(std::move(set), message, members, places);
        if (!bound)
            return bound.as_failure();
        return MessageBinding(std::move(bound).value(), places);
    }

    const MessageDefinition& definition() const { return m_message.definition(); }
    const std::shared_ptr<const MessageSet>& messageSet() const { return m_message.messageSet(); }

    /// Bytes that encode() writes.
    std::size_t size() const { return m_message.size(); }

    /// Sets the bound fields as Message::set() does. False when the definition refuses a value, whose field then stays as it was, or when
    /// the message is of another definition and stays as a whole: the message has a fault then, and the send returns it.
    bool write(const T& from, Message& to) const
    {
        auto* bytes = m_message.fieldsOf(to);
        const auto values = valuesOf(from);
        if (bytes == nullptr || !m_isPacked || !areCertain(values, All()))
            return writeOneByOne(from, to, bytes, All());
        storePacked(values, bytes, All());
        return true;
    }

    /// False, and `to` as it was, when the message is of another definition.
    [[nodiscard]] bool read(const Message& from, T& to) const
    {
        const auto* bytes = m_message.fieldsOf(from);
        if (bytes == nullptr)
            return false;
        if (m_isPacked)
            giveAll(loadPacked(bytes, All()), to, All());
        else
            readOneByOne(bytes, to);
        return true;
    }

    /// The fields as they travel, those that are not bound at their defaults. False, and nothing written, when a value is refused or
    /// `fields` has not size() bytes.
    [[nodiscard]] bool encode(const T& from, std::span<std::byte> fields) const
    {
        const auto values = valuesOf(from);
        if (!isWholeIn(fields.size()) || !areCertain(values, All()))
            return encodeOneByOne(from, fields);
        storePacked(values, fields.data(), All());
        return true;
    }

    /// Checks every field of the message, also those that are not bound. False, and `to` as it was, when the bytes are not exactly what the
    /// definition allows; faultIn() then says why.
    [[nodiscard]] bool decode(std::span<const std::byte> fields, T& to) const
    {
        if (!isWholeIn(fields.size()))
            return decodeOneByOne(fields, to);
        const auto values = loadPacked(fields.data(), All()); // once: what is checked is what is taken
        if (!areCertain(values, All()))
            return decodeOneByOne(fields, to);
        giveAll(values, to, All());
        return true;
    }

    std::optional<Error> faultIn(std::span<const std::byte> fields) const { return m_message.faultIn(fields); }

private:
    using All = std::index_sequence_for<Fields...>;
    using Values = std::tuple<typename Fields::Values...>;
    using Places = std::array<std::size_t, sizeof...(Fields)>;

    /// Where the fields stand that are bound from the first on in the order of the wire: known to the compiler.
    static constexpr Places packedOffsets = [] {
        constexpr Places sizes{sizeof(typename Fields::Values)...};
        Places offsets{};
        std::exclusive_scan(sizes.begin(), sizes.end(), offsets.begin(), std::size_t{0});
        return offsets;
    }();

    template <std::size_t I>
    static constexpr bool isReal = std::same_as<std::tuple_element_t<I, Values>, float>;
    static constexpr auto reals = protocol::positionsOfReals<typename Fields::Values...>();
    using Reals = std::make_index_sequence<reals.size()>;

    using PlacesOfFields = std::array<protocol::FieldPlace, sizeof...(Fields)>;

    MessageBinding(protocol::BoundMessage&& message, const PlacesOfFields& places)
        : MessageBinding(std::move(message), places, All(), Reals())
    {}

    template <std::size_t... I, std::size_t... R>
    MessageBinding(protocol::BoundMessage&& message, const PlacesOfFields& places, std::index_sequence<I...> /*all*/,
                   std::index_sequence<R...> /*reals*/)
        : m_message(std::move(message)),
          m_ranges(typename Fields::Range(places[I])...),
          m_reals(std::array<protocol::FieldPlace, sizeof...(R)>{places[reals[R]]...}),
          m_offsets{places[I].offset...},
          m_indices{places[I].index...},
          m_isPacked(m_offsets == packedOffsets)
    {}

    /// Whether so many bytes are those of a message that is bound from its first field to its last.
    bool isWholeIn(std::size_t size) const { return m_isPacked && m_message.isWhole() && size == m_message.size(); }

    // What most messages of most programs need, at places that are known beforehand: without a call.

    [[gnu::always_inline]] static Values valuesOf(const T& from) { return Values(Fields::take(from.*Fields::member)...); }

    template <std::size_t... I>
    [[gnu::always_inline]] static void giveAll(const Values& values, T& to, std::index_sequence<I...> /*all*/)
    {
        (Fields::give(std::get<I>(values), to.*Fields::member), ...);
    }

    template <std::size_t... I>
    [[gnu::always_inline]] static Values loadPacked(const std::byte* bytes, std::index_sequence<I...> /*all*/)
    {
        return Values(protocol::load<typename Fields::Values>(bytes + packedOffsets[I])...);
    }

    template <std::size_t... I>
    [[gnu::always_inline]] static void storePacked(const Values& values, std::byte* bytes, std::index_sequence<I...> /*all*/)
    {
        (protocol::store(bytes + packedOffsets[I], std::get<I>(values)), ...);
    }

    template <std::size_t... I>
    [[gnu::always_inline]] bool areCertain(const Values& values, std::index_sequence<I...> /*all*/) const
    {
        return ((isReal<I> || isCertain<I>(values)) && ...) && areRealsCertain(values, Reals());
    }

    template <std::size_t... I>
    [[gnu::always_inline]] bool areRealsCertain(const Values& values, std::index_sequence<I...> /*reals*/) const
    {
        return m_reals.have(std::get<reals[I]>(values)...);
    }

    template <std::size_t I>
    [[gnu::always_inline]] bool isCertain(const Values& values) const
    {
        return std::tuple_element_t<I, std::tuple<Fields...>>::areWithin(std::get<I>(values), std::get<I>(m_ranges));
    }

    // All else, for which a call is no matter: it takes the values anew, so that above they need not stand in memory.

    template <std::size_t... I>
    [[gnu::noinline]] bool writeOneByOne(const T& from, Message& to, std::byte* bytes, std::index_sequence<I...> /*all*/) const
    {
        if (bytes == nullptr) {
            m_message.refuseStranger(to);
            return false;
        }
        const auto values = valuesOf(from);
        bool allWritten = true;
        ((allWritten &= writeOne<I>(values, to, bytes)), ...); // in order: the message keeps the first fault
        return allWritten;
    }

    template <std::size_t I>
    bool writeOne(const Values& values, Message& to, std::byte* bytes) const
    {
        const bool allowed = isAllowed<I>(values);
        if (allowed)
            protocol::store(bytes + m_offsets[I], std::get<I>(values));
        else
            m_message.refuse(to, m_indices[I], bytesOf<I>(values));
        return allowed;
    }

    [[gnu::noinline]] void readOneByOne(const std::byte* bytes, T& to) const { giveAll(loadAll(bytes, All()), to, All()); }

    [[gnu::noinline]] bool encodeOneByOne(const T& from, std::span<std::byte> fields) const
    {
        const auto values = valuesOf(from);
        if (fields.size() != m_message.size() || !areAllowed(values, All()))
            return false;
        std::memcpy(fields.data(), m_message.defaults().data(), fields.size());
        storeAll(values, fields.data(), All());
        return true;
    }

    [[gnu::noinline]] bool decodeOneByOne(std::span<const std::byte> fields, T& to) const
    {
        if (m_message.isWhole() ? fields.size() != m_message.size() : m_message.faultIn(fields).has_value())
            return false;
        const auto values = loadAll(fields.data(), All());
        if (!areAllowed(values, All()))
            return false;
        giveAll(values, to, All());
        return true;
    }

    template <std::size_t... I>
    Values loadAll(const std::byte* bytes, std::index_sequence<I...> /*all*/) const
    {
        return Values(protocol::load<typename Fields::Values>(bytes + m_offsets[I])...);
    }

    template <std::size_t... I>
    void storeAll(const Values& values, std::byte* bytes, std::index_sequence<I...> /*all*/) const
    {
        (protocol::store(bytes + m_offsets[I], std::get<I>(values)), ...);
    }

    template <std::size_t... I>
    bool areAllowed(const Values& values, std::index_sequence<I...> /*all*/) const
    {
        return (isAllowed<I>(values) && ...);
    }

    template <std::size_t I>
    bool isAllowed(const Values& values) const
    {
        return isCertain<I>(values) || m_message.allows(m_indices[I], bytesOf<I>(values));
    }

    template <std::size_t I>
    static std::span<const std::byte> bytesOf(const Values& values)
    {
        return std::as_bytes(std::span(&std::get<I>(values), 1));
    }

    protocol::BoundMessage m_message;
    std::tuple<typename Fields::Range...> m_ranges;
    protocol::CertainReals<reals.size()> m_reals;
    Places m_offsets; ///< in the fields' bytes
    Places m_indices; ///< in the definition
    bool m_isPacked;  ///< m_offsets are packedOffsets
};

} // namespace liena
