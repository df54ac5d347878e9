// Every alarm condition, and a reading that raises it alone: for its rules, and for what is shown of it.
#pragma once

#include "model/alarm_rules.hpp"

#include <chrono>
#include <functional>
#include <optional>
#include <vector>

namespace console::test {

using AlarmChange = std::function<void(AlarmReadings&)>;

/// One reading that is wrong, and the alarm that it is.
struct AlarmCase {
    const char* name;
    AlarmChange change;
    AlarmCondition condition;
    AlarmPriority armed;
    std::optional<AlarmPriority> otherwise;
    bool latching;
};

/// No alarm, armed or not.
inline AlarmReadings calmReadings()
{
    using namespace std::chrono_literals;
    AlarmReadings r;
    r.robotFresh = true;
    r.drivesKnown = true;
    r.pictureLimit = 250ms;
    r.contrastLeft = 40;
    r.airKerma = 2999;
    r.painting = PaintingReading{15, 14};
    AlarmLinkReading link;
    link.peer = 5;
    link.title = QStringLiteral("Robot");
    link.state = LinkState::Open;
    link.commandRoundTrip = 150ms;
    r.links = {link};
    return r;
}

/// Each condition of docs/ALARMS.md by the name that it has there.
inline const std::vector<AlarmCase>& alarmCases()
{
    using C = AlarmCondition;
    using namespace std::chrono_literals;
    constexpr auto High = AlarmPriority::High, Medium = AlarmPriority::Medium, Low = AlarmPriority::Low;
    static const std::vector<AlarmCase> all{
        {"link lost", [](auto& r) { r.links[0].state = LinkState::StandBy; }, C::LinkLost, High, Medium, true},
        {"link of two others lost",
         [](auto& r) {
             r.pairs.push_back({6, 5, QStringLiteral("Robotic arm"), QStringLiteral("Vascular robot")});
         },
         C::LinkLost, High, Medium, true},
        {"picture link lost",
         [](auto& r) {
             r.links[0].state = LinkState::StandBy;
             r.links[0].images = true;
         },
         C::ImageLost, High, Medium, true},
        {"link closed while armed",
         [](auto& r) {
             r.links[0].state = LinkState::Closed;
             r.links[0].closedWhileArmed = true;
         },
         C::LinkLost, High, std::nullopt, true},
        {"picture link closed while armed",
         [](auto& r) {
             r.links[0].state = LinkState::Closed;
             r.links[0].closedWhileArmed = true;
             r.links[0].images = true;
         },
         C::ImageLost, High, std::nullopt, true},
        {"hold not confirmed", [](auto& r) { r.awaitingHold = 201ms; }, C::HoldNotConfirmed, High, Medium, true},
        {"picture frozen", [](auto& r) { r.picture.condition = PictureCondition::Frozen; }, C::PictureStale, High, Low, false},
        {"picture too old for a moment",
         [](auto& r) {
             r.picture.condition = PictureCondition::Live;
             r.pictureTooOld = true;
         },
         C::PictureStale, High, std::nullopt, false},
        {"no picture", [](auto& r) { r.picture.overdue = true; }, C::PictureStale, High, Low, false},
        {"picture reduced",
         [](auto& r) {
             r.picture.condition = PictureCondition::Live;
             r.picture.reduction = {6, 15, 15, PixelEncoding::Jpeg, 75};
         },
         C::PictureReduced, Low, Low, false},
        {"force stop", [](auto& r) { r.force = -2.0; }, C::ForceStop, High, Medium, true},
        {"force warning", [](auto& r) { r.force = 1.0; }, C::ForceWarn, Medium, std::nullopt, false},
        {"drive fault", [](auto& r) { r.faultCode = 2; }, C::DriveFault, High, Medium, true},
        {"emergency stop", [](auto& r) { r.emergencyStop = true; }, C::EmergencyStop, High, Medium, true},
        {"emergency stop unheard", [](auto& r) { r.stopUnheard = 201ms; }, C::StopUnheard, High, High, true},
        {"deadline", [](auto& r) { r.links[0].deadlineMissed = QStringLiteral("RobotStatus"); }, C::DeadlineMissed, Medium, Low, false},
        {"unsteady", [](auto& r) { r.links[0].suspectsInMinute = 3; }, C::LinkUnsteady, Low, Low, false},
        {"packets lost", [](auto& r) { r.links[0].packetsLost = true; }, C::PacketsLost, Low, Low, false},
        {"clock", [](auto& r) { r.links[0].clockUncertain = true; }, C::ClockUncertain, Medium, Low, false},
        {"soft limit", [](auto& r) { r.limitSwitches = GuidewireSoftHigh; }, C::SoftLimit, Low, std::nullopt, false},
        {"hard limit", [](auto& r) { r.limitSwitches = CatheterHardLow; }, C::HardLimit, Medium, std::nullopt, false},
        {"round trip, caution", [](auto& r) { r.links[0].commandRoundTrip = 151ms; }, C::CommandRoundTrip, Low, std::nullopt, false},
        {"round trip above the limit", [](auto& r) { r.links[0].commandRoundTrip = 251ms; }, C::CommandRoundTrip, Medium, Low, false},
        {"tracker", [](auto& r) { r.trackerOverdue = true; }, C::TrackerStale, Medium, Low, false},
        {"roadmap", [](auto& r) { r.roadmapRemoved = QStringLiteral("the table moved"); }, C::RoadmapRemoved, Low, std::nullopt, false},
        {"contrast low", [](auto& r) { r.contrastLeft = 4.9; }, C::ContrastLow, Low, Low, false},
        {"contrast empty",
         [](auto& r) {
             r.contrastLeft = 0;
             r.contrastRanDry = true;
         },
         C::ContrastEmpty, Medium, Low, true},
        {"air kerma 3 Gy", [](auto& r) { r.airKerma = 3000; }, C::AirKerma, Low, Low, true},
        {"fluoroscopy 5 min", [](auto& r) { r.fluoroscopyTime = 300; }, C::FluoroscopyTime, Low, Low, true},
        {"air kerma 5 Gy", [](auto& r) { r.airKerma = 5000; }, C::AirKerma, Medium, Medium, true},
        {"picture slow",
         [](auto& r) {
             r.picture.condition = PictureCondition::Live;
             r.pictureSlow = true;
         },
         C::PictureSlow, Low, std::nullopt, false},
        {"painting",
         [](auto& r) {
             r.painting = PaintingReading{15, 11};
         },
         C::PaintingBehind, Medium, Low, false},
        {"another system", [](auto& r) { r.links[0].systemDiffers = true; }, C::SystemDiffers, Medium, Medium, true},
        {"recorder", [](auto& r) { r.recorderTroubles << QStringLiteral("disk full"); }, C::RecorderStopped, Low, Low, true},
        {"sound", [](auto& r) { r.soundTrouble = QStringLiteral("no output"); }, C::SoundFailed, Medium, Low, false},
        {"watchdog", [](auto& r) { r.watchdogTrouble = QStringLiteral("ended"); }, C::WatchdogGone, Medium, Low, false},
    };
    return all;
}

} // namespace console::test
