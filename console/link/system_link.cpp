// The console's part in the robotic system.
#include "link/system_link.hpp"

#include "link/library_words.hpp"
#include "link/motion_streamer.hpp"
#include "link/pedal_streamer.hpp"
#include "link/session_intake.hpp"
#include "link/translate.hpp"

#include <liena/certificates.hpp>
#include <liena/distributed_system.hpp>
#include <liena/status.hpp>

#include <QCoreApplication>
#include <QDateTime>
#include <QRandomGenerator>

#include <stdexcept>
#include <utility>

namespace console {

namespace {

constexpr std::chrono::milliseconds figuresPeriod{100};

std::filesystem::path path(const QString& text) { return std::filesystem::path(text.toStdU16String()); }

/// The device that the settings name, or the only one that has a cockpit's message set.
std::optional<std::string> deviceName(const LinkSettings& settings, const liena::SystemTopology& topology, QString* error)
{
    if (!settings.device.isEmpty())
        return settings.device.toStdString();
    std::vector<std::string> cockpits;
    for (const auto& device : topology.devices())
        if (device.messageSet == "siat-cockpit")
            cockpits.push_back(device.name);
    if (cockpits.size() == 1)
        return cockpits.front();
    *error = cockpits.empty()
                 ? QObject::tr("%1: no device has the message set siat-cockpit; name this console's with --device").arg(settings.topology)
                 : QObject::tr("%1: %2 devices have the message set siat-cockpit; name this console's with --device")
                       .arg(settings.topology)
                       .arg(cockpits.size());
    return std::nullopt;
}

/// What can be said before the library reads the files.
std::optional<std::string> checkSettings(const LinkSettings& settings, QString* error)
{
    const auto topology = liena::SystemTopology::load(path(settings.topology));
    if (!topology) {
        *error = words(topology.error());
        return std::nullopt;
    }
    const bool identity = !settings.certificate.isEmpty() && !settings.key.isEmpty() && !settings.authority.isEmpty();
    if (topology.value().security() == liena::SecurityMode::Tls && !identity) {
        *error = QObject::tr("%1 asks for TLS: give --certificate, --key and --authority").arg(settings.topology);
        return std::nullopt;
    }
    return deviceName(settings, topology.value(), error);
}

void useNetwork(const NetworkSettings& chosen, liena::Settings& own)
{
    own.realTime.priority = chosen.realTimePriority;
    own.realTime.processors.assign(chosen.processors.begin(), chosen.processors.end());
    own.realTime.lockMemory = chosen.lockMemory;
    own.realTime.cardSearch = std::chrono::microseconds(chosen.cardPollUs);
    own.realTime.search = std::chrono::microseconds(chosen.busyPollUs);
    own.marks = {static_cast<std::uint8_t>(chosen.commandMark), static_cast<std::uint8_t>(chosen.imageMark)};
}

} // namespace

std::unique_ptr<SystemLink> SystemLink::create(const LinkSettings& settings, ConsoleModels& models, FrameSink& sink, QString* error)
{
    const auto device = checkSettings(settings, error);
    if (!device)
        return nullptr;
    liena::Settings own;
    own.topology = path(settings.topology);
    own.device = *device;
    for (const auto& folder : settings.registry)
        own.registry.push_back(path(folder));
    own.store = path(settings.store);
    own.certificate = path(settings.certificate);
    own.key = path(settings.key);
    own.authority = path(settings.authority);
    own.software = "liena-console";
    own.status = liena::statusFolder();
    own.measureOnRequest = settings.measureOnRequest;
    useNetwork(settings.network, own);
    liena::keepKeysOutOfCoreDumps();
    auto system = liena::DistributedSystem::create(std::move(own));
    if (!system) {
        *error = words(system.error());
        return nullptr;
    }
    std::unique_ptr<SystemLink> link(new SystemLink(std::move(system).value(), models, sink));
    if (!link->subscribe(error))
        return nullptr;
    return link;
}

SystemLink::SystemLink(std::unique_ptr<liena::DistributedSystem> system, ConsoleModels& models, FrameSink& sink)
    : m_models(models), m_sink(sink), m_messageIntake(models), m_sessionIntake(models), m_system(std::move(system))
{
    m_models.sessions.setTopology(topologyValues(m_system->topology(), m_system->self().id));
    m_robot = m_models.sessions.firstPeer(DeviceKind::Hand);
    m_xray = m_models.sessions.firstPeer(DeviceKind::Eye);
    m_figures.setInterval(figuresPeriod);
    connect(&m_figures, &QTimer::timeout, this, &SystemLink::readFigures);
}

SystemLink::~SystemLink() { stop(); }

bool SystemLink::subscribe(QString* error)
{
    m_system->cache().setNotification([this] { QMetaObject::invokeMethod(this, &SystemLink::drain, Qt::QueuedConnection); });
    if (m_xray) {
        const auto frames = m_system->subscribeToKeep(
            "XrayFrame", [this](std::shared_ptr<const liena::Message> message) { takeFrame(std::move(message)); });
        if (!frames) {
            *error = words(frames.error());
            return false;
        }
        m_pedal = std::make_unique<PedalStreamer>(*m_system, liena::DeviceId(*m_xray));
        m_system->every(PedalStreamer::period, [this] { m_pedal->run(); });
    }
    if (m_robot) {
        m_motion = std::make_unique<MotionStreamer>(*m_system, liena::DeviceId(*m_robot));
        m_system->every(MotionStreamer::period, [this] { m_motion->run(); });
    }
    return true;
}

void SystemLink::start()
{
    m_system->start();
    m_figures.start();
}

void SystemLink::stop()
{
    m_figures.stop();
    m_system->stop();
}

/// Network thread.
void SystemLink::takeFrame(std::shared_ptr<const liena::Message> message)
{
    if (message->origin().value() != m_xray) {
        if (!m_foreignFrames.exchange(true))
            QMetaObject::invokeMethod(this, [this, origin = message->origin().value()] {
                note(LogKind::Trouble, tr("pictures of %1 are not shown: this console works with %2")
                                           .arg(m_models.sessions.titleOf(origin), m_models.sessions.titleOf(*m_xray)));
            });
        return;
    }
    m_framesReceived.fetch_add(1, std::memory_order_relaxed);
    try {
        m_sink.showFrame(xrayFrame(std::move(message), Duration(m_xrayUncertainty.load(std::memory_order_relaxed))));
    } catch (const std::logic_error& mistake) {
        if (m_frameComplaint.exchange(true))
            return;
        const auto what = text(mistake.what());
        QMetaObject::invokeMethod(
            this, [this, what] { note(LogKind::Trouble, tr("pictures do not have the fields that this console knows: %1").arg(what)); });
    }
}

void SystemLink::drain()
{
    const auto drained = m_system->cache().drain();
    for (const auto& event : drained.events)
        m_sessionIntake.take(event);
    for (const auto& message : drained.messages)
        m_messageIntake.take(message.origin().value(), message);
}

void SystemLink::readFigures()
{
    const auto now = std::chrono::steady_clock::now();
    const auto links = m_system->links();
    m_sessionIntake.takeFigures(links, now);
    for (const auto& status : links)
        if (m_xray && status.peer.value() == *m_xray)
            m_xrayUncertainty.store((status.clockOffset ? status.clockUncertainty : Duration::max()).count(), std::memory_order_relaxed);
    readRobotSet();
    if (m_motion)
        m_models.hand.setCommandsSent(m_motion->sent());
    repeatEmergencyStop();
}

/// The robot's set may be learnt, and learnt anew, with each opening.
void SystemLink::readRobotSet()
{
    const auto set = m_robot ? m_system->messageSet(liena::DeviceId(*m_robot)) : nullptr;
    if (!set)
        return;
    // Said when the set is known, so that nobody finds out by a robot that does not move.
    if (std::exchange(m_robotSet, set) != set) {
        const auto bound = MotionBinding::to(set, "MotionCommand");
        m_models.sessions.setCommandsDiffer(*m_robot, !bound);
        if (!bound)
            note(LogKind::Trouble, tr("%1 cannot be moved from here (%2); compare the message sets")
                                       .arg(m_models.sessions.titleOf(*m_robot), words(bound.error())));
    }
    const auto* command = set->find("MotionCommand");
    const auto* link = m_system->topology().link(m_system->self().id, liena::DeviceId(*m_robot));
    m_models.sessions.setCarried(*m_robot, command && link ? std::optional(roundTripCarried(*command, link->timing)) : std::nullopt);
}

void SystemLink::note(LogKind kind, const QString& line) { m_models.log.append(kind, line, QDateTime::currentMSecsSinceEpoch()); }

void SystemLink::open(quint32 peer)
{
    const auto result = m_system->openChannel(liena::DeviceId(peer));
    if (result || result.error().code == liena::Errc::Busy)
        return; // or it is under way: the second press of a double click
    m_models.sessions.noteOpenFailed(peer, words(result.error()));
    note(LogKind::Trouble, words(result.error()));
}

void SystemLink::openAll()
{
    for (const auto& link : m_models.sessions.links())
        if (link.own && mayOpen(link.state))
            open(link.peer);
}

void SystemLink::close(quint32 peer)
{
    if (const auto result = m_system->closeChannel(liena::DeviceId(peer), "closed by the operator"); !result)
        note(LogKind::Trouble, words(result.error()));
}

void SystemLink::reopen(quint32 peer)
{
    const auto result = m_system->reopenChannel(liena::DeviceId(peer));
    if (!result && result.error().code == liena::Errc::Busy)
        return; // it is under way: the second press of a double click
    note(LogKind::Operator, tr("re-open %1").arg(m_models.sessions.titleOf(peer)));
    if (result)
        return;
    m_models.sessions.noteOpenFailed(peer, words(result.error()));
    if (const auto* link = m_models.sessions.linkTo(peer); link != nullptr && link->incident != 0)
        m_models.incidents.setReopenFailure(link->incident, words(result.error()));
}

void SystemLink::reopenAll()
{
    for (const auto& link : m_models.sessions.links())
        if (link.own && mayReopen(link.state))
            reopen(link.peer);
}

void SystemLink::probe(quint32 peer)
{
    const auto* link = m_models.sessions.linkTo(peer);
    const auto result = m_system->probe(liena::DeviceId(peer));
    if (!result)
        note(LogKind::Trouble, words(result.error()));
    else if (link != nullptr && link->incident != 0)
        m_models.incidents.setProbing(link->incident, true);
}

void SystemLink::dismiss(quint64 incident, const QString& reason)
{
    note(LogKind::Operator, tr("give an incident up: %1").arg(SessionIntake::tr(reason.toUtf8().constData())));
    if (const auto result = m_system->dismissIncident(incident, reason.toStdString()); !result)
        note(LogKind::Trouble, words(result.error()));
}

void SystemLink::sendPermit(quint32 permit, const char* request)
{
    if (!m_robot)
        return;
    const liena::DeviceId robot(*m_robot);
    auto message = m_system->command(robot, "PermitRequest");
    if (!message) {
        note(LogKind::Trouble, words(message.error()));
        return;
    }
    message.value().set("request", std::string_view(request)).set("permit", permit);
    if (const auto sent = m_system->send(robot, std::move(message).value()); !sent)
        note(LogKind::Trouble, tr("permit request not sent: %1").arg(words(sent.error())));
}

void SystemLink::requestArm(quint32 permit) { sendPermit(permit, "arm"); }

void SystemLink::releasePermit(quint32 permit) { sendPermit(permit, "release"); }

void SystemLink::inject(quint32 permit, quint32 number)
{
    if (!m_robot)
        return;
    const liena::DeviceId robot(*m_robot);
    auto message = m_system->command(robot, "ContrastInjection");
    auto sent = message ? liena::Result<void>(liena::ok()) : liena::Result<void>(liena::fail(message.error().code, message.error().what));
    if (message) {
        message.value().set("permit", permit).set("injection", number).set("volume", plannedInjection).set("rate", plannedInjectionRate);
        sent = m_system->send(robot, std::move(message).value());
    }
    if (sent)
        note(LogKind::Operator, tr("injection %1: %2 mL at %3 mL/s asked for")
                                    .arg(number)
                                    .arg(plannedInjection, 0, 'f', 1)
                                    .arg(plannedInjectionRate, 0, 'f', 1));
    else
        m_models.instrument.receiveInjection({number, 0, InjectionProgress::Refused, tr("not sent: %1").arg(words(sent.error()))},
                                             std::chrono::steady_clock::now());
}

void SystemLink::emergencyStop(const QString& reason)
{
    note(LogKind::Operator, tr("EMERGENCY STOP: %1").arg(tr(reason.toUtf8().constData())));
    do // a token of its own: a reset of the one in force, or of the press before, may be on its way
        m_stopToken = QRandomGenerator::system()->generate64();
    while (m_stopToken == 0);
    m_stopReason = reason;
    if (m_robot)
        m_models.instrument.noteStopAsked(m_stopToken, std::chrono::steady_clock::now());
    repeatEmergencyStop();
}

/// Until the robot names the newest: also over a session that is opened later.
void SystemLink::repeatEmergencyStop()
{
    if (m_stopToken == 0 || !m_robot)
        return;
    if (!m_models.instrument.stopUnheard()) {
        m_stopToken = 0;
        return;
    }
    const liena::DeviceId target(*m_robot);
    auto message = m_system->command(target, "EmergencyStop");
    auto sent = message ? liena::Result<void>(liena::ok()) : liena::Result<void>(liena::fail(message.error().code, message.error().what));
    if (message) {
        message.value()
            .set("token", m_stopToken)
            .setPrintable("source", m_system->self().title)
            .setPrintable("reason", m_stopReason.toStdString());
        sent = m_system->send(target, std::move(message).value());
    }
    const auto trouble = sent ? QString() : words(sent.error());
    if (!sent && trouble != m_stopTrouble)
        note(LogKind::Trouble, tr("EMERGENCY STOP NOT SENT: %1. Use the stop at the patient side.").arg(trouble));
    m_stopTrouble = trouble;
}

void SystemLink::resetEmergencyStop()
{
    const auto& status = m_models.instrument.robot();
    if (!m_robot || !status.known() || status.value.emergencyStopToken == 0)
        return;
    const liena::DeviceId robot(*m_robot);
    auto message = m_system->command(robot, "ResetEmergencyStop");
    if (!message)
        return;
    message.value().set("token", status.value.emergencyStopToken);
    const auto sent = m_system->send(robot, std::move(message).value());
    note(LogKind::Operator, sent ? tr("emergency stop reset") : tr("emergency stop not reset: %1").arg(words(sent.error())));
}

void SystemLink::setMotion(const MotionSnapshot& snapshot)
{
    if (m_motion)
        m_motion->publish(snapshot);
}

void SystemLink::setPedal(const PedalSnapshot& snapshot)
{
    if (m_pedal)
        m_pedal->publish(snapshot);
}

void SystemLink::confirmHold(bool holding) { m_system->confirmHold(holding); }

void SystemLink::publish(const CockpitReport& report)
{
    auto message = m_system->report("CockpitStatus");
    if (!message)
        return;
    message.value()
        .set("permit_state", report.phase)
        .set("dead_man", report.deadMan)
        .set("clutch", report.clutch)
        .set("scale", report.scale)
        .set("picture_age", report.pictureAgeMs)
        .set("alarms_high", static_cast<std::uint16_t>(report.alarmsHigh))
        .set("alarms_medium", static_cast<std::uint16_t>(report.alarmsMedium))
        .set("alarms_low", static_cast<std::uint16_t>(report.alarmsLow));
    m_system->publish(message.value());
}

std::optional<BlockedPermit> SystemLink::blockedPermit() const { return m_motion ? m_motion->blockedPermit() : std::nullopt; }

quint64 SystemLink::commandsSent() const { return m_motion ? m_motion->sent() : 0; }

} // namespace console
