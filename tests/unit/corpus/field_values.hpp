// The fields of a session message, held against values as people write them.
#pragma once

#include "protocol/session_messages.hpp"
#include "support/hex.hpp"

#include <string>
#include <utility>
#include <vector>

namespace liena::test {

/// A visitor of a session message: takes one written value per field and notes the fields that differ.
class FieldComparison {
public:
    explicit FieldComparison(std::vector<std::pair<std::string, std::string>> written) : m_written(std::move(written)) {}

    template <typename T>
    requires std::is_arithmetic_v<T>
    void operator()(const T& value) { compare(std::to_string(value), number(firstWord(next()))); }
    void operator()(const bool& value) { compare(value ? "true" : "false", next()); }
    template <typename T>
    requires std::is_enum_v<T>
    void operator()(const T& value) { compare(std::to_string(static_cast<unsigned>(value)), number(firstWord(next()))); }
    void operator()(const DeviceId& value) { compare(value.toString(), firstWord(next())); }
    void operator()(const Sha256& value) { compare(value.toHex(), next()); }
    template <std::size_t Maximum>
    void operator()(const protocol::Text<Maximum>& value)
    {
        compare('"' + value.value + '"', next());
    }
    template <std::size_t Maximum>
    void operator()(const protocol::Bytes<Maximum>& bytes)
    {
        (*this)(bytes.value);
    }
    void operator()(const std::vector<std::byte>& value)
    {
        compare('"' + std::string(reinterpret_cast<const char*>(value.data()), value.size()) + '"', next());
    }

    /// What differs, and values that belong to no field; empty when all is as written.
    std::string differences() const
    {
        return m_next == m_written.size() ? m_differences : m_differences + " a field more is written: " + m_written[m_next].first;
    }

private:
    std::string next() { return m_next < m_written.size() ? m_written[m_next++].second : std::string(); }
    static std::string firstWord(const std::string& text) { return text.substr(0, text.find(' ')); }
    static std::string number(const std::string& text)
    {
        return text.empty() ? "nothing" : std::to_string(std::stoull(text, nullptr, text.starts_with("0x") ? 16 : 10));
    }

    void compare(const std::string& read, const std::string& written)
    {
        if (read != written)
            m_differences += " field " + std::to_string(m_next) + " is " + read + ", written is " + written + ";";
    }

    std::vector<std::pair<std::string, std::string>> m_written;
    std::size_t m_next = 0;
    std::string m_differences;
};

} // namespace liena::test
