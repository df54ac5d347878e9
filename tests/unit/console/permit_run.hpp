// Drives a motion permit as its caller does, for the tests of its rules.
#pragma once

#include "model/motion_permit.hpp"

#include <array>

namespace permit_run {

using namespace console;
using namespace std::chrono_literals;
using Kind = PermitEventKind;
using Phase = PermitPhase;

inline constexpr quint32 permit = 7;
inline constexpr Instant start = Instant{} + 1h;

inline GuardSet all() { return ~GuardSet{}; }

inline PermitEvent told(Kind kind)
{
    PermitEvent e;
    e.kind = kind;
    e.armable = all();
    e.kept = all();
    e.robot = RobotState::Ready;
    e.holdConfirmed = true;
    e.permit = permit;
    e.own = true;
    return e;
}

inline PermitEvent robot(RobotState state, quint32 number = permit, bool confirmed = true)
{
    auto e = told(Kind::RobotReported);
    e.robot = state;
    e.permit = number;
    e.holdConfirmed = confirmed;
    return e;
}

/// The permit is the robot's: it reports the same to every console.
inline PermitEvent robotOfAnother(RobotState state)
{
    auto e = robot(state);
    e.own = false;
    return e;
}

inline PermitEvent guards(bool armable, bool kept)
{
    auto e = told(Kind::GuardsChecked);
    e.armable = armable ? all() : GuardSet{};
    e.kept = kept ? all() : GuardSet{};
    return e;
}

/// Drives the machine as its caller does, and keeps what was asked for.
struct Run {
    PermitState state;
    PermitActions last;
    Instant now = start;

    PermitActions feed(const PermitEvent& e)
    {
        const auto next = step(state, e, now);
        state = next.state;
        last = next.actions;
        return last;
    }
    PermitActions feed(Kind kind) { return feed(told(kind)); }
    void wait(Duration duration) { now += duration; }

    void openSession()
    {
        feed(Kind::SessionOpen);
        feed(robot(RobotState::Ready));
    }
    void makeReady()
    {
        openSession();
        feed(guards(true, true));
    }
    void hold()
    {
        makeReady();
        feed(Kind::ArmPressed);
    }
    void ask()
    {
        hold();
        wait(1500ms);
        feed(Kind::Tick);
    }
    void arm()
    {
        ask();
        feed(robot(RobotState::Armed));
    }
    void engage()
    {
        arm();
        feed(Kind::DeadManPressed);
    }
    void fallIntoHold()
    {
        engage();
        feed(Kind::PanicHold);
    }
    void standBy()
    {
        engage();
        feed(Kind::SystemStandsBy);
    }
    void verify()
    {
        standBy();
        feed(Kind::DeadManReleased);
        feed(Kind::SessionOpen);
    }
};

inline Run in(Phase phase)
{
    Run run;
    switch (phase) {
    case Phase::Off:
        break;
    case Phase::Standby:
        run.openSession();
        break;
    case Phase::Ready:
        run.makeReady();
        break;
    case Phase::Arming:
        run.hold();
        break;
    case Phase::Armed:
        run.arm();
        break;
    case Phase::Engaged:
        run.engage();
        break;
    case Phase::Hold:
        run.fallIntoHold();
        break;
    case Phase::Incident:
        run.standBy();
        break;
    case Phase::Verifying:
        run.verify();
        break;
    }
    return run;
}

inline constexpr std::array allPhases{Phase::Off,     Phase::Standby, Phase::Ready,    Phase::Arming,   Phase::Armed,
                                      Phase::Engaged, Phase::Hold,    Phase::Incident, Phase::Verifying};

} // namespace permit_run
