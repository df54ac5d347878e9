// When what passes the wire waited for its program, and not for the line.
#pragma once

#include "wire/impairment.hpp"

#include <chrono>
#include <cstddef>
#include <deque>
#include <utility>

namespace liena::lab {

class LateSpans {
public:
    struct Span {
        SteadyTime begin;
        SteadyTime end;
    };

    static constexpr auto worthTelling = std::chrono::microseconds(300);
    static constexpr std::size_t mostKept = 10'000;

    /// What was due then leaves now; told in the order in which it was due.
    void note(SteadyTime due, SteadyTime now)
    {
        if (now - due < worthTelling)
            return;
        if (!m_spans.empty() && due <= m_spans.back().end) {
            m_spans.back().end = now;
            return;
        }
        if (m_spans.size() == mostKept)
            m_spans.pop_front();
        m_spans.push_back({due, now});
    }

    /// One after the other, since the last call; the newest of too many.
    std::deque<Span> take() { return std::exchange(m_spans, {}); }

private:
    std::deque<Span> m_spans;
};

} // namespace liena::lab
