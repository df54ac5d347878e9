// Regions, intents, keys and the window's own clock.
#include "widgets/cockpit_window.hpp"

#include "model/present_readings.hpp"
#include "model/sound_schedule.hpp"
#include "widgets/alarm_band.hpp"
#include "widgets/closing_note.hpp"
#include "widgets/diagnosis_sheet.hpp"
#include "widgets/dose_panel.hpp"
#include "widgets/interruption_card.hpp"
#include "widgets/links_rail.hpp"
#include "widgets/motion_bar.hpp"
#include "widgets/not_yet_pane.hpp"
#include "widgets/robot_panel.hpp"
#include "widgets/sheet_deck.hpp"
#include "widgets/status_strip.hpp"
#include "widgets/theme.hpp"
#include "widgets/trends_pane.hpp"
#include "widgets/urgent_keys.hpp"

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

/// Of the hand's keys those that a button, a slider or a list would take for itself.
bool isTakenByWidgets(int key)
{
    switch (key) {
    case Qt::Key_Up:
    case Qt::Key_Down:
    case Qt::Key_Left:
    case Qt::Key_Right:
    case Qt::Key_PageUp:
    case Qt::Key_PageDown:
        return true;
    default:
        return false;
    }
}

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
      m_robot(new RobotPanel(models, this)),
      m_dose(new DosePanel(models.instrument, models.xray, this)),
      m_trends(new TrendsPane(models.trends, this)),
      m_motion(new MotionBar(models, this)),
      m_away(new InterruptionCard(models.interruption, this)),
      m_closing(new ClosingNote(models, this)),
      m_deck(new SheetDeck(models.incidents, this))
{
    setWindowTitle(tr("LiENa cockpit \u2014 research system, not a medical device"));
    setAccessibleName(tr("Cockpit"));
    setFocusPolicy(Qt::StrongFocus);
    setAttribute(Qt::WA_OpaquePaintEvent);
    placeRegions();
    connectIntents();
    connectModels();
    addKeys();
    addViewKeys();
    qApp->installEventFilter(this); // the last one hears first, so this one hears of every key, also of those that UrgentKeys takes
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
    hide(); // which ends every hold, as long as this can tell of it
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
    m_layout->place(Region::Reference, m_away); // the scene beside it shows the tip before and now
    m_layout->place(Region::Note, m_closing);
    m_layout->place(Region::Sheet, m_deck);
    setTabOrder(this, m_away->readButton()); // one step from the cockpit itself
}

void CockpitWindow::addKeys()
{
    const auto bind = [this](Qt::Key key, auto act) {
        auto* shortcut = new QShortcut(QKeySequence(key), this);
        shortcut->setAutoRepeat(false);
        connect(shortcut, &QShortcut::activated, this, act);
    };
    bind(Qt::Key_F1, [this] { showView(View::Cockpit); });
    bind(Qt::Key_F2, [this] { toggleView(View::Topology); });
    bind(Qt::Key_F4, [this] { toggleView(View::Log); });
    bind(Qt::Key_F8, [this] { Q_EMIT alarmTestRequested(); });
    auto* urgent = new UrgentKeys(this);
    connect(urgent, &UrgentKeys::audioPausePressed, this, &CockpitWindow::audioPauseRequested);
    connect(urgent, &UrgentKeys::holdPressed, this, &CockpitWindow::panicHoldRequested);
    connect(urgent, &UrgentKeys::emergencyStopPressed, this, [this] {
        Q_EMIT emergencyStopRequested(QString::fromLatin1(QT_TRANSLATE_NOOP("console::SystemLink", "Esc key on the console")));
    });
}

void CockpitWindow::replace(Region region, QWidget*& present, QWidget* view)
{
    m_layout->removeWidget(present);
    delete present;
    present = view;
    m_layout->place(region, view);
    theme::applyScale(view, theme::scaleOf(this));
    view->show();
    stack();
}

/// What lies over the regions: a view lowest, the account of an interruption over it, the prompt of a present one on top.
void CockpitWindow::stack()
{
    m_views.raise();
    m_away->raise();
    m_deck->raise();
}

