// The characters of an XML file: UTF-8, what XML 1.0 allows, and how foreign text is shown to a person.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace liena {

inline constexpr char32_t invalidCodePoint = 0xFFFFFFFFU;

/// The code point that starts at `at`, which moves behind it; invalidCodePoint (and `at` one byte on) where the bytes are not UTF-8.
char32_t decodeUtf8(std::string_view text, std::size_t& at);

/// A character that XML 1.0 allows in a document.
bool isXmlCharacter(char32_t character);

bool isXmlSpace(char character);

/// Offset of the first byte that is not UTF-8 or not an XML character; npos when there is none.
std::size_t findInvalidCharacter(std::string_view text);

/// `'text'` for a sentence: at most 64 bytes of it; control and direction characters, which could forge a line, become `?`.
std::string inQuotes(std::string_view text);

/// Runs of white space become one space, and none at the ends.
std::string collapsed(std::string_view text);

} // namespace liena
