// Frames on a path in virtual time, beside computers and networks that stand still for moments.
#pragma once

#include "support/standstills.hpp"
#include "support/virtual_path.hpp"

#include <algorithm>
#include <chrono>
#include <optional>
#include <tuple>
#include <utility>

namespace liena::test {

/// Frames of so many bytes as the path carries in 16.8 ms.
class VirtualFrames {
public:
    using Nanoseconds = std::chrono::nanoseconds;

    VirtualFrames(VirtualPath& path, int perSecond) : m_path(path), m_bytes(path.capacity * 0.0168), m_period(1'000'000'000 / perSecond) {}

    /// How long it took. `stillFor`: the network, or the sender, stands still so long once the frame has taken `moment`.
    Nanoseconds send(Nanoseconds stillFor = {}, Nanoseconds moment = {}, bool ofTheNetwork = false)
    {
        Nanoseconds taken{};
        m_path.run(0ns, false);
        m_path.give(m_bytes);
        for (; m_path.unsent() > 0 && taken < 1s; taken += 250us) {
            if (stillFor > 0ns && taken >= moment) {
                standStill(stillFor, ofTheNetwork);
                taken += std::exchange(stillFor, 0ns);
            }
            taken += standStillIfDue();
            const auto counted = std::pair(m_path.late, m_path.veryLate);
            m_path.goOn(250us);
            m_running += 250us;
            if (m_running < m_countedFrom)
                std::tie(m_path.late, m_path.veryLate) = counted;
        }
        m_path.run(std::max(m_period - taken, Nanoseconds::zero()), false);
        return taken;
    }

    /// Eight times a second of sending, for 0.5 to 5 ms: the sender's computer or the network, by turns of chance.
    void standsStillAtTimes(unsigned seed)
    {
        m_standstills = Standstills(8, 5ms, seed);
        m_nextStandstill = m_running + m_standstills->untilNext();
    }

private:
    void standStill(Nanoseconds time, bool ofTheNetwork)
    {
        m_path.stalled = ofTheNetwork;
        ofTheNetwork ? m_path.goOn(time) : m_path.standStill(time);
        m_path.stalled = false;
    }

    Nanoseconds standStillIfDue()
    {
        if (!m_standstills || m_running < m_nextStandstill)
            return {};
        const auto time = m_standstills->length();
        const bool ofTheNetwork = m_standstills->coin();
        const auto counted = std::pair(m_path.late, m_path.veryLate);
        standStill(time, ofTheNetwork);
        std::tie(m_path.late, m_path.veryLate) = counted;
        if (ofTheNetwork)
            m_countedFrom = m_running + 3 * time + 5ms; // then what gathered meanwhile is gone
        m_nextStandstill = m_running + m_standstills->untilNext();
        return time;
    }

    VirtualPath& m_path;
    double m_bytes;
    Nanoseconds m_period;
    Nanoseconds m_running{}; ///< so long sent
    std::optional<Standstills> m_standstills;
    Nanoseconds m_nextStandstill{};
    Nanoseconds m_countedFrom{}; ///< what waits
};

} // namespace liena::test
