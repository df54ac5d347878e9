// What may leave for the X-ray system at one moment: exposure only while a foot and a running screen ask for it.
#pragma once

#include "model/instant.hpp"

#include <QtGlobal>

#include <chrono>
#include <optional>

namespace console {

/// What the GUI thread last knew; handed whole to the network thread.
struct PedalSnapshot {
    bool down = false;
    quint32 press = 0; ///< counts presses
    double pulseRate = 15;
    Instant guiTick;
};

struct PedalOrder {
    bool pedal = false;
    quint32 press = 0;
    double pulseRate = 15;
};

/// Network thread only. A press begins with some orders that the pedal was up, since one may come late or be superseded: the X-ray system
/// turns the beam on only where it has heard the pedal up, and then down, in one session. While the pedal is down it is repeated; when it
/// comes up, or when the GUI did not run for 200 ms, a few stops follow and then nothing. A press that was ended by a GUI that hung, or
/// whose order could not be sent, stays ended: the foot must come up and go down again.
class PedalGate {
public:
    static constexpr std::chrono::milliseconds guiLimit{200};
    static constexpr int starts = 2;
    static constexpr int stops = 3;

    std::optional<PedalOrder> compose(const PedalSnapshot& snapshot, Instant now);

    /// What was composed last could not be sent: its press ends.
    void refused() { m_endedPress = m_press; }

private:
    quint32 m_press = 0; ///< as composed last
    quint32 m_endedPress = 0;
    int m_startsLeft = 0;
    int m_stopsLeft = 0;
};

} // namespace console
