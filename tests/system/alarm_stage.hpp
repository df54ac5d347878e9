// The stage of the tests of alarms: the console's own window, with a robot, an X-ray system and an arm that say what a test tells them.
#pragma once

#include "puppet_theatre.hpp"

#include <QTest>

namespace console::test {

struct AlarmStage : PuppetTheatre {
    static constexpr int patience = Theatre::patience;

    explicit AlarmStage(const Theatre::Wishes& wishes = puppetWishes()) : PuppetTheatre(withArm(wishes)) {}

    liena::test::PuppetArm arm{theatre.files.settingsOf("arm")};

    /// From the run that is under way, which has contrast in it; whether it is shown.
    bool makeRoadmap()
    {
        xray.show(liena::test::PuppetXray::Pictures::Filled);
        const auto shown = theatre.models().picture.paintedCount();
        (void)QTest::qWaitFor([&] { return theatre.models().picture.paintedCount() > shown + 10; }, patience);
        theatre.click(QStringLiteral("Roadmap"));
        return QTest::qWaitFor([this] { return theatre.models().roadmap.isValid(); }, patience);
    }

    /// What the X-ray system says of itself is true again, and nobody wants a roadmap.
    void endRoadmap()
    {
        xray.show(liena::test::PuppetXray::Pictures::Good);
        xray.alterStatus({});
        xray.alterFrame({});
        theatre.click(QStringLiteral("Review"));
    }

private:
    static Theatre::Wishes withArm(Theatre::Wishes wishes)
    {
        wishes.arm = true;
        return wishes;
    }
};

} // namespace console::test
