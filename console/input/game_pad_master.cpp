// Which button does what.
#include "input/game_pad_master.hpp"

namespace console {

GamePadMaster::GamePadMaster(std::unique_ptr<PadSource> pads, QObject* parent) : ConnectedMaster(parent), m_pads(std::move(pads)) {}

QString GamePadMaster::name() const
{
    const auto more = m_pads->others().size();
    const auto name = m_pads->name().isEmpty() ? word(kind()) : tr("%1 %2").arg(word(kind()), m_pads->name());
    return more > 0 && connected() ? tr("%1 (+%2)").arg(name).arg(more) : name;
}

QString GamePadMaster::legend() const
{
    return tr("left trigger dead-man · sticks guidewire, catheter · right shoulder clutch · Start arm · cross scale · B hold · F X-ray");
}

QString GamePadMaster::note() const
{
    if (!m_pads->trouble().isEmpty())
        return m_pads->trouble();
    return m_pads->others().isEmpty() ? QString() : tr("there, and not used: %1").arg(m_pads->others().join(tr(", ")));
}

void GamePadMaster::take(Instant)
{
    for (const auto& step : m_pads->poll()) {
        if (step.what != PadStep::What::Changed) {
            m_trigger = {};
            m_state = step.state;
            setConnected(step.what == PadStep::What::Came);
        }
        if (step.what != PadStep::What::Went)
            follow(step.state);
    }
}

void GamePadMaster::follow(const PadState& state)
{
    const auto pressed = [&](PadButton button) { return state.down(button) && !m_state.down(button); };
    const bool hold = pressed(PadButton::East);
    const int steps = int(pressed(PadButton::Up)) - int(pressed(PadButton::Down));
    m_state = state;
    // A stick says down positive, a hand pushes up to advance.
    const HandAxes axes{-state.axis(PadAxis::LeftY), state.axis(PadAxis::LeftX), -state.axis(PadAxis::RightY), state.axis(PadAxis::RightX)};
    const auto moved = mapped(axes, stick, m_speeds, Coupling::Both);
    HandControls controls;
    controls.deadMan = m_trigger.update(state.axis(PadAxis::LeftTrigger));
    controls.clutch = state.down(PadButton::RightShoulder);
    controls.arm = state.down(PadButton::Start);
    controls.motion = moved.motion;
    controls.axesAtRest = moved.atRest;
    tell(controls);
    if (hold)
        Q_EMIT holdRequested();
    if (steps != 0 && counts())
        Q_EMIT scaleStepRequested(steps);
}

} // namespace console
