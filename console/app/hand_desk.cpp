// From the masters to the model.
#include "app/hand_desk.hpp"

#include "input/game_pad_master.hpp"
#include "input/hand_scale.hpp"
#include "input/recorded_master.hpp"
#include "input/sdl_pads.hpp"
#include "input/simulated_haptic_master.hpp"
#include "input/space_mouse_master.hpp"

#include <QDateTime>

namespace console {

namespace {

constexpr double scaleStep = 0.1;

Instant presentTime() { return std::chrono::steady_clock::now(); }

} // namespace

HandDesk::HandDesk(const Options& options, ConsoleModels& models, QObject* parent) : QObject(parent), m_options(options), m_models(models)
{
    connectRack();
}

HandDesk::~HandDesk() = default;

void HandDesk::connectRack()
{
    connect(&m_rack, &MasterRack::lifeChanged, this, [this] {
        read(presentTime());
        note();
        Q_EMIT lifeChanged();
    });
    connect(&m_rack, &MasterRack::deadManChanged, this, [this](bool pressed) {
        read(presentTime());
        Q_EMIT deadManChanged(pressed);
    });
    connect(&m_rack, &MasterRack::inUseChanged, this, &HandDesk::inUseChanged);
    connect(&m_rack, &MasterRack::armHeldChanged, this, &HandDesk::armHeldChanged);
    connect(&m_rack, &MasterRack::pedalChanged, this, &HandDesk::pedalChanged);
    connect(&m_rack, &MasterRack::injectHeldChanged, this, &HandDesk::injectHeldChanged);
    connect(&m_rack, &MasterRack::resetHeldChanged, this, &HandDesk::resetHeldChanged);
    connect(&m_rack, &MasterRack::scaleStepRequested, this, &HandDesk::stepScale);
    connect(&m_rack, &MasterRack::holdRequested, this, &HandDesk::holdRequested);
}

bool HandDesk::prepare(QString* error)
{
    add(std::make_unique<SpaceMouseMaster>());
    add(std::make_unique<GamePadMaster>(std::make_unique<SdlPads>()));
    if (m_options.master == MasterKind::HapticSimulated)
        add(std::make_unique<SimulatedHapticMaster>(m_keyboard));
    if (!m_options.recording.isEmpty()) {
        auto samples = RecordedMaster::load(m_options.recording, error);
        if (samples.empty())
            return false;
        add(std::make_unique<RecordedMaster>(std::move(samples)));
    }
    m_rack.begin(m_options.master);
    read(presentTime());
    return true;
}

void HandDesk::add(std::unique_ptr<MasterDevice> device)
{
    m_rack.add(*device);
    m_devices.push_back(std::move(device));
}

void HandDesk::poll(Instant now)
{
    m_rack.poll(now);
    m_rack.feel(robotForce(now), now);
    read(now);
    note();
}

void HandDesk::read(Instant now)
{
    const auto hand = m_rack.read(now);
    HandReading reading;
    reading.alive = hand.alive;
    reading.deadMan = hand.deadMan;
    reading.clutch = hand.clutch;
    reading.scale = m_scale;
    if (m_scaleChanged && now - *m_scaleChanged < scaleAnnounced)
        reading.scaleBefore = m_scaleBefore;
    reading.motion = askedMotion(hand.motion, m_scale, hand.alive && hand.deadMan, hand.clutch);
    reading.forceToHand = m_rack.inUse().forceToHand();
    m_models.hand.set(reading);
    m_models.hand.setMasters(m_rack.statuses(now));
}

/// Felt only while the hand moves the robot, both ends say so, and what is felt is recent.
RobotForce HandDesk::robotForce(Instant now) const
{
    const auto& robot = m_models.instrument.robot().value;
    const auto peer = m_models.sessions.firstPeer(DeviceKind::Hand);
    const bool open = peer && m_models.sessions.state(*peer) == LinkState::Open;
    const bool engaged = m_models.permit.phase() == PermitPhase::Engaged && robot.engaged && robot.state == RobotState::Engaged;
    return {robot.guidewireForce, open && engaged && m_models.instrument.robotFresh(now)};
}

void HandDesk::rezero(Instant now)
{
    m_rack.rezero(now);
    read(now);
}

void HandDesk::setListening(bool listening) { m_rack.setListening(listening); }

void HandDesk::choose(MasterKind kind)
{
    const auto now = presentTime();
    if (m_rack.choose(kind, m_models.permit.phase(), now))
        read(now);
}

void HandDesk::stepScale(int steps)
{
    const double before = m_scale;
    m_scale = nextScale(m_scale, m_scale + steps * scaleStep, m_models.permit.phase() == PermitPhase::Engaged);
    if (m_scale == before)
        return;
    const Instant now = presentTime();
    if (!m_scaleChanged || now - *m_scaleChanged >= scaleAnnounced)
        m_scaleBefore = before; // several steps are one change
    m_scaleChanged = now;
    read(now);
    m_models.log.append(LogKind::Operator, tr("scale %1 : 1, before %2 : 1").arg(m_scale, 0, 'f', 2).arg(before, 0, 'f', 2),
                        QDateTime::currentMSecsSinceEpoch());
}

QString HandDesk::missing() const
{
    const auto* master = m_models.hand.masterInUse();
    if (master == nullptr || m_models.hand.reading().alive)
        return {};
    return tr("%1: %2").arg(master->name, word(master->life));
}

/// In the log: which master is in use, and what became of it. That the keys go to and fro between window and prompt is no news.
void HandDesk::note()
{
    noteRemarks();
    const auto* master = m_models.hand.masterInUse();
    if (master == nullptr || master->life == MasterLife::Unheard)
        return;
    const auto line = tr("hand: %1, %2").arg(master->name, word(master->life));
    if (line == m_noted)
        return;
    m_noted = line;
    const bool good = master->life == MasterLife::Alive || master->life == MasterLife::Unreleased;
    m_models.log.append(good ? LogKind::Note : LogKind::Trouble, line, QDateTime::currentMSecsSinceEpoch());
}

/// Each note once, of every master: that a pad is refused, or that the daemon of mice is too old.
void HandDesk::noteRemarks()
{
    for (const auto& master : m_models.hand.masters()) {
        if (master.note.isEmpty() || m_remarks.contains(master.note))
            continue;
        m_remarks << master.note;
        const auto kind = master.life == MasterLife::Gone ? LogKind::Trouble : LogKind::Note;
        m_models.log.append(kind, tr("%1: %2").arg(master.name, master.note), QDateTime::currentMSecsSinceEpoch());
    }
}

} // namespace console
