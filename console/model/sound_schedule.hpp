// Which burst sounds when.
#pragma once

#include "model/alarm_burst.hpp"
#include "model/alarm_list.hpp"

#include <array>
#include <optional>
#include <vector>

namespace console {

/// No clock and no sound of its own. Only the highest priority sounds, of what is present and not acknowledged: a latched alarm that
/// ended is shown and silent, but the burst that told it is heard to its end: what was short is known by its sound, too. A new condition of
/// that priority sounds at once, or right after the burst that sounds; a higher one interrupts. Low sounds once for each alarm.
class SoundSchedule {
public:
    /// The burst that begins now, if one does. `paused`: audio pause; what is due when it ends sounds then.
    std::optional<AlarmPriority> next(const std::vector<Alarm>& alarms, bool paused, Instant now);

    /// A person acknowledged one of that priority. True: the burst that sounds told nothing else, and is to be silenced now.
    bool acknowledge(AlarmPriority priority, const std::vector<Alarm>& alarms, Instant now);

    /// Something is present that sounds, or would but for the pause.
    static bool demandsSound(const std::vector<Alarm>& alarms);

private:
    bool due(AlarmPriority priority, quint64 newest, Instant now) const;

    std::optional<AlarmPriority> m_current; ///< what sounded last, while it is still the highest
    Instant m_begun;                        ///< of the last burst
    Instant m_ends;
    std::array<quint64, 3> m_heard{}; ///< by priority: the newest alarm that a burst has told
};

} // namespace console
