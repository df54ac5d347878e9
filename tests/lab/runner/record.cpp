// One line of a device's log: implementation.
#include "runner/record.hpp"

#include <charconv>
#include <chrono>

namespace liena::lab {

const std::string& Record::word(std::size_t index) const
{
    static const std::string none;
    return index < words.size() ? words[index] : none;
}

std::uint64_t Record::number(std::size_t index) const
{
    std::uint64_t value = 0;
    const auto& text = word(index);
    std::from_chars(text.data(), text.data() + text.size(), value);
    return value;
}

Record parseRecord(std::string_view line)
{
    Record record;
    const auto [end, failure] = std::from_chars(line.data(), line.data() + line.size(), record.at);
    if (failure != std::errc{} || end == line.data() + line.size())
        return {nowNs(), {"unreadable", std::string(line)}};
    auto rest = line.substr(static_cast<std::size_t>(end - line.data()));
    for (auto start = rest.find_first_not_of(' '); start != std::string_view::npos; start = rest.find_first_not_of(' ')) {
        const auto length = std::min(rest.find(' ', start), rest.size()) - start;
        record.words.emplace_back(rest.substr(start, length));
        rest.remove_prefix(start + length);
    }
    if (record.words.empty())
        record.words = {"unreadable"};
    return record;
}

std::int64_t nowNs() { return std::chrono::steady_clock::now().time_since_epoch().count(); }

} // namespace liena::lab