void CockpitWindow::setLiveView(QWidget* view) { replace(Region::Live, m_live, view); }

void CockpitWindow::setReferenceView(QWidget* view) { replace(Region::Reference, m_reference, view); }

void CockpitWindow::setSceneView(QWidget* view) { replace(Region::Scene, m_scene, view); }

void CockpitWindow::setMiniTopology(QWidget* view) { m_rail->setMiniTopology(view); }

void CockpitWindow::setTopologyView(QWidget* view) { addView(View::Topology, view); }

void CockpitWindow::setLogView(QWidget* view) { addView(View::Log, view); }

void CockpitWindow::addView(View view, QWidget* widget)
{
    m_layout->place(Region::Overlay, widget);
    m_views.add(view, widget);
    theme::applyScale(widget, theme::scaleOf(this));
    stack();
}

void CockpitWindow::showIncidentMarked() { m_band->showMarked(); }

void CockpitWindow::showReportNote(const QString& note) { m_deck->sheet()->showNote(note); }

void CockpitWindow::setOperator(const QString& user) { m_strip->setRole(user, m_models.role); }

void CockpitWindow::setPatient(const QString& name, const QString& id) { m_strip->setPatient(name, id); }

void CockpitWindow::setRehearsal(bool rehearsal) { m_strip->setRehearsal(rehearsal); }

void CockpitWindow::showView(View view)
{
    m_models.screenGone = m_models.screenGone && view != View::Cockpit;
    if (m_views.show(view))
        stack();
    else
        setFocus();
    updateHandKeys();
    Q_EMIT viewRequested(view);
}

void CockpitWindow::toggleView(View view) { showView(m_views.isShown(view) ? View::Cockpit : view); }

void CockpitWindow::refreshStrip(Instant now)
{
    const SessionModel& sessions = m_models.sessions;
    if (!m_procedureSince && sessions.openCount() > 0)
        m_procedureSince = now;
    m_strip->setProcedureTime(m_procedureSince ? std::optional<std::chrono::nanoseconds>(now - *m_procedureSince) : std::nullopt);
    m_strip->setTopology(sessions.topologyTitle().isEmpty() ? sessions.topologyName() : sessions.topologyTitle(), sessions.topologyHash());
    const auto robot = sessions.firstPeer(DeviceKind::Hand);
    const auto* link = robot ? sessions.linkTo(*robot) : nullptr;
    const bool compared = link != nullptr && carriesMessages(link->state) && link->figures.clockOffset;
    m_strip->setWallClock(QDateTime::currentDateTime().toString(QStringLiteral("HH:mm:ss")),
                          compared ? std::optional<std::chrono::nanoseconds>(link->figures.clockUncertainty) : std::nullopt);
    m_strip->setRecorder(m_models.recorder.keeps());
    m_strip->setMode(modeOf(m_models.permit.phase()));
    m_strip->setBeam(!m_models.xray.fresh(now) ? Beam::Unknown : m_models.xray.beamOn() ? Beam::On : Beam::Off);
}

void CockpitWindow::tick()
{
    const Instant now = std::chrono::steady_clock::now();
    if (++m_ticks % slowTicks == 0)
        return refresh(now);
    m_robot->refresh(now);
    m_motion->refresh(now);
}

void CockpitWindow::refresh(Instant now)
{
    refreshStates(now);
    refreshCourses(now);
}

/// What may be another one from one moment to the next.
void CockpitWindow::refreshStates(Instant now)
{
    m_robot->refresh(now);
    m_motion->refresh(now);
    refreshSound(now);
    refreshStrip(now);
    m_rail->refresh(now);
    m_away->refresh(now);
    m_closing->refresh(now);
    refreshDeck(now);
}

/// What grows with time only, and takes long to draw.
void CockpitWindow::refreshCourses(Instant now)
{
    m_dose->refresh(now);
    m_trends->refresh({m_models.instrument.limits().forceWarn, milliseconds(m_models.picture.limit())}, now);
}

