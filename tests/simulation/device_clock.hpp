// What one device's clocks say: a monotonic clock that drifts, and a wall clock that may be stepped.
#pragma once

#include "session/instant.hpp"

#include <cstdint>

namespace liena::simulation {

class DeviceClock {
public:
    using Instant = session::Instant;
    using Nanoseconds = session::Nanoseconds;

    /// `drift` in parts per million. `wall` is what the wall clock says at the world's time zero.
    DeviceClock(std::int64_t drift, std::int64_t wall) : m_drift(drift), m_wall(wall) {}

    /// The monotonic clock starts over with the device's process; only differences mean something.
    Instant mono(Instant world) const
    {
        const auto elapsed = world.time_since_epoch().count();
        return Instant(Nanoseconds(elapsed + elapsed / million * m_drift + elapsed % million * m_drift / million));
    }

    Timestamp wall(Instant world) const { return {static_cast<std::uint64_t>(m_wall + mono(world).time_since_epoch().count())}; }

    /// The first moment of the world at which mono() has reached `local`.
    Instant worldAt(Instant local) const
    {
        const auto count = local.time_since_epoch().count();
        Instant world(Nanoseconds(count - count / million * m_drift));
        while (mono(world) > local)
            world -= mono(world) - local;
        while (mono(world) < local)
            world += local - mono(world);
        return world;
    }

    void step(Nanoseconds by) { m_wall += by.count(); }

private:
    static constexpr std::int64_t million = 1'000'000;

    std::int64_t m_drift;
    std::int64_t m_wall;
};

} // namespace liena::simulation
