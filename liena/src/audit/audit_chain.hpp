// The hash chain of the audit file: lines from entries, and entries from lines.
#pragma once

#include "liena/hash.hpp"

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace liena::audit {

/// One thing that happened. Texts are cut and escaped when they are written; empty ones are left out.
struct Entry {
    std::string event{};        ///< as `session-opened`
    std::string peer{};         ///< the other device's name
    std::string who{};          ///< who decided it, when a person or another device did
    std::uint64_t incident = 0; ///< 0: none
    std::string text{};
    bool byApplication = false; ///< the application told it, not the library
    bool often = false;         ///< the same again within a minute is counted and not written
    std::uint64_t bytes = 0;    ///< of a damaged line before this one
    std::string damaged{};      ///< SHA-256 of that line, hex
    std::chrono::system_clock::time_point when{};
};

inline constexpr std::size_t longestLine = 4096;

/// Lines are `{"n":1,…,"hash":"…"}`; the hash is SHA-256 over the hex hash of the line before (64 zeros at the beginning) and the line's
/// own text up to and without `,"hash"`.
class AuditChain {
public:
    AuditChain() = default;
    AuditChain(std::uint64_t entries, const Sha256& head) : m_entries(entries), m_head(head) {}

    /// The next line, without its end. Nothing changes before accept().
    std::string line(const Entry& entry, std::string_view device) const;

    /// The line was written.
    void accept(std::string_view line);

    std::uint64_t entries() const { return m_entries; }
    const Sha256& head() const { return m_head; }

    /// The hash that a line with that text has behind `previous`.
    static Sha256 hashOf(const Sha256& previous, std::string_view body);

private:
    std::uint64_t m_entries = 0;
    Sha256 m_head;
};

/// A line taken apart; nothing when it does not have the form of one. Whether its hash is right is not asked.
struct ParsedLine {
    std::uint64_t number = 0;
    std::string_view body; ///< what the hash covers of this line
    Sha256 hash;
    std::string_view event;
    std::string_view damaged;
    std::uint64_t bytes = 0;
};
std::optional<ParsedLine> parseLine(std::string_view line);

} // namespace liena::audit
