// The bursts as sound samples, reckoned and not recorded.
#pragma once

#include "model/alarm_burst.hpp"

#include <QByteArray>

namespace console {

inline constexpr int sampleRate = 44100;

/// One channel, 16 bit, native order. Each pulse has four harmonics, so that it can be located and is heard through noise, and soft edges,
/// so that it does not click.
QByteArray burstSamples(AlarmPriority priority);

} // namespace console
