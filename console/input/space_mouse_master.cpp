// Which way of the cap does what.
#include "input/space_mouse_master.hpp"

namespace console {

namespace {

constexpr int deadManButton = 0;
constexpr int clutchButton = 1;

enum Way : std::size_t { Right, Up, Away, TiltBack, TwistLeft, TiltRight };

/// Advance and clockwise from behind positive.
HandAxes axesOf(const PuckDeflection& cap)
{
    const auto way = [&cap](Way which) { return static_cast<double>(cap.at(which)); };
    return {way(Away), -way(TwistLeft), way(Up), way(TiltRight)};
}

} // namespace

SpaceMouseMaster::SpaceMouseMaster(QObject* parent) : ConnectedMaster(parent)
{
    connect(&m_line, &SpnavLine::came, this, [this] {
        forget();
        setConnected(true);
    });
    connect(&m_line, &SpnavLine::went, this, [this] {
        setConnected(false);
        forget();
    });
    connect(&m_line, &SpnavLine::deflected, this, [this](const PuckDeflection& deflection) {
        m_deflection = deflection;
        m_told.reset(); // the next poll says when
        m_expired = false;
        follow();
    });
    connect(&m_line, &SpnavLine::buttonChanged, this, [this](int button, bool pressed) {
        if (button == deadManButton)
            m_deadMan = pressed;
        else if (button == clutchButton)
            m_clutch = pressed;
        follow();
    });
    m_line.start();
}

QString SpaceMouseMaster::legend() const
{
    return tr("left button dead-man · push, twist guidewire · lift, tilt catheter · right button clutch · F X-ray · R arm · G inject · "
              "Page Up/Down scale");
}

void SpaceMouseMaster::forget()
{
    m_deflection = {};
    m_told.reset();
    m_expired = m_deadMan = m_clutch = false;
}

void SpaceMouseMaster::take(Instant now)
{
    if (!connected())
        return;
    if (!m_told)
        m_told = now;
    m_expired = now - *m_told > deflectionLasts;
    follow();
}

void SpaceMouseMaster::follow()
{
    const auto moved = mapped(axesOf(m_deflection), cap, m_speeds, Coupling::Larger);
    HandControls controls;
    controls.deadMan = m_deadMan;
    controls.clutch = m_clutch;
    if (!m_expired)
        controls.motion = moved.motion;
    controls.axesAtRest = moved.atRest;
    tell(controls);
}

} // namespace console
