// One repetition of a fault: the robot moves, something fails, and a person brings it back.
#pragma once

#include "runner/rig.hpp"

#include <cstdint>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace liena::lab {

/// What one repetition showed. Times in ms from the fault on.
struct Outcome {
    std::int64_t began = 0; ///< monotonic ns; 0 when there was no fault
    std::optional<double> cockpitDetects;
    std::optional<double> robotDetects;
    std::optional<double> stops;   ///< the drives stand still
    std::optional<double> reopens; ///< from the person's confirmation to Open at both ends
    std::string seen;              ///< the worst that the session went through, at either end
    std::vector<std::string> notes;
    std::vector<std::string> broken; ///< what should have happened and did not
};

/// The lab's own word for a repetition that cannot go on: liveness is broken.
struct Stuck {
    std::string what;
};

/// Whose sessions have to be open before the robot is armed.
enum class With { Everybody, Robot };

class Scene {
public:
    Scene(Rig& rig, std::mt19937_64& random) : m_rig(rig), m_random(random) {}

    Rig& rig() { return m_rig; }
    RigDevice& cockpit() { return m_rig["cockpit"]; }
    RigDevice& robot() { return m_rig["robot"]; }
    Outcome& outcome() { return m_outcome; }

    /// Whole numbers in [least, most], from the lab's seed.
    int draw(int least, int most);

    /// Opens what is not open, arms and presses until the robot moves, as a patient person would; then a random moment more. Throws Stuck.
    void engage(With with = With::Everybody);

    /// The fault is in force since `at`.
    void begin(std::int64_t at);

    /// An order to the wire that is the fault.
    void beginByWire(const std::string& order) { begin(m_rig.wire(order)); }

    /// An order for some time, then the wire is whole again.
    void disturb(const std::string& order, Milliseconds time);
    void heal() { (void)m_rig.wire("link *>*"); }

    /// The fault is over: reads what it did, checks that nothing moves by itself, re-opens and moves again. Throws Stuck.
    void recover();

    /// Only reads what the fault did; for those that need no recovery.
    void read();

    /// The cockpit's session must have come this far: `unnoticed`, `suspect`, `interrupted` or `stand-by`.
    void must(const std::vector<std::string>& seen);

    /// The cockpit's first probe after the loss must have come to this.
    void mustFind(const std::string& finding);
    void note(const std::string& text) { m_outcome.notes.push_back(text); }
    void fails(const std::string& text) { m_outcome.broken.push_back(text); }

    /// Presses `reopen` at the cockpit until that session is open at both ends.
    void reopen(const std::string& peer);

    /// Ends a device in order, as `witness` sees it, and starts it anew. Throws Stuck.
    void restart(const std::string& device, RigDevice& witness, const Rig::Start& how);

    /// Waits, and throws Stuck when it does not happen.
    void await(const std::function<bool()>& condition, Milliseconds limit, const std::string& what);

    /// Largest gap between commands that the robot applied since `from`, in ms.
    double largestGap(std::int64_t from);

private:
    bool settled(const std::string& peer);
    void open(With with);
    std::optional<double> detection(const RigDevice& device, const std::string& peer) const;

    Rig& m_rig;
    std::mt19937_64& m_random;
    Outcome m_outcome;
    std::optional<std::int64_t> m_begin;
    bool m_moved = false; ///< when the fault began
};

} // namespace liena::lab
