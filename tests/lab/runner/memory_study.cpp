// What an idle session costs in memory.
#include "runner/studies.hpp"

#include "runner/many.hpp"
#include "runner/process_facts.hpp"

#include <cstdio>

namespace liena::lab {

bool studyMemory(const StudyOptions& options)
{
    constexpr std::size_t devices = 8;
    constexpr double aim = 256; // KiB
    auto plan = plans::star(devices);
    plan.flags = {"--quiet"};
    Rig rig(std::move(plan), {options.seed, options.ordinary, options.keep});
    rig.startAll();
    const auto hub = rig["cockpit"].process->id();
    std::printf("\nMemory of a process with idle TLS sessions (all of its resident set; and what it allocated)\n");
    std::vector<double> resident;
    for (std::size_t sessions = 0; sessions < devices; ++sessions) {
        if (sessions > 0) {
            const auto& peer = rig.devices()[sessions]->name;
            rig.say("cockpit", "open " + peer);
            if (!rig.until([&] { return isOpen(rig, "cockpit " + peer); }, Milliseconds(5000))) {
                std::printf("    BROKEN: the session with %s did not open\n", peer.c_str());
                return false;
            }
        }
        rig.settle(Milliseconds(2000));
        resident.push_back(static_cast<double>(residentKiB(hub)));
        std::printf("  %zu sessions: %6.0f KiB resident, %6llu KiB allocated, %zu descriptors\n", sessions, resident.back(),
                    static_cast<unsigned long long>(anonymousKiB(hub)), countDescriptors(hub));
    }
    const double more = (resident.back() - resident[1]) / static_cast<double>(devices - 2);
    std::printf(
        "  the first costs %.0f KiB with all code and tables it is the first to touch, each further one %.0f KiB (aim: at most %.0f)\n",
        resident[1] - resident[0], more, aim);
    std::fflush(stdout);
    return true;
}

} // namespace liena::lab
