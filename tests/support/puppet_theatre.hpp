// The console as a person has it, with a robot and an X-ray system that do as a test tells them.
#pragma once

#include "puppet_devices.hpp"
#include "theatre.hpp"

namespace console::test {

/// No device but the puppets'.
inline Theatre::Wishes puppetWishes()
{
    Theatre::Wishes wishes;
    wishes.devices = false;
    wishes.arm = false;
    return wishes;
}

struct PuppetTheatre {
    explicit PuppetTheatre(const Theatre::Wishes& wishes = puppetWishes()) : theatre(wishes) {}

    Theatre theatre;
    liena::test::PuppetRobot robot{theatre.files.settingsOf("robot")};
    liena::test::PuppetXray xray{theatre.files.settingsOf("xray")};
};

} // namespace console::test
