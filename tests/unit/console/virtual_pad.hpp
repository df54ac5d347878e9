// A game pad that exists in SDL only, and that a test holds.
#pragma once

#include <SDL.h>

#include <cmath>

namespace console::test {

/// Comes when made and goes when destroyed. SDL must have been begun, and hears of what is set here at its next poll.
class VirtualPad {
public:
    explicit VirtualPad(const char* name = "Virtual pad")
    {
        SDL_VirtualJoystickDesc about{};
        about.version = SDL_VIRTUAL_JOYSTICK_DESC_VERSION;
        about.type = SDL_JOYSTICK_TYPE_GAMECONTROLLER;
        about.naxes = SDL_CONTROLLER_AXIS_MAX;
        about.nbuttons = SDL_CONTROLLER_BUTTON_MAX;
        about.name = name;
        m_joystick = SDL_JoystickOpen(SDL_JoystickAttachVirtualEx(&about));
        trigger(0);
    }

    VirtualPad(const VirtualPad&) = delete;
    VirtualPad& operator=(const VirtualPad&) = delete;

    ~VirtualPad() { unplug(); }

    bool sound() const { return m_joystick != nullptr; }

    void unplug()
    {
        if (m_joystick == nullptr)
            return;
        const auto id = SDL_JoystickInstanceID(m_joystick);
        for (int index = 0; index < SDL_NumJoysticks(); ++index)
            if (SDL_JoystickGetDeviceInstanceID(index) == id)
                SDL_JoystickDetachVirtual(index);
        SDL_JoystickClose(m_joystick);
        m_joystick = nullptr;
    }

    /// -1 to 1.
    void stick(SDL_GameControllerAxis axis, double value) { SDL_JoystickSetVirtualAxis(m_joystick, axis, raw(value)); }

    /// 0, let go, to 1.
    void trigger(double value) { SDL_JoystickSetVirtualAxis(m_joystick, SDL_CONTROLLER_AXIS_TRIGGERLEFT, raw(2 * value - 1)); }

    void button(SDL_GameControllerButton which, bool down) { SDL_JoystickSetVirtualButton(m_joystick, which, down ? 1 : 0); }

private:
    static Sint16 raw(double value) { return static_cast<Sint16>(std::lround(value * SDL_JOYSTICK_AXIS_MAX)); }

    SDL_Joystick* m_joystick = nullptr;
};

} // namespace console::test
