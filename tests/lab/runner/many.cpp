// A system of several devices in which persons open every link: implementation.
#include "runner/many.hpp"

#include <algorithm>
#include <stdexcept>

namespace liena::lab {

std::pair<std::string, std::string> endsOf(const std::string& link)
{
    const auto blank = link.find(' ');
    return {link.substr(0, blank), link.substr(blank + 1)};
}

bool isOpen(Rig& rig, const std::string& link)
{
    const auto [a, b] = endsOf(link);
    return rig[a].stateOf(b) == "open" && rig[b].stateOf(a) == "open";
}

void openEveryLink(Rig& rig) { openLinks(rig, rig.plan().links); }

void openLinks(Rig& rig, const std::vector<std::string>& links)
{
    constexpr int patience = 10;
    const auto allOpen = [&] { return std::all_of(links.begin(), links.end(), [&](const auto& link) { return isOpen(rig, link); }); };
    for (int press = 0; press < patience && !allOpen(); ++press) {
        for (const auto& link : links) {
            const auto [a, b] = endsOf(link);
            const auto& state = rig[a].stateOf(b);
            if (state == "stand-by" || state == "closed")
                rig.say(a, (state == "stand-by" ? "reopen " : "open ") + b);
        }
        (void)rig.until(allOpen, Milliseconds(2000));
    }
    if (allOpen())
        return;
    std::string closed;
    for (const auto& link : links)
        if (!isOpen(rig, link))
            closed += " " + link + ";";
    throw std::runtime_error("links that did not open:" + closed);
}

} // namespace liena::lab
