// The world of a walk through everything that may happen: what is true in it, and what motion needs of it.
#pragma once

#include "input/master_device.hpp"
#include "model/link_state.hpp"
#include "model/permit_guards.hpp"

#include <chrono>
#include <optional>

namespace console::test {

using namespace std::chrono_literals;

inline constexpr auto pictureLimit = 250ms;
inline constexpr auto armHold = 1500ms;

/// What is true of the world, whatever the console makes of it.
struct World {
    LinkState link = LinkState::Closed;
    bool standsBy = false;
    bool focus = true;
    bool pictureRuns = true;
    RobotState robot = RobotState::Ready;
    bool another = false; ///< console has armed it
    quint32 permit = 1;
    double force = 0;
    Instant now = Instant{} + 1h;
    Instant shown = now; ///< capture of the newest painted picture
    Instant pictureSince = now;
    Instant reported = now; ///< by the robot
    Instant linkSince = now;
};

/// What motion needs, from what the person did and the others said.
struct Needs {
    const char* brokenBy = "nothing"; ///< what ends motion, and happened last
    Instant brokenAt{};
    std::optional<Instant> armSince;  ///< R went down, and is down
    bool heldInFull = false;          ///< it came up after that, and did not go down again
    std::optional<Instant> armedAt;   ///< the robot said so, after R was held in full and nothing broke since
    std::optional<Instant> engagedAt; ///< D went down after that
    quint32 permit = 0;

    void broken(const char* why, Instant now)
    {
        brokenBy = why;
        brokenAt = now;
        armedAt.reset();
        engagedAt.reset();
        armSince.reset();
        heldInFull = false;
    }

    bool wasHeld(Instant now) const { return heldInFull || (armSince && now - *armSince >= armHold); }
};

/// With everything well that does not change in this world. `spentPermit` is the permit's own.
inline GuardReadings readingsOf(const World& world, const MasterReading& hand, std::optional<quint32> spentPermit)
{
    GuardReadings r;
    r.robotLink = world.link;
    r.inLinkState = world.now - world.linkSince;
    r.identityEqual = carriesMessages(world.link);
    r.heartbeatsOnTime = 50;
    r.clockUncertainty = 1ms;
    r.picture.age = world.now - world.shown;
    const bool live = *r.picture.age <= pictureLimit;
    r.picture.condition = live ? PictureCondition::Live : PictureCondition::Frozen;
    r.picture.mayGuide = true;
    r.picture.liveFor = live ? Duration(world.now - world.pictureSince) : Duration{};
    r.picture.atRate = live;
    r.picture.keepsRate = live;
    r.pictureLimit = pictureLimit;
    r.robotFresh = world.now - world.reported <= 200ms;
    r.robotState = world.robot;
    r.robotHoldConfirmed = world.robot == RobotState::Ready;
    r.robotPermit = world.permit;
    r.spentPermit = spentPermit;
    r.drivesHealthy = true;
    r.roundTrip = 40ms;
    r.usualRoundTrip = 40ms;
    r.carried = 100ms;
    r.recorded = true;
    r.auditKept = true;
    r.force = world.force;
    r.incident = world.standsBy;
    r.handAlive = hand.alive;
    r.windowActive = world.focus;
    r.deadMan = hand.deadMan;
    r.alarmsTested = true;
    r.interruptionRead = true;
    return r;
}

} // namespace console::test
