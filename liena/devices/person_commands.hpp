// The lines that the person at the patient's side may type.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace liena::devices {

enum class PersonAction : std::uint8_t { Open, ReOpen, Close, Dismiss, Status, EmergencyStop, ClearToArm, Wait };

struct PersonCommand {
    PersonAction action = PersonAction::Status;
    std::string device; ///< a name of the topology; may be empty for `dismiss`
    std::string reason; ///< for `dismiss` and `stop`
};

inline constexpr std::string_view personCommandHelp =
    "open NAME | reopen NAME | close NAME | dismiss [NAME [REASON]] | stop [REASON] | clear | wait | status";

/// Nothing when the line is none of them.
std::optional<PersonCommand> parsePersonCommand(std::string_view line);

} // namespace liena::devices
