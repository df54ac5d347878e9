// SDL's events and states, turned into steps.
#include "input/sdl_pads.hpp"

#include <QCoreApplication>

#include <SDL.h>

#include <algorithm>
#include <optional>

namespace console {

namespace {

struct Text {
    Q_DECLARE_TR_FUNCTIONS(console::SdlPads)
};

constexpr double fullAxis = 32767;
constexpr qsizetype longestName = 60;

constexpr std::array axisTable{SDL_CONTROLLER_AXIS_LEFTX, SDL_CONTROLLER_AXIS_LEFTY, SDL_CONTROLLER_AXIS_RIGHTX, SDL_CONTROLLER_AXIS_RIGHTY,
                               SDL_CONTROLLER_AXIS_TRIGGERLEFT};
static_assert(axisTable.size() == padAxisCount);

constexpr std::array buttonTable{SDL_CONTROLLER_BUTTON_B, SDL_CONTROLLER_BUTTON_START, SDL_CONTROLLER_BUTTON_RIGHTSHOULDER,
                                 SDL_CONTROLLER_BUTTON_DPAD_UP, SDL_CONTROLLER_BUTTON_DPAD_DOWN};
static_assert(buttonTable.size() == padButtonCount);

template <typename Table>
std::optional<std::size_t> placeOf(const Table& table, int value)
{
    const auto found = std::find(table.begin(), table.end(), value);
    return found != table.end() ? std::optional<std::size_t>(static_cast<std::size_t>(found - table.begin())) : std::nullopt;
}

/// A radio link that breaks keeps saying for seconds what was last held. Pads on a dongle look like wired ones: of those the guide warns.
bool byBluetooth(int index)
{
    constexpr Uint8 bluetoothBus = 0x05;
    const auto guid = SDL_JoystickGetDeviceGUID(index);
    return guid.data[0] == bluetoothBus && guid.data[1] == 0;
}

/// A device chooses its name: it is shown as text, on one line, and not endlessly.
QString shownName(const char* name) { return QString::fromUtf8(name != nullptr ? name : "?").simplified().left(longestName); }

} // namespace

SdlPads::SdlPads()
{
    // Whatever the environment says.
    const auto insist = [](const char* name, const char* value) { SDL_SetHintWithPriority(name, value, SDL_HINT_OVERRIDE); };
    insist(SDL_HINT_NO_SIGNAL_HANDLERS, "1");
    insist(SDL_HINT_JOYSTICK_ALLOW_BACKGROUND_EVENTS, "1");
    // The kernel's drivers know the pads; SDL's own write to the devices and can take their time.
    insist(SDL_HINT_JOYSTICK_HIDAPI, "0");
    insist(SDL_HINT_ACCELEROMETER_AS_JOYSTICK, "0");
    insist(SDL_HINT_GAMECONTROLLER_USE_BUTTON_LABELS, "0"); // by place, whatever is printed on it
    if (SDL_InitSubSystem(SDL_INIT_GAMECONTROLLER | SDL_INIT_JOYSTICK) != 0)
        m_trouble = Text::tr("game pads cannot be heard: %1").arg(QString::fromUtf8(SDL_GetError()));
}

SdlPads::~SdlPads()
{
    if (m_pad != nullptr)
        SDL_GameControllerClose(m_pad);
    if (m_trouble.isEmpty())
        SDL_QuitSubSystem(SDL_INIT_GAMECONTROLLER | SDL_INIT_JOYSTICK);
}

std::vector<PadStep> SdlPads::poll()
{
    std::vector<PadStep> steps;
    if (!m_trouble.isEmpty())
        return steps;
    // Of a pad that goes SDL says first that everything on it was let go, which nobody did.
    SDL_PumpEvents();
    if (m_pad != nullptr && SDL_GameControllerGetAttached(m_pad) == SDL_FALSE)
        close(steps);
    SDL_Event event;
    while (SDL_PollEvent(&event) != 0)
        take(event, steps);
    if (m_pad != nullptr)
        change(read(), steps); // whatever no event told
    if (m_listChanged && m_pad == nullptr)
        openFirst(steps);
    if (m_listChanged)
        nameOthers();
    return steps;
}

void SdlPads::take(const SDL_Event& event, std::vector<PadStep>& steps)
{
    PadState state = m_state;
    switch (event.type) {
    case SDL_JOYDEVICEADDED:
    case SDL_JOYDEVICEREMOVED:
        m_listChanged = true;
        if (event.type == SDL_JOYDEVICEREMOVED && m_pad != nullptr && event.jdevice.which == m_id)
            close(steps);
        return;
    case SDL_CONTROLLERAXISMOTION:
        if (const auto place = placeOf(axisTable, event.caxis.axis); place && event.caxis.which == m_id)
            state.axes.at(*place) = event.caxis.value / fullAxis;
        return change(state, steps);
    case SDL_CONTROLLERBUTTONDOWN:
    case SDL_CONTROLLERBUTTONUP:
        if (const auto place = placeOf(buttonTable, event.cbutton.button); place && event.cbutton.which == m_id)
            state.buttons.at(*place) = event.cbutton.state == SDL_PRESSED;
        return change(state, steps);
    default:
        return;
    }
}

/// How a stick got where it is matters to nobody; what was pressed or let go on the way does.
void SdlPads::change(const PadState& state, std::vector<PadStep>& steps)
{
    if (m_pad == nullptr || state == m_state)
        return;
    const bool onlySticks = state.buttons == m_state.buttons && state.axis(PadAxis::LeftTrigger) == m_state.axis(PadAxis::LeftTrigger);
    m_state = state;
    if (onlySticks && !steps.empty() && steps.back().what == PadStep::What::Changed)
        steps.back().state = state;
    else
        steps.push_back({PadStep::What::Changed, state});
}

PadState SdlPads::read() const
{
    PadState state;
    for (std::size_t place = 0; place < padAxisCount; ++place)
        state.axes.at(place) = SDL_GameControllerGetAxis(m_pad, axisTable.at(place)) / fullAxis;
    for (std::size_t place = 0; place < padButtonCount; ++place)
        state.buttons.at(place) = SDL_GameControllerGetButton(m_pad, buttonTable.at(place)) != 0;
    return state;
}

void SdlPads::openFirst(std::vector<PadStep>& steps)
{
    for (int index = 0; index < SDL_NumJoysticks() && m_pad == nullptr; ++index)
        if (SDL_IsGameController(index) == SDL_TRUE && !byBluetooth(index))
            m_pad = SDL_GameControllerOpen(index);
    if (m_pad == nullptr)
        return;
    m_id = SDL_JoystickInstanceID(SDL_GameControllerGetJoystick(m_pad));
    m_name = shownName(SDL_GameControllerName(m_pad));
    // What is held as it comes is known only after this.
    SDL_GameControllerUpdate();
    m_state = read();
    steps.push_back({PadStep::What::Came, m_state});
}

void SdlPads::close(std::vector<PadStep>& steps)
{
    SDL_GameControllerClose(m_pad);
    m_pad = nullptr;
    m_id = -1;
    m_state = {};
    m_name.clear();
    m_listChanged = true;
    steps.push_back({PadStep::What::Went, {}});
}

void SdlPads::nameOthers()
{
    m_listChanged = false;
    m_others.clear();
    for (int index = 0; index < SDL_NumJoysticks(); ++index)
        if (SDL_JoystickGetDeviceInstanceID(index) != m_id)
            m_others << shownName(SDL_JoystickNameForIndex(index)) + (byBluetooth(index) ? Text::tr(" (Bluetooth)") : QString());
}

} // namespace console
