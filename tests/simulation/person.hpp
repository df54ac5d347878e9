// The person beside one device: opens links, answers prompts in a manner of their own, and presses when it makes no sense.
#pragma once

#include "scenario.hpp"
#include "simulated_device.hpp"

#include <map>

namespace liena::simulation {

class Person {
public:
    Person(const DevicePlan& plan, SeededRandom random) : m_plan(plan), m_random(random) {}

    /// The program was started: what was on the screen is gone.
    void sitDown(SimulatedDevice& device);

    /// Chaos is over: answer every prompt at once.
    void becomePolite() { m_polite = true; }

    // At any moment, asked or not
    void pressReopen(HostIndex peer);
    void pressClose(HostIndex peer);
    void giveUp();
    void stopRobots();

private:
    struct Prompt {
        IncidentId shown = 0;
        bool standsBy = false;
        Instant answerAt;
        int answers = 0;
        Instant nextOpening;
        Instant unresolvedSince;
    };

    void think();
    void thinkOf(SimulatedModule& module, Prompt& prompt);
    void answer(SimulatedModule& module, Prompt& prompt);
    void tidy();

    const DevicePlan& m_plan;
    SeededRandom m_random;
    SimulatedDevice* m_device = nullptr;
    std::map<HostIndex, Prompt> m_prompts;
    std::map<IncidentId, Instant> m_seen;
    bool m_polite = false;
};

} // namespace liena::simulation
