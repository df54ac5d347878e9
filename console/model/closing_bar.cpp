// Who relies on the cockpit, in the order in which a person ends it.
#include "model/closing_bar.hpp"

#include "model/preferences.hpp"

#include <QCoreApplication>

namespace console {

namespace {

struct ClosingText {
    Q_DECLARE_TR_FUNCTIONS(console::Closing)
};

/// By then the robot has named it, or an alarm says that it has not.
constexpr std::chrono::milliseconds stopAnswer{500};

QString firstOf(PermitPhase phase)
{
    switch (phase) {
    case PermitPhase::Arming:
        return ClosingText::tr("Let go of ARM.");
    case PermitPhase::Hold:
        return ClosingText::tr("Let go of the dead-man. Where the robot does not hold then, close its link.");
    default:
        return ClosingText::tr("Press F12 to hold, and let go of the dead-man.");
    }
}

bool isInjecting(const ConsoleModels& models, Instant now)
{
    return models.instrument.injecting() || (models.injection.awaited() && !models.injection.unanswered(now));
}

bool isStopOnItsWay(const ConsoleModels& models, Instant now)
{
    const auto asked = models.instrument.stopUnheard();
    return asked && now - *asked < stopAnswer;
}

} // namespace

std::optional<ClosingBar> closingBar(const ConsoleModels& models, Instant now)
{
    const auto phase = models.permit.phase();
    if (!preferencesMayChange(phase)) // armed, on the way there, or in a hold of it
        return ClosingBar{ClosingText::tr("the permit is %1").arg(word(phase)), firstOf(phase)};
    if (isInjecting(models, now))
        return ClosingBar{ClosingText::tr("contrast is being injected"), ClosingText::tr("Wait until it has ended.")};
    if (models.xray.pedalDown())
        return ClosingBar{ClosingText::tr("the X-ray pedal is down"), ClosingText::tr("Let go of it.")};
    if (models.xray.fresh(now) && models.xray.beamOn())
        return ClosingBar{ClosingText::tr("X-ray is on"), ClosingText::tr("Wait until it is off.")};
    if (isStopOnItsWay(models, now))
        return ClosingBar{ClosingText::tr("an emergency stop is on its way to the robot"), ClosingText::tr("Wait for the robot's answer.")};
    if (models.alarms.unacknowledgedHigh())
        return ClosingBar{ClosingText::tr("a high alarm is not acknowledged"), ClosingText::tr("Look at it, and acknowledge it.")};
    return std::nullopt;
}

} // namespace console
