// Whether another process answers what it is asked.
#pragma once

#include "model/instant.hpp"

#include <QtGlobal>

#include <chrono>

namespace console {

/// No clock of its own.
class AnswerWatch {
public:
    /// Opening a sound output may take a few seconds.
    static constexpr std::chrono::seconds patience{5};

    void ask(Instant now)
    {
        if (m_answered == m_asked)
            m_since = now;
        ++m_asked;
    }

    /// So many questions have been answered, in all.
    void noteAnswered(quint64 count, Instant now)
    {
        if (count != m_answered)
            m_since = now;
        m_answered = count;
    }

    bool isWaiting() const { return m_answered < m_asked; }
    bool isLate(Instant now) const { return isWaiting() && now - m_since > patience; }

private:
    quint64 m_asked = 0;
    quint64 m_answered = 0;
    Instant m_since; ///< the last answer, or the first question without one
};

} // namespace console
