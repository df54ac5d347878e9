// Reading the order, and making a plan of it.
#include "system/measure_order.hpp"

#include "protocol/session_messages.hpp"

#include <algorithm>
#include <charconv>

namespace liena::system {

namespace {

std::string_view takeWord(std::string_view& line)
{
    const auto word = line.substr(0, line.find(' '));
    line.remove_prefix(std::min(line.size(), word.size() + 1));
    return word;
}

template <typename T>
bool read(std::string_view word, T least, T most, T& value)
{
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    return error == std::errc() && end == word.data() + word.size() && value >= least && value <= most;
}

} // namespace

Result<MeasureOrder> MeasureOrder::parse(std::string_view line)
{
    constexpr std::uint32_t mostSeconds = 600;
    constexpr double mostCommands = 10000;
    constexpr double mostImages = 1000;
    MeasureOrder order;
    const bool endsInBlank = line.ends_with(' '); // a word after it would be missing
    const bool measure = takeWord(line) == "measure";
    const auto peer = DeviceId::fromString(takeWord(line));
    const bool inBounds = read(takeWord(line), 1U, mostSeconds, order.seconds) &&
                          read(takeWord(line), 1.0, mostCommands, order.commandsPerSecond) &&
                          read(takeWord(line), 0U, static_cast<std::uint32_t>(protocol::maximumPromptPadding), order.commandBytes) &&
                          read(takeWord(line), 0.0, mostImages, order.imagesPerSecond) &&
                          read(takeWord(line), 1U, static_cast<std::uint32_t>(protocol::maximumProbePadding), order.imageBytes);
    if (endsInBlank || !measure || !peer || !inBounds || !line.empty())
        return fail(Errc::InvalidArgument,
                    "this device takes `measure PEER SECONDS COMMANDS COMMAND-BYTES IMAGES IMAGE-BYTES`, within their bounds");
    order.peer = *peer;
    return order;
}

MeasurementPlan MeasureOrder::plan() const
{
    const std::chrono::seconds whole(seconds);
    const ProbeStream commands{commandsPerSecond, 0, commandBytes};
    const auto& packets = commands; // the two share what is granted in equal parts: with fewer, the commands would be slowed
    return {{"paced", whole, commands, packets, {}}, {"beside-images", whole, commands, packets, {imagesPerSecond, 0, imageBytes}}};
}

} // namespace liena::system
