// Reading resources/devices.
#include "message_sets.hpp"

#include <cstdio>
#include <cstdlib>

namespace liena::simulation {

namespace {

std::shared_ptr<const MessageSet> load(const char* name)
{
    auto set = MessageSet::load(std::string(LIENA_SOURCE_DIR "/resources/devices/") + name + ".xml");
    if (!set) {
        std::fprintf(stderr, "simulation: %s; run it where the source tree is\n", set.error().what.c_str());
        std::exit(2);
    }
    return set.value();
}

} // namespace

std::shared_ptr<const MessageSet> messageSetOf(DeviceKind kind)
{
    static const std::array sets{load("vascular-robot"), load("siat-cockpit"), load("arm-grasper"), load("cbct-xray")};
    return sets[static_cast<std::size_t>(kind)];
}

} // namespace liena::simulation
