// Regions, intents, keys and the window's own clock.
#include "widgets/cockpit_window.hpp"

#include "model/sound_schedule.hpp"
#include "widgets/alarm_band.hpp"
#include "widgets/diagnosis_sheet.hpp"
#include "widgets/dose_panel.hpp"
#include "widgets/links_rail.hpp"
#include "widgets/motion_bar.hpp"
#include "widgets/not_yet_pane.hpp"
#include "widgets/robot_panel.hpp"
#include "widgets/sheet_deck.hpp"
#include "widgets/status_strip.hpp"
#include "widgets/theme.hpp"
#include "widgets/trends_pane.hpp"

#include <QApplication>
#include <QDateTime>
#include <QKeyEvent>
#include <QPainter>
#include <QShortcut>

namespace console {

namespace colour = theme::colour;

namespace {

constexpr int clockMs = 50;
constexpr int slowTicks = 5;

} // namespace

CockpitWindow::CockpitWindow(ConsoleModels& models, QWidget* parent)
    : QWidget(parent),
      m_models(models),
      m_layout(new CockpitLayout(this)),
      m_strip(new StatusStrip(this)),
      m_band(new AlarmBand(this)),
      m_rail(new LinksRail(models.sessions, this)),
      m_live(new NotYetPane(tr("Live image"), tr("No picture."), this)),
      m_reference(new NotYetPane(tr("Reference image"), tr("No picture."), this)),
      m_scene(new NotYetPane(tr("3-D scene"), tr("No scene."), this)),
      m_robot(new RobotPanel(models.instrument, models.hand, models.permit, this)),
      m_dose(new DosePanel(models.instrument, models.xray, this)),
      m_trends(new TrendsPane(models.trends, this)),
      m_motion(new MotionBar(models, this)),
      m_deck(new SheetDeck(models.incidents, this))
{
    setWindowTitle(tr("LiENa cockpit \u2014 research system, not a medical device"));
    setAccessibleName(tr("Cockpit"));
    setFocusPolicy(Qt::StrongFocus);
    placeRegions();
    connectIntents();
    connectModels();
    addKeys();
    m_clock.setInterval(clockMs);
    m_clock.setTimerType(Qt::PreciseTimer);
    connect(&m_clock, &QTimer::timeout, this, &CockpitWindow::tick);
    connect(qApp, &QApplication::focusChanged, this, [this] { updateHandKeys(); });
    setKeyLegend({});
    setFocus();
}

CockpitWindow::~CockpitWindow()
{
    // The widgets in it lose the focus as they die, when this is a window no more.
    disconnect(qApp, nullptr, this, nullptr);
    disconnect(m_deck, nullptr, this, nullptr);
}

void CockpitWindow::placeRegions()
{
    m_layout->place(Region::Status, m_strip);
    m_layout->place(Region::Alarm, m_band);
    m_layout->place(Region::Links, m_rail);
    m_layout->place(Region::Live, m_live);
    m_layout->place(Region::Reference, m_reference);
    m_layout->place(Region::Scene, m_scene);
    m_layout->place(Region::Robot, m_robot);
    m_layout->place(Region::Dose, m_dose);
    m_layout->place(Region::Trends, m_trends);
    m_layout->place(Region::Motion, m_motion);
    m_layout->place(Region::Sheet, m_deck);
}

void CockpitWindow::connectIntents()
{
    connect(m_rail, &LinksRail::openRequested, this, &CockpitWindow::openRequested);
    connect(m_rail, &LinksRail::closeRequested, this, &CockpitWindow::closeRequested);
    connect(m_rail, &LinksRail::reopenRequested, this, &CockpitWindow::reopenRequested);
    connect(m_rail, &LinksRail::openAllRequested, this, &CockpitWindow::openAllRequested);
    connect(m_rail, &LinksRail::topologyRequested, this, [this] { showView(View::Topology); });
    connect(m_band, &AlarmBand::acknowledgeRequested, this, &CockpitWindow::acknowledgeRequested);
    connect(m_band, &AlarmBand::audioPauseRequested, this, [this] {
        Q_EMIT audioPauseRequested();
        setFocus();
    });
    connect(m_band, &AlarmBand::selfTestRequested, this, &CockpitWindow::alarmTestRequested);
    connect(m_band, &AlarmBand::selfTestAnswered, this, [this](bool seenAndHeard) {
        Q_EMIT alarmTestAnswered(seenAndHeard);
        setFocus();
    });
    connect(m_band, &AlarmBand::sheetRequested, m_deck, &SheetDeck::open);
    connect(m_deck, &SheetDeck::chipsChanged, m_band, &AlarmBand::setFoldedSheets);
    connect(m_deck, &SheetDeck::closed, this, [this] { setFocus(); });
    connect(m_deck, &SheetDeck::opened, this, [this] { refresh(std::chrono::steady_clock::now()); });
    const DiagnosisSheet* sheet = m_deck->sheet();
    connect(sheet, &DiagnosisSheet::reopenRequested, this, &CockpitWindow::reopenRequested);
    connect(sheet, &DiagnosisSheet::reopenAllRequested, this, &CockpitWindow::reopenAllRequested);
    connect(sheet, &DiagnosisSheet::probeRequested, this, &CockpitWindow::probeRequested);
    connect(sheet, &DiagnosisSheet::dismissRequested, this, &CockpitWindow::dismissRequested);
    connect(m_motion, &MotionBar::emergencyStopRequested, this, &CockpitWindow::emergencyStopRequested);
    connect(m_motion, &MotionBar::emergencyStopResetRequested, this, &CockpitWindow::emergencyStopResetRequested);
    connect(m_motion, &MotionBar::armHoldChanged, this, &CockpitWindow::armHoldChanged);
    connect(m_motion, &MotionBar::pedalChanged, this, &CockpitWindow::pedalChanged);
    connect(m_motion, &MotionBar::masterChosen, this, &CockpitWindow::masterChosen);
}

void CockpitWindow::connectModels()
{
    const auto now = [this] { refresh(std::chrono::steady_clock::now()); };
    connect(&m_models.alarms, &AlarmList::changed, this, [this] {
        m_band->setAlarms(m_models.alarms.alarms());
        refreshSound(std::chrono::steady_clock::now());
    });
    const auto test = [this] { m_band->setSelfTest(m_models.selfTest.step(), m_models.selfTest.signal()); };
    connect(&m_models.selfTest, &AlarmSelfTest::changed, this, test);
    test();
    connect(&m_models.permit, &PermitModel::phaseChanged, this, now);
    connect(&m_models.sessions, &SessionModel::linkStateChanged, this, now);
    connect(&m_models.sessions, &SessionModel::topologyChanged, this, now);
    connect(&m_models.incidents, &IncidentModel::incidentChanged, this, now);
    connect(&m_models.incidents, &IncidentModel::incidentEnded, this, now);
}

void CockpitWindow::addKeys()
{
    const auto bind = [this](Qt::Key key, auto act) {
        auto* shortcut = new QShortcut(QKeySequence(key), this);
        shortcut->setAutoRepeat(false);
        connect(shortcut, &QShortcut::activated, this, act);
    };
    bind(Qt::Key_F1, [this] { showView(View::Cockpit); });
    bind(Qt::Key_F2, [this] { showView(m_view == View::Topology ? View::Cockpit : View::Topology); });
    bind(Qt::Key_F9, [this] { Q_EMIT audioPauseRequested(); });
    bind(Qt::Key_F12, [this] { Q_EMIT panicHoldRequested(); });
    bind(Qt::Key_Escape, [this] { Q_EMIT emergencyStopRequested(tr("Esc key on the console")); });
}

void CockpitWindow::replace(Region region, QWidget*& present, QWidget* view)
{
    m_layout->removeWidget(present);
    delete present;
    present = view;
    m_layout->place(region, view);
    view->show();
    if (m_overlay)
        m_overlay->raise();
    m_deck->raise();
}

void CockpitWindow::setLiveView(QWidget* view) { replace(Region::Live, m_live, view); }

void CockpitWindow::setReferenceView(QWidget* view) { replace(Region::Reference, m_reference, view); }

void CockpitWindow::setSceneView(QWidget* view) { replace(Region::Scene, m_scene, view); }

void CockpitWindow::setMiniTopology(QWidget* view) { m_rail->setMiniTopology(view); }

void CockpitWindow::setTopologyView(QWidget* view)
{
    m_overlay = view;
    view->setAutoFillBackground(true);
    m_layout->place(Region::Overlay, view);
    view->hide();
    m_deck->raise();
}

void CockpitWindow::setOperator(const QString& user) { m_strip->setRole(user); }

void CockpitWindow::setRehearsal(bool rehearsal) { m_strip->setRehearsal(rehearsal); }

void CockpitWindow::setKeyLegend(const QString& legend)
{
    const QString own = tr("F9 audio pause \u00B7 F12 hold \u00B7 Esc emergency stop \u00B7 F1 cockpit \u00B7 F2 topology");
    m_motion->setKeyLegend(legend.isEmpty() ? own : legend + QStringLiteral(" \u00B7 ") + own);
}

void CockpitWindow::showView(View view)
{
    m_view = view;
    if (m_overlay) {
        const bool topology = view == View::Topology;
        m_overlay->setVisible(topology);
        if (topology) {
            m_overlay->raise();
            m_deck->raise();
            m_overlay->setFocus();
        } else {
            setFocus();
        }
    }
    updateHandKeys();
    Q_EMIT viewRequested(view);
}

PromptSurroundings CockpitWindow::surroundings(Instant now) const
{
    PromptSurroundings around;
    const auto robot = m_models.sessions.firstPeer(DeviceKind::Hand);
    around.robot = robot.value_or(0);
    const PictureReading picture = m_models.picture.reading(now);
    around.pictureLive = picture.condition == PictureCondition::Live;
    around.pictureSeen = picture.condition != PictureCondition::None;
    if (around.pictureSeen && !around.pictureLive)
        around.frozenSinceWallMs = qint64(picture.captureNs / 1000000U);
    around.tipLive = m_models.instrument.tipFresh(now);
    around.tipKnown = m_models.instrument.tip().known();
    for (const LinkNode& link : m_models.sessions.links()) {
        if (!link.own)
            continue;
        ++around.ownLinks;
        if (link.state == LinkState::StandBy)
            ++around.lostLinks;
    }
    return around;
}

void CockpitWindow::refreshStrip(Instant now)
{
    const SessionModel& sessions = m_models.sessions;
    if (!m_procedureSince && sessions.openCount() > 0)
        m_procedureSince = now;
    m_strip->setProcedureTime(m_procedureSince ? std::optional<std::chrono::nanoseconds>(now - *m_procedureSince) : std::nullopt);
    m_strip->setTopology(sessions.topologyTitle().isEmpty() ? sessions.topologyName() : sessions.topologyTitle(), sessions.topologyHash());
    m_strip->setWallClock(QDateTime::currentDateTime().toString(QStringLiteral("HH:mm:ss")));
    m_strip->setMode(modeOf(m_models.permit.phase()));
    m_strip->setBeam(!m_models.xray.fresh(now) ? Beam::Unknown : m_models.xray.beamOn() ? Beam::On : Beam::Off);
}

void CockpitWindow::tick()
{
    const Instant now = std::chrono::steady_clock::now();
    m_robot->refresh(now);
    m_motion->refresh(now);
    if (++m_ticks % slowTicks == 0)
        refreshSlow(now);
}

void CockpitWindow::refresh(Instant now)
{
    m_robot->refresh(now);
    m_motion->refresh(now);
    refreshSlow(now);
}

void CockpitWindow::refreshSound(Instant now)
{
    m_band->setSound(SoundSchedule::demandsSound(m_models.alarms.alarms()), m_models.alarms.audioPauseLeft(now));
}

void CockpitWindow::refreshSlow(Instant now)
{
    refreshSound(now);
    refreshStrip(now);
    m_rail->refresh(now);
    m_dose->refresh(now);
    m_trends->refresh({m_models.instrument.limits().forceWarn, milliseconds(m_models.picture.limit())}, now);
    m_deck->refresh(m_models.sessions, surroundings(now), now);
}

void CockpitWindow::updateHandKeys()
{
    const QWidget* focus = QApplication::focusWidget();
    const bool elsewhere =
        focus && focus != this && (m_deck->isAncestorOf(focus) || (m_overlay && (focus == m_overlay || m_overlay->isAncestorOf(focus))));
    const bool has = isVisible() && isActiveWindow() && focus && !elsewhere && focus->window() == this;
    if (has == m_handHasKeys)
        return;
    m_handHasKeys = has;
    Q_EMIT handFocusChanged(has);
}

void CockpitWindow::keyPressEvent(QKeyEvent* event)
{
    const int key = event->key();
    const bool never = key == Qt::Key_Space || key == Qt::Key_Return || key == Qt::Key_Enter;
    if (!m_handHasKeys || never || event->isAutoRepeat()) {
        event->ignore();
        return;
    }
    Q_EMIT handKeyPressed(key);
}

void CockpitWindow::keyReleaseEvent(QKeyEvent* event)
{
    if (event->isAutoRepeat())
        return;
    Q_EMIT handKeyReleased(event->key());
}

// A click on the picture or beside a control gives the keys back to the hand.
void CockpitWindow::mousePressEvent(QMouseEvent*) { setFocus(Qt::MouseFocusReason); }

void CockpitWindow::paintEvent(QPaintEvent*)
{
    QPainter painter(this);
    painter.fillRect(rect(), colour::background);
    painter.setPen(QPen(colour::line, 1));
    const QRect g = regionGeometry(Region::Robot);
    painter.drawLine(g.topLeft(), g.topRight());
    painter.drawLine(g.bottomLeft(), g.bottomRight());
    const QRect c = regionGeometry(Region::Links);
    painter.drawLine(c.topRight(), c.bottomRight());
    const QRect j = regionGeometry(Region::Motion);
    painter.drawLine(j.topLeft(), j.topRight());
}

void CockpitWindow::resizeEvent(QResizeEvent* event)
{
    theme::applyScale(this, theme::scaleFor(event->size()));
    m_layout->setGeometry(rect());
}

void CockpitWindow::showEvent(QShowEvent*)
{
    theme::applyScale(this, theme::scaleFor(size()));
    refresh(std::chrono::steady_clock::now());
    m_clock.start();
    updateHandKeys();
}

void CockpitWindow::hideEvent(QHideEvent*)
{
    m_clock.stop();
    updateHandKeys();
}

void CockpitWindow::changeEvent(QEvent* event)
{
    QWidget::changeEvent(event);
    if (event->type() == QEvent::ActivationChange)
        updateHandKeys();
}

} // namespace console
