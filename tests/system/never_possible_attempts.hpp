// What is done to the cockpit by more than one test of what must never be possible, and how it is undone.
#pragma once

#include "never_possible_stage.hpp"

#include <QTest>

#include <chrono>
#include <optional>

namespace console::test {

using Pictures = liena::test::PuppetXray::Pictures;
using RobotClaim = liena::test::PuppetRobot::Claim;
using Said = liena::test::PuppetRobot::State;

template <Pictures P>
void show(NeverStage& stage)
{
    stage.xray.show(P);
}

inline void beRemote(NeverStage& stage) { stage.theatre.cockpit->setInputOrigin(QStringLiteral("XRDP")); }
inline void beHere(NeverStage& stage) { stage.theatre.cockpit->setInputOrigin({}); }

inline PictureCondition conditionOf(const NeverStage& stage)
{
    return stage.theatre.models().picture.reading(std::chrono::steady_clock::now()).condition;
}

/// The beam goes, and the last picture of the run stands there.
inline void letGoOfThePedal(NeverStage& stage)
{
    stage.theatre.release(Qt::Key_F);
    (void)QTest::qWaitFor([&stage] { return conditionOf(stage) == PictureCondition::Held; }, Theatre::patience);
}

inline void silence(NeverStage& stage) { stage.robot.setSilent(true); }
inline void speak(NeverStage& stage) { stage.robot.setSilent(false); }
inline void beTrue(NeverStage& stage) { stage.robot.claim(std::nullopt); }

} // namespace console::test
