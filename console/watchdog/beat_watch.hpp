// Whether the console still runs, judged by its beats.
#pragma once

#include "model/instant.hpp"

#include <chrono>
#include <cstdint>

namespace console {

/// What the console writes to the watchdog's pipe, one character each, twenty times a second. `Attended`: a person relies on what the
/// console sounds: it is armed or in hold, or an alarm of high priority stands.
enum class Beat : char { Idle = 'i', Attended = 'a', Goodbye = 'q' };

/// What the watchdog answers to beats. `Silent`: it watches, and nobody would hear its alarm. Other characters are taken for `Watching`.
enum class Answer : char { Watching = '.', Silent = '!' };

/// ```
///               attended, and no beat for 250 ms
///   Watching ─────────────────────────────────────► Hung
///    │  │  ▲                                         │ │
///    │  │  └──────────── any beat ───────────────────┘ │ pipe ends
///    │  │ pipe ends while attended                     ▼
///    │  └───────────────────────────────────────────► Died ── sounded long enough ──► Over
///    └── goodbye, or the pipe ends while idle ──────────────────────────────────────► Over
/// ```
/// No clock of its own. Nothing that was said before the first attended beat sounds.
class BeatWatch {
public:
    enum class State : std::uint8_t { Watching, Hung, Died, Over };

    static constexpr std::chrono::milliseconds patience{250};

    /// `mourning`: how long the death of an attended console is sounded.
    explicit BeatWatch(std::chrono::seconds mourning) : m_mourning(mourning) {}

    void take(char beat, Instant now);
    void noteEnd(Instant now); ///< the pipe has ended
    State look(Instant now);

    /// Since the last beat; for the words of the alarm.
    Duration silence(Instant now) const { return now - m_lastBeat; }

private:
    std::chrono::seconds m_mourning;
    State m_state = State::Watching;
    bool m_attended = false;
    Instant m_lastBeat;
    Instant m_died;
};

} // namespace console
