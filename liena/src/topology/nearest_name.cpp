// Edit distance between names, where swapping two neighbours is one slip.
#include "topology/nearest_name.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace liena {

namespace {

constexpr std::size_t longestCompared = 64;
constexpr std::size_t mostCandidates = 256;
constexpr std::size_t mostListed = 8;

char folded(char c)
{
    if (c == '_')
        return '-';
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

std::size_t distance(std::string_view a, std::string_view b)
{
    std::array<std::array<std::size_t, longestCompared + 1>, 3> rows{};
    for (std::size_t j = 0; j <= b.size(); ++j)
        rows[0][j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        auto& row = rows[i % 3];
        const auto& above = rows[(i + 2) % 3];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t change = folded(a[i - 1]) == folded(b[j - 1]) ? 0 : 1;
            row[j] = std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + change});
            if (i > 1 && j > 1 && folded(a[i - 1]) == folded(b[j - 2]) && folded(a[i - 2]) == folded(b[j - 1]))
                row[j] = std::min(row[j], rows[(i + 1) % 3][j - 2] + 1);
        }
    }
    return rows[a.size() % 3][b.size()];
}

} // namespace

std::string_view nearestName(std::string_view name, const std::vector<std::string_view>& known)
{
    if (name.empty() || name.size() > longestCompared)
        return {};
    std::string_view nearest;
    std::size_t least = std::min<std::size_t>(2, (name.size() - 1) / 2) + 1;
    for (std::size_t i = 0; i < std::min(known.size(), mostCandidates); ++i) {
        const auto candidate = known[i];
        const auto difference = std::max(candidate.size(), name.size()) - std::min(candidate.size(), name.size());
        if (candidate.size() > longestCompared || difference >= least)
            continue;
        const auto apart = distance(name, candidate);
        if (apart < least) {
            least = apart;
            nearest = candidate;
        }
    }
    return nearest;
}

std::string enumeration(const std::vector<std::string_view>& names)
{
    std::string text;
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (i > 0)
            text += i + 1 == names.size() ? " or " : ", ";
        text += names[i];
    }
    return text;
}

std::string suggestion(std::string_view name, const std::vector<std::string_view>& known)
{
    const auto nearest = nearestName(name, known);
    if (!nearest.empty())
        return "did you mean '" + std::string(nearest) + "'?";
    return known.empty() || known.size() > mostListed ? std::string() : "known here: " + enumeration(known);
}

} // namespace liena
