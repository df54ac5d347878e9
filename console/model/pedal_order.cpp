// The last check before an exposure is asked for.
#include "model/pedal_order.hpp"

#include <utility>

namespace console {

std::optional<PedalOrder> PedalGate::compose(const PedalSnapshot& snapshot, Instant now)
{
    if (std::exchange(m_press, snapshot.press) != snapshot.press)
        m_startsLeft = starts;
    if (snapshot.down && now - snapshot.guiTick > guiLimit)
        m_endedPress = snapshot.press;
    PedalOrder order{snapshot.down && snapshot.press != m_endedPress, snapshot.press, snapshot.pulseRate};
    if (order.pedal) {
        m_stopsLeft = stops;
        if (m_startsLeft == 0)
            return order;
        --m_startsLeft;
        return PedalOrder{false, snapshot.press - 1, snapshot.pulseRate}; // under the press before, since what is heard up is spent
    }
    if (m_stopsLeft == 0)
        return std::nullopt;
    --m_stopsLeft;
    return order;
}

} // namespace console
