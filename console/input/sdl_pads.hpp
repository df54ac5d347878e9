// Game pads by SDL 2.
#pragma once

#include "input/pad_source.hpp"

struct _SDL_GameController;
union SDL_Event;

namespace console {

/// GUI thread only, and one at a time. SDL opens no window, takes no signal and needs neither display nor udev for this; without any device
/// it just finds none. It hears pads whatever has the focus: that the console's window must have it is the masters' own rule.
class SdlPads : public PadSource {
public:
    SdlPads();
    ~SdlPads() override;

    std::vector<PadStep> poll() override;
    QString name() const override { return m_name; }
    QStringList others() const override { return m_others; }
    QString trouble() const override { return m_trouble; }

private:
    void take(const SDL_Event& event, std::vector<PadStep>& steps);
    void openFirst(std::vector<PadStep>& steps);
    void close(std::vector<PadStep>& steps);
    void nameOthers();
    PadState read() const;
    void change(const PadState& state, std::vector<PadStep>& steps);

    _SDL_GameController* m_pad = nullptr;
    std::int32_t m_id = -1; ///< of the pad that is heard, as SDL's events name it
    PadState m_state;
    QString m_name;
    QStringList m_others;
    QString m_trouble;
    bool m_listChanged = true;
};

} // namespace console
