// The flash clock: from edge to edge.
#include "widgets/flash_clock.hpp"

#include <algorithm>

namespace console {

using namespace std::chrono_literals;

namespace {

constexpr Duration highHalf = 250ms;
constexpr Duration mediumHalf = Duration(5s) / 6; // 0.6 Hz

bool firstHalf(Duration phase, Duration half) { return (phase / half) % 2 == 0; }

} // namespace

FlashClock::FlashClock(QObject* parent) : QObject(parent), m_begun(std::chrono::steady_clock::now())
{
    m_timer.setTimerType(Qt::PreciseTimer);
    m_timer.setSingleShot(true);
    connect(&m_timer, &QTimer::timeout, this, &FlashClock::proceed);
    proceed();
}

bool FlashClock::litAt(AlarmPriority priority, Duration phase)
{
    switch (priority) {
    case AlarmPriority::High:
        return firstHalf(phase, highHalf);
    case AlarmPriority::Medium:
        return firstHalf(phase, mediumHalf);
    case AlarmPriority::Low:
        break;
    }
    return true;
}

void FlashClock::drive(Duration phase)
{
    m_timer.stop();
    m_phase = phase;
    Q_EMIT ticked();
}

/// By the time that has passed, not by the number of ticks: a screen that was late does not stay late.
void FlashClock::proceed()
{
    m_phase = std::chrono::steady_clock::now() - m_begun;
    Q_EMIT ticked();
    const auto edge = m_begun + m_phase + std::min(highHalf - m_phase % highHalf, mediumHalf - m_phase % mediumHalf);
    const auto left = edge - std::chrono::steady_clock::now(); // whoever was told may have taken some of it
    m_timer.start(std::max(0ms, std::chrono::ceil<std::chrono::milliseconds>(left)));
}

} // namespace console
