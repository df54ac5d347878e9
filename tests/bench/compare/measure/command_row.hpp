// Since when each of a row of commands is there, by itself or by a newer one in its place: one that never comes is not left out.
#pragma once

#include "measure/stamp.hpp"

#include <cstdint>
#include <vector>

namespace liena::compare {

/// Commands that are numbered from 1 in the order in which they were due.
class CommandRow {
public:
    /// The commands that are there with the one that came, each with the moment at which it was due: itself and those missing before it.
    /// Those are taken to have been due evenly. None when a newer one was there already.
    const std::vector<Stamp>& come(const Stamp& stamp)
    {
        m_there.clear();
        if (stamp.number <= m_newest.number)
            return m_there;
        const auto steps = static_cast<std::int64_t>(stamp.number - m_newest.number);
        for (std::int64_t i = m_newest.number > 0 ? 1 : steps; i < steps; ++i)
            m_there.push_back(
                {m_newest.number + static_cast<std::uint64_t>(i), m_newest.sentNs + (stamp.sentNs - m_newest.sentNs) * i / steps});
        m_missing += m_there.size();
        m_there.push_back(stamp);
        m_newest = stamp;
        return m_there;
    }

    /// Those of which only a newer one was there.
    std::uint64_t missing() const { return m_missing; }

private:
    Stamp m_newest;
    std::uint64_t m_missing = 0;
    std::vector<Stamp> m_there;
};

} // namespace liena::compare
