// The times of invented pictures that were painted.
#pragma once

#include "model/picture_state.hpp"

namespace console::test {

using namespace std::chrono_literals;

inline const Instant start = Instant{} + 1h;

inline PictureStamp stamp(quint32 frame, Instant painted, std::optional<Duration> age = 80ms)
{
    PictureStamp s;
    s.frame = frame;
    s.acquisition = 1;
    s.source = PictureSource::Simulated;
    s.captureNs = frame;
    if (age)
        s.captured = painted - *age;
    s.arrived = painted - 30ms;
    s.painted = painted;
    return s;
}

/// Fifteen pictures a second for `length`, the last one at its end.
inline Instant play(PictureState& state, Instant from, Duration length)
{
    quint32 frame = state.newest() ? state.newest()->frame : 0;
    auto at = from;
    for (; at <= from + length; at += 66ms)
        state.notePainted(stamp(++frame, at));
    return at - 66ms;
}

} // namespace console::test
