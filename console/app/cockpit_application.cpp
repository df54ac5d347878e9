// The composition root.
#include "app/cockpit_application.hpp"

#include "editor/topology_canvas.hpp"
#include "editor/topology_view.hpp"
#include "imaging/scene_view.hpp"
#include "model/input_origin.hpp"
#include "model/present_readings.hpp"
#include "widgets/cockpit_window.hpp"
#include "widgets/log_view.hpp"
#include "widgets/theme.hpp"

#include <QApplication>
#include <QDateTime>

#include <cstdio>

namespace console {

namespace {

constexpr std::chrono::milliseconds scenePeriod{50};

} // namespace

CockpitApplication::CockpitApplication(const Options& options)
    : m_options(options), m_pictures(options, m_models), m_hand(m_options, m_models)
{
    m_models.picture.setProfile(options.profile);
    m_models.picture.setRehearsal(options.rehearsal);
    const auto environment = QProcessEnvironment::systemEnvironment();
    m_models.remoteInput = remoteInputOf(QGuiApplication::platformName(), environment);
    m_seat = seatBusesOf(QGuiApplication::platformName(), environment);
    if (m_options.registry.isEmpty())
        if (const auto folder = resource(QStringLiteral("devices")); !folder.isEmpty())
            m_options.registry << folder;
    if (m_options.vessels.isEmpty())
        m_options.vessels = resource(QStringLiteral("vessels/cerebral.swc"));
    if (m_options.unattended && m_options.recording.isEmpty())
        m_options.recording = resource(QStringLiteral("recordings/jog.csv"));
}

CockpitApplication::~CockpitApplication()
{
    if (m_control)
        m_control->stop();
    // Told before the sessions close, which takes its time in this thread.
    m_alarms.reset();
    if (m_link)
        m_link->stop();
}

void CockpitApplication::skipTestSignals()
{
    auto later = std::chrono::steady_clock::now();
    while (m_models.selfTest.signal())
        m_models.selfTest.update(false, later += AlarmSelfTest::whole.high);
}

bool CockpitApplication::prepare(QString* error)
{
    if (m_options.unattended && m_options.recording.isEmpty())
        return *error = tr("the recording that comes with LiENa is missing; name one with --recording"), false;
    if (!m_hand.prepare(error) || !m_pictures.prepare(error))
        return false;
    LinkSettings settings{m_options.topology, m_options.device,    m_options.registry,         m_options.store,  m_options.certificate,
                          m_options.key,      m_options.authority, m_options.measureOnRequest, m_options.network};
    m_link = SystemLink::create(settings, m_models, m_pictures.pipeline(), error);
    if (!m_link)
        return false;
    if (m_options.rehearsal && !rehearsesHere(error))
        return false;
    m_control = std::make_unique<CockpitControl>(m_models, *m_link, m_hand);
    buildAlarms();
    buildWindow();
    return true;
}

/// By a recording nothing is moved but what this computer simulates: a robot elsewhere may be a real one.
bool CockpitApplication::rehearsesHere(QString* error) const
{
    const auto& sessions = m_models.sessions;
    for (const auto& device : sessions.devices()) {
        const bool moves = device.kind == DeviceKind::Hand || device.kind == DeviceKind::Arm;
        if (moves && !device.self && !device.onThisComputer && sessions.linkTo(device.id) != nullptr)
            return *error =
                       tr("--rehearsal lets a recording stand for the live picture, and \"%1\" at %2 is not on this computer: it may be "
                          "a real robot; name devices at a loopback address in the topology, or start without --rehearsal")
                           .arg(device.title, device.address),
                   false;
    }
    return true;
}

void CockpitApplication::buildAlarms()
{
    const auto* self = m_models.sessions.self();
    const auto name = QStringLiteral("alarms-") + (self != nullptr ? self->idText() : QStringLiteral("unknown"));
    m_alarms = std::make_unique<AlarmService>(m_models, m_control->alarmWatch(),
                                              AlarmSettings{m_options.alarmLog, name, m_options.watchdog, m_options.player, m_voice});
}

void CockpitApplication::buildWindow()
{
    m_models.role = m_options.role;
    m_window = std::make_unique<CockpitWindow>(m_models);
    m_scene = new SceneView;
    theme::setTextRole(m_scene, theme::TextRole::Caption);
    m_pictures.build(*m_window);
    m_window->setSceneView(m_scene);
    buildTopology();
    buildLog();
    m_views.build(*m_window);
    m_preferences.build(*m_window);
    m_screens = std::make_unique<ScreenDesk>(m_options, m_models, m_pictures, *m_window);
    if (!m_options.vessels.isEmpty())
        m_scene->loadVessels(m_options.vessels);
    m_window->setOperator(m_options.user);
    m_window->setPatient(m_options.patient, m_options.patientId);
    m_window->setRehearsal(m_options.rehearsal);
    connectIntents();
    connectAlarms();
    connectHand();
    connectPictures();
    connectSeat();
}

void CockpitApplication::buildTopology()
{
    auto* view = new TopologyView(m_models.sessions);
    m_window->setTopologyView(view);
    auto* mini = new TopologyCanvas(m_models.sessions, TopologyCanvas::Size::Mini);
    m_window->setMiniTopology(mini);
    connect(mini, &TopologyCanvas::chosen, m_window.get(), [this] { m_window->showView(View::Topology); });
    auto* link = m_link.get();
    connect(view, &TopologyView::openRequested, link, &SystemLink::open);
    connect(view, &TopologyView::closeRequested, link, &SystemLink::close);
    connect(view, &TopologyView::reopenRequested, link, &SystemLink::reopen);
    connect(view, &TopologyView::openAllRequested, link, &SystemLink::openAll);
}

void CockpitApplication::buildLog()
{
    auto* view = new LogView(m_models.log, m_models.alarmLog);
    view->setPathSuggestion(suggestedLogPath);
    m_pictures.joinLog(*view);
    m_window->setLogView(view);
    connect(view, &LogView::leaveRequested, m_window.get(), [this] { m_window->showView(View::Cockpit); });
    connect(view, &LogView::saveRequested, &m_logSaver, &LogSaver::save);
    connect(&m_logSaver, &LogSaver::saved, view, [this, view](const QString& path) {
        m_models.log.append(LogKind::Note, tr("log saved: %1").arg(path), QDateTime::currentMSecsSinceEpoch());
        view->showSaved(path);
    });
    connect(m_window.get(), &CockpitWindow::reportRequested, &m_reportSaver,
            [this](const QString& text) { m_reportSaver.save(text.toUtf8(), suggestedLogPath(QStringLiteral("incident"))); });
    connect(m_window.get(), &CockpitWindow::patientSideCallRequested, this, [this] {
        const QString how = m_models.patientSide.isEmpty() ? tr("how is not set up") : m_models.patientSide;
        m_models.log.append(LogKind::Operator, tr("call the patient side: %1").arg(how), QDateTime::currentMSecsSinceEpoch());
    });
    connect(&m_reportSaver, &LogSaver::saved, m_window.get(), [this](const QString& path) {
        m_models.log.append(LogKind::Note, tr("report saved: %1").arg(path), QDateTime::currentMSecsSinceEpoch());
        m_window->showReportNote(tr("Report saved: %1").arg(path));
    });
    connect(&m_reportSaver, &LogSaver::failed, m_window.get(), [this](const QString& reason) {
        m_models.log.append(LogKind::Trouble, reason, QDateTime::currentMSecsSinceEpoch());
        m_window->showReportNote(reason);
    });
    connect(&m_logSaver, &LogSaver::failed, view, [this, view](const QString& reason) {
        m_models.log.append(LogKind::Trouble, reason, QDateTime::currentMSecsSinceEpoch());
        view->showFailure(reason);
    });
}

void CockpitApplication::connectIntents()
{
    auto* window = m_window.get();
    auto* link = m_link.get();
    connect(window, &CockpitWindow::openRequested, link, &SystemLink::open);
    connect(window, &CockpitWindow::openAllRequested, link, &SystemLink::openAll);
    connect(window, &CockpitWindow::closeRequested, link, &SystemLink::close);
    connect(window, &CockpitWindow::reopenRequested, link, &SystemLink::reopen);
    connect(window, &CockpitWindow::reopenAllRequested, link, &SystemLink::reopenAll);
    connect(window, &CockpitWindow::probeRequested, link, &SystemLink::probe);
    connect(window, &CockpitWindow::dismissRequested, link, [link](quint64 incident) {
        link->dismiss(incident, QString::fromLatin1(QT_TRANSLATE_NOOP("console::SessionIntake", "given up by the operator")));
    });
    connect(window, &CockpitWindow::interruptionReadRequested, m_control.get(),
            [this] { m_control->interruptionWatch().acknowledge(m_options.user, std::chrono::steady_clock::now()); });
    connect(window, &CockpitWindow::emergencyStopRequested, link, [this](const QString& reason) {
        m_control->panicHold(); // what the robot hears of it is another matter: from here no motion goes out any more
        m_link->emergencyStop(reason);
    });
    connect(window, &CockpitWindow::emergencyStopResetRequested, link, &SystemLink::resetEmergencyStop);
    connect(window, &CockpitWindow::closingRefused, this, [this](const QString& why, const QString& first) {
        m_models.log.append(LogKind::Operator, tr("not closed: %1. %2").arg(why, first), QDateTime::currentMSecsSinceEpoch());
    });
}

/// The cockpit's close is the end of the program with all its windows; no other window's is, and none keeps it running.
void CockpitApplication::endWithTheCockpit()
{
    QGuiApplication::setQuitOnLastWindowClosed(false);
    connect(m_window.get(), &CockpitWindow::closed, this, [this] {
        m_alarms->noteClosed(m_options.user);
        if (!m_unattended) // which ends by itself
            QCoreApplication::exit(0);
    });
}

void CockpitApplication::connectAlarms()
{
    auto* window = m_window.get();
    auto* alarms = m_alarms.get();
    connect(window, &CockpitWindow::acknowledgeRequested, alarms, [this](quint64 alarm) { m_alarms->acknowledge(alarm, m_options.user); });
    connect(window, &CockpitWindow::audioPauseRequested, alarms, [this] { m_alarms->toggleAudioPause(m_options.user); });
    connect(window, &CockpitWindow::incidentMarkRequested, alarms, [this] {
        m_alarms->markIncident(m_options.user);
        m_window->showIncidentMarked();
    });
    connect(window, &CockpitWindow::alarmTestRequested, alarms, &AlarmService::beginSelfTest);
    connect(window, &CockpitWindow::alarmTestAnswered, alarms, [this](bool seenAndHeard) {
        m_alarms->answerSelfTest(seenAndHeard, m_options.unattended ? tr("the unattended run, no person") : m_options.user);
    });
}

void CockpitApplication::connectHand()
{
    auto* window = m_window.get();
    auto* control = m_control.get();
    connect(window, &CockpitWindow::armHoldChanged, control, &CockpitControl::setArmHeld);
    connect(window, &CockpitWindow::pedalChanged, control, &CockpitControl::setPedal);
    connect(window, &CockpitWindow::injectHoldChanged, control, &CockpitControl::setInjectHeld);
    connect(window, &CockpitWindow::panicHoldRequested, control, &CockpitControl::panicHold);
    connect(window, &CockpitWindow::forceAccepted, control, [this](double newtons) { m_control->acceptForce(newtons, m_options.user); });
    connect(window, &CockpitWindow::handFocusChanged, control, &CockpitControl::setHandHasKeys);
    auto* keyboard = &m_hand.keyboard();
    connect(window, &CockpitWindow::handKeyPressed, keyboard, [keyboard](int key) { keyboard->press(key); });
    connect(window, &CockpitWindow::handKeyReleased, keyboard, [keyboard](int key) { keyboard->release(key); });
    connect(window, &CockpitWindow::masterChosen, &m_hand, &HandDesk::choose);
    connect(&m_hand, &HandDesk::resetHeldChanged, window, &CockpitWindow::setResetHeld);
    const auto legend = [this] { m_window->setKeyLegend(m_hand.legend()); };
    connect(&m_hand, &HandDesk::inUseChanged, window, legend);
    legend();
    control->setHandHasKeys(window->handHasKeys());
}

void CockpitApplication::connectPictures()
{
    connect(&m_pictures.pipeline(), &FramePipeline::pictureReady, m_scene, &SceneView::showPicture);
    connect(&m_models.picture, &PictureState::refused, this, [this](const QString& reason) {
        m_models.log.append(LogKind::Trouble, tr("picture refused: %1").arg(reason), QDateTime::currentMSecsSinceEpoch());
    });
    connect(&m_models.picture, &PictureState::reductionChanged, this, [this](const PictureReduction& reduction) {
        const QString what = reduction.stands() ? tr("picture %1: the line does not carry more").arg(line(reduction))
                                                : tr("picture as asked for again, in rate and encoding");
        m_models.log.append(reduction.stands() ? LogKind::Trouble : LogKind::Note, what, QDateTime::currentMSecsSinceEpoch());
    });
    m_sceneClock.setInterval(scenePeriod);
    connect(&m_sceneClock, &QTimer::timeout, this, &CockpitApplication::refreshScene);
}

void CockpitApplication::connectSeat()
{
    m_seatWatch = std::make_unique<SeatWatch>(m_seat);
    const auto note = [this](const QString& line) { m_models.log.append(LogKind::Note, line, QDateTime::currentMSecsSinceEpoch()); };
    connect(m_seatWatch.get(), &SeatWatch::notSeen, m_window.get(), [this, note](const QString& why) {
        m_window->setUnseen(why); // before anything else: what moves, stops
        note(tr("the hand has no keys: %1").arg(why));
    });
    connect(m_seatWatch.get(), &SeatWatch::seen, m_window.get(), [this, note] {
        m_window->setUnseen({});
        note(tr("the screen is in sight again"));
    });
    connect(m_seatWatch.get(), &SeatWatch::remarked, m_window.get(), note);
}

void CockpitApplication::refreshScene()
{
    const auto now = std::chrono::steady_clock::now();
    const auto& xray = m_models.xray;
    m_scene->showTip(shownTip(m_models, m_link->robot(), now), !m_models.instrument.tipFresh(now));
    const auto& account = m_models.interruption;
    m_scene->showTipBefore(account.stage() == InterruptionAccount::Stage::Unread ? account.before().tip : std::nullopt);
    m_scene->showCArm(xray.fresh(now) ? std::optional<XrayGeometry>(xray.status().value.geometry) : std::nullopt);
    m_scene->showCondition(m_models.picture.reading(now).condition);
}

void CockpitApplication::showWindow()
{
    if (m_options.size) {
        m_window->resize(*m_options.size);
        m_window->show();
    } else {
        m_window->showFullScreen();
    }
    m_screens->begin();
    m_window->activateWindow();
    m_window->showView(View::Start);
}

void CockpitApplication::show()
{
    m_link->start();
    m_control->start();
    m_alarms->start();
    m_seatWatch->start();
    m_sceneClock.start();
    endWithTheCockpit();
    showWindow();
}

int CockpitApplication::run()
{
    show();
    if (m_options.unattended) {
        m_unattended = std::make_unique<UnattendedRun>(*m_window, m_models, *m_link, *m_options.unattended);
        connect(m_unattended.get(), &UnattendedRun::finished, this, [](int status, const QString& failure) {
            if (!failure.isEmpty())
                std::fprintf(stderr, "liena-console: the unattended run failed: %s\n", qUtf8Printable(failure));
            QCoreApplication::exit(status);
        });
        m_unattended->start();
    }
    return QApplication::exec();
}

} // namespace console
