// Reading profiles: a line is a word, its values and their units; # begins a comment.
#include "line_profile.hpp"

#include <liena/log.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <vector>

namespace liena::tools {

namespace {

constexpr std::size_t longestFile = 65536;
constexpr std::uint32_t largestImage = 8U << 20U;

/// As the options of the same names take them, and what a running device is asked with --live.
struct RateBounds {
    double least;
    double most;
};
constexpr RateBounds commandBounds{1, 10000};
constexpr RateBounds frameBounds{0.1, 1000};

using Words = std::vector<std::string_view>;

Words wordsOf(std::string_view line)
{
    line = line.substr(0, line.find('#'));
    constexpr std::string_view blanks = " \t\r";
    Words words;
    for (auto begin = line.find_first_not_of(blanks); begin != std::string_view::npos; begin = line.find_first_not_of(blanks)) {
        line.remove_prefix(begin);
        words.push_back(line.substr(0, line.find_first_of(blanks)));
        line.remove_prefix(words.back().size());
    }
    return words;
}

std::optional<double> numberFrom(std::string_view text)
{
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool whole = error == std::errc() && end == text.data() + text.size();
    return whole && std::isfinite(value) && value >= 0 ? std::optional(value) : std::nullopt;
}

std::string knownFigures()
{
    std::string list;
    for (const auto& kind : figureKinds)
        list += (list.empty() ? "" : ", ") + std::string(kind.name);
    return list;
}

/// Nothing when the line was understood; else what to write.
std::optional<std::string> takeRate(const Words& words, RateBounds bounds, double& rate)
{
    const auto value = words.size() == 3 && words[2] == "/s" ? numberFrom(words[1]) : std::nullopt;
    if (!value || *value < bounds.least || *value > bounds.most)
        return fmt::format("write `{} 15 /s`: a rate from {:g} to {:g}", words[0], bounds.least, bounds.most);
    rate = *value;
    return std::nullopt;
}

std::optional<std::string> takeImage(const Words& words, LineProfile& profile)
{
    const auto bytes = words.size() == 2   ? imageBytesFrom(words[1])
                       : words.size() == 3 ? imageBytesFrom(fmt::format("{} {}", words[1], words[2]))
                                           : std::nullopt;
    if (!bytes)
        return std::string("write `image 1.5 MiB` or `image 512 KiB`, at most 8 MiB");
    profile.imageBytes = *bytes;
    return std::nullopt;
}

std::optional<std::string> takeLimits(const Words& words, LineProfile& profile)
{
    const auto kind = std::find_if(figureKinds.begin(), figureKinds.end(), [&](const auto& known) { return known.name == words[0]; });
    if (kind == figureKinds.end())
        return fmt::format("{} is nothing that a profile knows; it knows title, commands, frames, image, {}", printable(words[0]),
                           knownFigures());
    const auto example = fmt::format("write `{} {} {} {} {}`: the limit for go, then that for caution", kind->name,
                                     kind->leastWanted ? 20 : 10, kind->unit, kind->leastWanted ? 10 : 20, kind->unit);
    if (words.size() != 5 || words[2] != kind->unit || words[4] != kind->unit)
        return example;
    const auto go = numberFrom(words[1]);
    const auto caution = numberFrom(words[3]);
    if (!go || !caution)
        return example;
    if (kind->leastWanted ? *caution > *go : *caution < *go)
        return fmt::format("the limit for caution is {} than that for go: exchange them", kind->leastWanted ? "greater" : "less");
    if (!profile.limits.emplace(kind->figure, FigureLimits{*go, *caution}).second)
        return fmt::format("{} is there twice; remove one", kind->name);
    return std::nullopt;
}

std::optional<std::string> takeLine(const Words& words, LineProfile& profile)
{
    if (words[0] == "commands")
        return takeRate(words, commandBounds, profile.commandsPerSecond);
    if (words[0] == "frames")
        return takeRate(words, frameBounds, profile.framesPerSecond);
    if (words[0] == "image")
        return takeImage(words, profile);
    if (words[0] != "title")
        return takeLimits(words, profile);
    if (words.size() < 2)
        return std::string("write `title` and some words: what the procedure is");
    const auto end = words.back().data() + words.back().size();
    profile.title = printable(std::string_view(words[1].data(), static_cast<std::size_t>(end - words[1].data())), 128);
    return std::nullopt;
}

Result<std::string> contentOf(const std::filesystem::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    std::string text(longestFile + 1, '\0');
    stream.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(stream.gcount()));
    if (text.empty())
        return fail(Errc::FileUnreadable,
                    fmt::format("{}: no profile can be read there; check the name and who may read it", file.string()));
    if (text.size() > longestFile)
        return fail(Errc::FileUnreadable, fmt::format("{}: a profile has at most {} bytes", file.string(), longestFile));
    return text;
}

} // namespace

const FigureKind& kindOf(Figure figure) { return figureKinds[static_cast<std::size_t>(figure)]; }

std::optional<std::uint32_t> imageBytesFrom(std::string_view text)
{
    double factor = 1;
    for (const auto& [unit, size] : {std::pair(std::string_view("KiB"), 1024.0), std::pair(std::string_view("MiB"), 1024.0 * 1024)})
        if (text.ends_with(unit)) {
            text.remove_suffix(unit.size());
            factor = size;
        }
    while (text.ends_with(' '))
        text.remove_suffix(1);
    const auto value = numberFrom(text);
    const double bytes = value.value_or(0) * factor;
    return bytes >= 1 && bytes <= largestImage ? std::optional(static_cast<std::uint32_t>(bytes)) : std::nullopt;
}

Result<LineProfile> LineProfile::parse(std::string_view text, const std::string& file)
{
    LineProfile profile;
    profile.name = std::filesystem::path(file).stem().string();
    for (int number = 1; !text.empty(); ++number) {
        const auto line = text.substr(0, text.find('\n'));
        text.remove_prefix(std::min(text.size(), line.size() + 1));
        const auto words = wordsOf(line);
        if (words.empty())
            continue;
        if (const auto wrong = takeLine(words, profile))
            return fail(Errc::InvalidArgument, fmt::format("{}:{}: {}", file, number, *wrong));
    }
    if (profile.limits.empty())
        return fail(Errc::InvalidArgument, fmt::format("{}: a profile has a limit at least; it knows {}", file, knownFigures()));
    return profile;
}

Result<LineProfile> LineProfile::load(const std::string& nameOrFile)
{
    std::filesystem::path file(nameOrFile);
    if (nameOrFile.find('/') == std::string::npos && !file.has_extension()) {
        std::string tried;
        for (const std::filesystem::path folder : {"resources/profiles", LIENA_PROFILE_DIR}) {
            file = folder / (nameOrFile + ".profile");
            if (std::error_code none; std::filesystem::exists(file, none))
                break;
            tried += (tried.empty() ? "" : " and ") + folder.string();
            file.clear();
        }
        if (file.empty())
            return fail(Errc::FileUnreadable,
                        fmt::format("no profile {} in {}; name one of vascular-robot, telesurgery and observation, or a file",
                                    printable(nameOrFile), tried));
    }
    const auto text = contentOf(file);
    if (!text)
        return text.as_failure();
    return parse(text.value(), file.string());
}

} // namespace liena::tools
