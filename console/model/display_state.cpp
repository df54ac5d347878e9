// The display settings in force.
#include "model/display_state.hpp"

#include <algorithm>

namespace console {

namespace {

constexpr int step = 10; ///< %

} // namespace

QString word(MeasureMode mode)
{
    switch (mode) {
    case MeasureMode::Off:
        return DisplayState::tr("off");
    case MeasureMode::Distance:
        return DisplayState::tr("distance");
    case MeasureMode::Angle:
        return DisplayState::tr("angle");
    }
    return QStringLiteral("?");
}

DisplayState::DisplayState(QObject* parent) : QObject(parent) {}

void DisplayState::set(const DisplaySettings& settings)
{
    const DisplaySettings bounded = withinBounds(settings);
    if (bounded == m_settings)
        return;
    m_settings = bounded;
    Q_EMIT changed(m_settings);
}

void DisplayState::setAutomatic()
{
    DisplaySettings next = m_settings;
    next.window = WindowChoice::Automatic;
    set(next);
}

void DisplayState::nextWindow()
{
    DisplaySettings next = m_settings;
    switch (m_settings.window) {
    case WindowChoice::AsSent:
        next.window = WindowChoice::FullRange;
        break;
    case WindowChoice::FullRange:
        next.window = WindowChoice::Narrow;
        break;
    case WindowChoice::Narrow:
        next.window = WindowChoice::Wide;
        break;
    case WindowChoice::Wide:
    case WindowChoice::Automatic:
    case WindowChoice::Fixed:
        next.window = WindowChoice::AsSent;
        break;
    }
    set(next);
}

void DisplayState::nextFunction()
{
    DisplaySettings next = m_settings;
    next.function = static_cast<VoiFunction>((static_cast<int>(next.function) + 1) % 3);
    set(next);
}

void DisplayState::nextShutter()
{
    DisplaySettings next = m_settings;
    next.shutter = static_cast<ShutterShape>((static_cast<int>(next.shutter) + 1) % 3);
    set(next);
}

void DisplayState::toggleInverted()
{
    DisplaySettings next = m_settings;
    next.inverted = !next.inverted;
    set(next);
}

void DisplayState::stepNoiseReduction(int steps)
{
    DisplaySettings next = m_settings;
    next.noiseReduction += steps * step;
    set(next);
}

void DisplayState::stepEdge(int steps)
{
    DisplaySettings next = m_settings;
    next.edge += steps * step;
    set(next);
}

void DisplayState::setWindow(GreyWindow window, const WindowBasis& basis)
{
    DisplaySettings next = m_settings;
    next.window = WindowChoice::Fixed;
    next.fixed = window;
    next.fixedOn = basis;
    set(next);
}

void DisplayState::reset() { set({}); }

void DisplayState::nextMeasureMode()
{
    m_measure = static_cast<MeasureMode>((static_cast<int>(m_measure) + 1) % 3);
    Q_EMIT measureModeChanged(m_measure);
}

void DisplayState::nextPlane()
{
    MeasurePlane next = m_plane;
    if (!next.object) {
        next.object = m_usualObject;
    } else {
        const auto* const at = std::find(objectHeights.begin(), objectHeights.end(), *next.object);
        const bool wraps = at == objectHeights.end() || at + 1 == objectHeights.end();
        next.object = wraps ? objectHeights.front() : *(at + 1);
        if (at == objectHeights.end() || next.object == m_usualObject)
            next.object.reset();
    }
    setPlane(next);
}

void DisplayState::setTable(std::optional<int> tableTop, int usualObject)
{
    MeasurePlane next = m_plane;
    next.tableTop = tableTop;
    if (next.object && usualObject != m_usualObject)
        next.object = usualObject;
    m_usualObject = usualObject;
    setPlane(next);
}

void DisplayState::setPlane(const MeasurePlane& plane)
{
    if (plane == m_plane)
        return;
    m_plane = plane;
    Q_EMIT planeChanged(m_plane);
}

} // namespace console
