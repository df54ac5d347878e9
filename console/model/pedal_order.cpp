// The last check before an exposure is asked for.
#include "model/pedal_order.hpp"

namespace console {

std::optional<PedalOrder> PedalGate::compose(const PedalSnapshot& snapshot, Instant now)
{
    if (snapshot.down && now - snapshot.guiTick > guiLimit)
        m_endedPress = snapshot.press;
    PedalOrder order{snapshot.down && snapshot.press != m_endedPress, snapshot.press, snapshot.pulseRate};
    if (order.pedal) {
        m_stopsLeft = stops;
        return order;
    }
    if (m_stopsLeft == 0)
        return std::nullopt;
    --m_stopsLeft;
    return order;
}

} // namespace console
