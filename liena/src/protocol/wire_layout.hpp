// How the messages of one definition stand on the wire and what their values may be, compiled once when the set is read.
#pragma once

#include "liena/field_slot.hpp"
#include "liena/message_set.hpp"
#include "protocol/range_check.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace liena::protocol {

/// Where one field stands in a message's bytes.
struct FieldSpan {
    std::size_t begin = 0;
    std::size_t size = 0;
};

/// Immutable; holds nothing of the definition that it was made of.
class WireLayout {
public:
    explicit WireLayout(const MessageDefinition& definition);

    /// One for each field, in order.
    std::span<const FieldSlot> slots() const { return m_slots; }

    /// Most bytes of all fields together.
    std::size_t maximumSize() const { return m_maximum; }

    /// The fields of a message at its defaults.
    std::span<const std::byte> defaults() const { return m_defaults; }

    /// True only if the bytes are what the definition allows. False, they may be so all the same, and are to be asked about in full.
    bool accepts(std::span<const std::byte> bytes) const;

    /// Where field `index` stands in `bytes`, which must be well formed up to it.
    FieldSpan locate(std::span<const std::byte> bytes, std::size_t index) const;

    /// Position of a field of the definition that this was made of, or nothing.
    std::optional<std::size_t> indexOf(const MessageDefinition& definition, std::string_view field) const;

private:
    /// A number with bounds, as the loops want it.
    struct Bounded {
        std::uint32_t offset = 0;
        BoundBytes low{};
        BoundBytes high{};
    };

    /// What is less common: long arrays, and the checks that are more than two comparisons.
    struct Run {
        std::size_t offset = 0;
        std::size_t count = 0;
        RangeCheck check;
    };

    /// A field of varying size: a length, then so many elements.
    struct Tail {
        std::size_t lengthSize = 0; ///< 0: there is none
        std::size_t elementSize = 1;
        std::size_t most = 0;
        bool isText = false;
        RangeCheck check;
    };

    /// Fields of fixed size, and the field of varying size that ends them.
    struct Block {
        static constexpr std::size_t kinds = 6; ///< Whole8 to Real64

        std::size_t size = 0;
        std::vector<Bounded> bounded;          ///< by their kinds
        std::array<std::size_t, kinds> ends{}; ///< of each kind in `bounded`
        std::vector<Run> runs;
        Tail tail;
    };

    struct Place {
        std::size_t block = 0;
        std::size_t offset = 0;
        std::size_t size = 0;
        bool isTail = false; ///< its size stands in the message
    };

    void addFixed(const FieldDefinition& field);
    void addTail(const FieldDefinition& field);
    void addCheck(const FieldDefinition& field);
    void addName(std::string_view name, std::size_t index);

    template <typename T>
    static bool areWithin(const Block& block, RangeCheck::Kind kind, const std::byte* bytes);
    static bool holds(const Block& block, const std::byte* bytes);
    static bool takeTail(const Tail& tail, std::span<const std::byte>& bytes);
    static std::size_t sizeOfTail(const Tail& tail, const std::byte* bytes);

    std::size_t m_maximum = 0;
    std::vector<FieldSlot> m_slots;
    std::vector<Place> m_places;
    std::vector<Block> m_blocks;
    std::vector<std::byte> m_defaults;
    std::vector<std::uint32_t> m_names; ///< open addressing by the hash of the name: position + 1, or 0 where there is none
};

} // namespace liena::protocol