void CockpitWindow::refreshSound(Instant now)
{
    m_band->setSound(SoundSchedule::demandsSound(m_models.alarms.alarms()), m_models.alarms.audioPauseLeft(now),
                     soundStaysFor(m_models, now));
}

void CockpitWindow::refreshDeck(Instant now) { m_deck->refresh(m_models.sessions, promptSurroundings(m_models, now), now); }

void CockpitWindow::refreshSoon()
{
    if (m_refreshDue)
        return;
    m_refreshDue = true;
    QMetaObject::invokeMethod(
        this,
        [this] {
            m_refreshDue = false;
            refreshStates(std::chrono::steady_clock::now());
        },
        Qt::QueuedConnection);
}

void CockpitWindow::updateHandKeys()
{
    const QWidget* focus = QApplication::focusWidget();
    const bool elsewhere = focus && focus != this && (m_deck->isAncestorOf(focus) || m_away->isAncestorOf(focus) || m_views.holds(focus));
    const bool inSight = !m_models.screenGone && m_models.unseen.isEmpty() && isVisible();
    const bool has = inSight && isActiveWindow() && focus && !elsewhere && focus->window() == this;
    if (has == m_handHasKeys)
        return;
    m_handHasKeys = has;
    m_held.clear(); // what is down now counts for nothing until it is pressed again, and what comes up elsewhere is not heard
    Q_EMIT handFocusChanged(has);
}

void CockpitWindow::keyPressEvent(QKeyEvent* event)
{
    const int key = event->key();
    const bool never = key == Qt::Key_Space || key == Qt::Key_Return || key == Qt::Key_Enter;
    // With one of these it is a shortcut, of this program or of the desktop, and no wish of the hand; a release always counts.
    const bool shortcut = event->modifiers().testAnyFlags(Qt::ControlModifier | Qt::AltModifier | Qt::MetaModifier);
    if (!m_handHasKeys || never || shortcut || event->isAutoRepeat()) {
        event->ignore();
        return;
    }
    Q_EMIT handKeyPressed(key);
}

/// Of whatever part of it: a picture and a button keep the press for themselves, and their click is one into the cockpit, too.
void CockpitWindow::noteClick()
{
    if (!m_models.screenGone)
        return;
    m_models.screenGone = false;
    updateHandKeys();
}

/// A button or a slider with the focus would take the arrows to move the focus or itself, and what it leaves its list would.
bool CockpitWindow::eventFilter(QObject* watched, QEvent* event)
{
    if (!watched->isWidgetType() || static_cast<QWidget*>(watched)->window() != this)
        return false;
    if (event->type() == QEvent::MouseButtonPress)
        noteClick();
    const bool press = event->type() == QEvent::KeyPress;
    if (!press && event->type() != QEvent::ShortcutOverride) // of what a shortcut takes nothing else is heard
        return false;
    auto* key = static_cast<QKeyEvent*>(event);
    noteKeyDown(*key);
    if (!press || !m_handHasKeys || watched == this || !isTakenByWidgets(key->key()))
        return false;
    keyPressEvent(key);
    return true;
}

/// Of every key, whosever it is: one that comes up under another code must not be taken for one of the hand's, nor the other way round.
void CockpitWindow::noteKeyDown(const QKeyEvent& event)
{
    if (event.isAutoRepeat())
        return;
    if (const auto before = m_held.press(event.nativeScanCode(), event.key()))
        Q_EMIT handKeyReleased(*before);
}

void CockpitWindow::keyReleaseEvent(QKeyEvent* event)
{
    if (event->isAutoRepeat())
        return;
    for (const int key : m_held.release(event->nativeScanCode(), event->key()))
        Q_EMIT handKeyReleased(key);
}

// A click on the picture or beside a control gives the keys back to the hand.
void CockpitWindow::mousePressEvent(QMouseEvent*)
{
    setFocus(Qt::MouseFocusReason);
    updateHandKeys();
}

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

// QWidget's own draw the whole window, though nothing in it shows that it has the focus itself.
void CockpitWindow::focusInEvent(QFocusEvent*) {}
void CockpitWindow::focusOutEvent(QFocusEvent*) {}

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
