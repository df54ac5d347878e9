// The lines that the person at the patient's side may type: implementation.
#include "person_commands.hpp"

namespace liena::devices {

namespace {

constexpr std::string_view blanks = " \t\r\n";

std::string_view trimmed(std::string_view text)
{
    const auto start = text.find_first_not_of(blanks);
    if (start == std::string_view::npos)
        return {};
    return text.substr(start, text.find_last_not_of(blanks) - start + 1);
}

std::string_view takeWord(std::string_view& text)
{
    text = trimmed(text);
    const auto word = text.substr(0, text.find_first_of(blanks));
    text = trimmed(text.substr(word.size()));
    return word;
}

std::optional<PersonCommand> aboutDevice(PersonAction action, std::string_view rest)
{
    const auto device = takeWord(rest);
    if (device.empty() || !rest.empty())
        return std::nullopt;
    return PersonCommand{action, std::string(device), {}};
}

} // namespace

std::optional<PersonCommand> parsePersonCommand(std::string_view line)
{
    std::string_view rest = line;
    const auto verb = takeWord(rest);
    if (verb == "open")
        return aboutDevice(PersonAction::Open, rest);
    if (verb == "reopen")
        return aboutDevice(PersonAction::ReOpen, rest);
    if (verb == "close")
        return aboutDevice(PersonAction::Close, rest);
    if (verb == "dismiss") {
        const auto device = takeWord(rest);
        return PersonCommand{PersonAction::Dismiss, std::string(device), std::string(rest)};
    }
    if (verb == "stop")
        return PersonCommand{PersonAction::EmergencyStop, {}, std::string(rest)};
    if (rest.empty()) {
        if (verb == "status")
            return PersonCommand{PersonAction::Status, {}, {}};
        if (verb == "clear")
            return PersonCommand{PersonAction::ClearToArm, {}, {}};
        if (verb == "wait")
            return PersonCommand{PersonAction::Wait, {}, {}};
    }
    return std::nullopt;
}

} // namespace liena::devices
