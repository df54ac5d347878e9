// A system of several devices in which persons open links.
#pragma once

#include "runner/rig.hpp"

#include <string>
#include <utility>
#include <vector>

namespace liena::lab {

/// The ends of a link as the topology writes it.
std::pair<std::string, std::string> endsOf(const std::string& link);

bool isOpen(Rig& rig, const std::string& link);

/// The person at the first end of each link opens or re-opens until all are open; throws std::runtime_error when they do not.
void openLinks(Rig& rig, const std::vector<std::string>& links);
void openEveryLink(Rig& rig);

} // namespace liena::lab
