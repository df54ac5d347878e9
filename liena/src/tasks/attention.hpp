// Whether a thread that has nothing to do looks for the next message or sleeps until it comes.
#pragma once

#include <chrono>

namespace liena::tasks {

/// Pure. Waking a sleeping thread takes longer than sealing a command, sending it and opening it. While prompt messages follow each other
/// at once, as question and answer do, the thread therefore stays awake; with the first pause it sleeps again, and sleeps through
/// whatever comes less often.
///
///   asleep ── `enough` messages, each within `close` of the one before ──► awake
///   asleep ◄── none for `pause` ──────────────────────────────────────────  awake
class Attention {
public:
    using Instant = std::chrono::steady_clock::time_point;

    static constexpr int enough = 16;
    static constexpr std::chrono::microseconds close{150};
    static constexpr std::chrono::microseconds pause{100};

    /// A prompt message came. What one step of the thread brought counts as one: a burst is no dialogue.
    void heard() { m_heard = true; }

    /// There is something to judge: nothing is to be asked, and no clock read, after a step for which this is false.
    bool isConcerned() const { return m_heard || isAwake(); }

    /// After each step that concerned it.
    void judge(Instant now)
    {
        if (m_heard) {
            m_inARow = now - m_last <= close ? m_inARow + 1 : 1;
            m_inARow = m_inARow < enough ? m_inARow : enough;
            m_last = now;
            m_heard = false;
        } else if (now - m_last > pause) {
            m_inARow = 0;
        }
    }

    bool isAwake() const { return m_inARow >= enough; }

private:
    bool m_heard = false;
    int m_inARow = 0;
    Instant m_last;
};

} // namespace liena::tasks
