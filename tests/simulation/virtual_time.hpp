// The one clock of a simulated world, and what will happen when: ordered by time, then by insertion.
#pragma once

#include "session/instant.hpp"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <vector>

namespace liena::simulation {

using session::Instant;
using session::Nanoseconds;

class VirtualTime {
public:
    using Event = std::function<void()>;

    Instant now() const { return m_now; }

    void at(Instant when, Event event)
    {
        m_heap.push_back({std::max(when, m_now), ++m_inserted, std::move(event)});
        std::push_heap(m_heap.begin(), m_heap.end());
    }
    void after(Nanoseconds delay, Event event) { at(m_now + delay, std::move(event)); }

    /// Runs the next event that is due until `limit`; false, and time stands at the limit, when there is none.
    bool step(Instant limit)
    {
        if (m_heap.empty() || m_heap.front().when > limit) {
            m_now = limit;
            return false;
        }
        std::pop_heap(m_heap.begin(), m_heap.end());
        auto due = std::move(m_heap.back());
        m_heap.pop_back();
        m_now = due.when;
        ++m_ran;
        due.event();
        return true;
    }

    std::uint64_t ran() const { return m_ran; }

private:
    struct Due {
        Instant when;
        std::uint64_t order;
        Event event;
        friend bool operator<(const Due& a, const Due& b) { return a.when != b.when ? a.when > b.when : a.order > b.order; }
    };

    Instant m_now{std::chrono::hours(1)}; ///< far from the zero that stands for "never"
    std::vector<Due> m_heap;
    std::uint64_t m_inserted = 0;
    std::uint64_t m_ran = 0;
};

} // namespace liena::simulation
