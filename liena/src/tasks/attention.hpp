// Whether a thread that has nothing to do looks for the next message or sleeps until it comes.
#pragma once

#include <algorithm>
#include <chrono>
#include <optional>

namespace liena::tasks {

/// Pure. Waking a sleeping thread takes longer than sealing a command, sending it and opening it. So the thread stays awake where the next
/// message is due at once, and sleeps through whatever comes less often:
///
/// - in a dialogue, while prompt messages follow each other as question and answer do;
/// - between its own prompt message and the answer to it, where such answers have come at once before, however long it is from one answer
///   to the next question.
///
///   asleep ── `enough` messages, each within `close` of the one before ──► awake
///   asleep ◄── none for `pause` ──────────────────────────────────────────  awake
///
///   asleep ── a question, after `enough` that were answered within `close` ──► awake
///   asleep ◄── the answer, or none within `close` ───────────────────────────  awake
class Attention {
public:
    using Instant = std::chrono::steady_clock::time_point;

    static constexpr int enough = 16;
    static constexpr std::chrono::microseconds close{150};
    static constexpr std::chrono::microseconds pause{100};

    /// A prompt message came. What one step of the thread brought counts as one: a burst is no dialogue.
    void heard() { m_heard = true; }

    /// A prompt message was given to a session.
    void asked() { m_asked = true; }

    /// There is something to judge: nothing is to be asked, and no clock read, after a step for which this is false.
    bool isConcerned() const { return m_heard || m_asked || isAwake(); }

    /// After each step that concerned it.
    void judge(Instant now)
    {
        if (m_heard) {
            m_inARow = now - m_last <= close ? std::min(m_inARow + 1, enough) : 1;
            m_last = now;
        } else if (now - m_last > pause) {
            m_inARow = 0;
        }
        judgeQuestion(now);
        m_heard = false;
        m_asked = false;
    }

    bool isAwake() const { return m_inARow >= enough || (m_question && m_answered >= enough); }

private:
    void judgeQuestion(Instant now)
    {
        if (m_question && now - *m_question > close) {
            m_answered /= 2; // a single late answer is made up for by half as many
            m_question.reset();
        } else if (m_question && m_heard) {
            m_answered = std::min(m_answered + 1, enough);
            m_question.reset();
        }
        if (m_asked)
            m_question = now;
    }

    bool m_heard = false;
    bool m_asked = false;
    int m_inARow = 0;
    Instant m_last;
    int m_answered = 0;                ///< questions that were, at once
    std::optional<Instant> m_question; ///< that waits for its answer
};

} // namespace liena::tasks
