// Screens, windows and layouts.
#include "app/screen_desk.hpp"

#include "app/picture_desk.hpp"
#include "editor/topology_canvas.hpp"
#include "imaging/reference_image_view.hpp"
#include "model/preferences.hpp"
#include "widgets/checklist_view.hpp"
#include "widgets/cockpit_window.hpp"
#include "widgets/log_lines.hpp"
#include "widgets/plots_view.hpp"
#include "widgets/screens_view.hpp"
#include "widgets/side_window.hpp"
#include "widgets/trends_pane.hpp"

#include <QDateTime>
#include <QDir>
#include <QFileInfo>
#include <QGridLayout>
#include <QGuiApplication>
#include <QScreen>
#include <QVBoxLayout>
#include <QWindow>

namespace console {

namespace {

constexpr int clockMs = 250;

/// Beside the preferences; without those nothing is kept.
QString bookPath(const Options& options)
{
    return options.preferences.isEmpty() ? QString()
                                         : QFileInfo(options.preferences).absoluteDir().filePath(QStringLiteral("layouts.json"));
}

} // namespace

ScreenDesk::ScreenDesk(const Options& options, ConsoleModels& models, PictureDesk& pictures, CockpitWindow& window, QObject* parent)
    : QObject(parent), m_models(models), m_pictures(pictures), m_window(window), m_book(bookPath(options)), m_view(new ScreensView)
{
    window.addView(View::Screens, m_view);
    for (const QString& trouble : m_book.read())
        say(true, trouble);
    connectView();
    connect(qGuiApp, &QGuiApplication::screenRemoved, this, &ScreenDesk::screenGone);
    connect(qGuiApp, &QGuiApplication::screenAdded, this, &ScreenDesk::refreshView, Qt::QueuedConnection);
    connect(&models.permit, &PermitModel::phaseChanged, this, &ScreenDesk::refreshView);
    m_clock.setInterval(clockMs);
    connect(&m_clock, &QTimer::timeout, this, &ScreenDesk::refresh);
    refreshView();
}

ScreenDesk::~ScreenDesk() = default;

void ScreenDesk::connectView()
{
    connect(&m_window, &CockpitWindow::layoutRequested, this, &ScreenDesk::restore);
    connect(&m_window, &CockpitWindow::arrangementChanged, this, [this](Arrangement arrangement) {
        m_present.arrangement = arrangement;
        refreshView();
    });
    connect(m_view, &ScreensView::arrangementChosen, &m_window, &CockpitWindow::setArrangement);
    connect(m_view, &ScreensView::secondChosen, this, [this](const QString& screen) {
        ScreenLayout wanted = m_present;
        wanted.second = screen;
        if (wanted.third == screen)
            wanted.third.clear();
        choose(wanted);
    });
    connect(m_view, &ScreensView::thirdChosen, this, [this](const QString& screen) {
        ScreenLayout wanted = m_present;
        wanted.third = screen;
        if (wanted.second == screen)
            wanted.second.clear();
        choose(wanted);
    });
    connect(m_view, &ScreensView::saveRequested, this, [this](const QString& name) {
        ScreenLayout saved = m_present;
        saved.name = name;
        const QString trouble = m_book.save(saved);
        refreshView();
        say(!trouble.isEmpty(), trouble.isEmpty() ? tr("layout saved: %1").arg(LayoutBook::cleaned(name)) : trouble);
    });
    connect(m_view, &ScreensView::restoreRequested, this, &ScreenDesk::restore);
    connect(m_view, &ScreensView::deleteRequested, this, [this](int place) {
        const QString trouble = m_book.remove(std::size_t(place));
        refreshView();
        say(!trouble.isEmpty(), trouble.isEmpty() ? tr("layout deleted") : trouble);
    });
    connect(m_view, &ScreensView::leaveRequested, &m_window, [this] { m_window.showView(View::Cockpit); });
}

/// Made before the window is shown, its handle would not have the window's own flags.
void ScreenDesk::begin()
{
    if (const QWindow* handle = m_window.windowHandle()) {
        m_present.cockpit = nameOf(handle->screen());
        // Queued: when a screen goes, what it took with it is known before Qt's own move of the window. By then the screen that the signal
        // named may be gone, too.
        connect(
            handle, &QWindow::screenChanged, this,
            [this] {
                m_present.cockpit = nameOf(m_window.screen());
                refreshView();
            },
            Qt::QueuedConnection);
    }
    m_clock.start();
    refreshView();
}

QString ScreenDesk::nameOf(const QScreen* screen)
{
    if (screen == nullptr)
        return {};
    const QString serial = screen->serialNumber().trimmed();
    return serial.isEmpty() ? screen->name() : screen->name() + QLatin1Char(' ') + serial;
}

QList<QString> ScreenDesk::screens(const QScreen* except) const
{
    QList<QString> names;
    for (const QScreen* screen : QGuiApplication::screens())
        if (screen != except && !names.contains(nameOf(screen)))
            names << nameOf(screen);
    return names;
}

QScreen* ScreenDesk::screenOf(const QString& name) const
{
    for (QScreen* screen : QGuiApplication::screens())
        if (nameOf(screen) == name)
            return screen;
    return nullptr;
}

/// A window that comes or goes can take the focus, and with it the hand's keys.
bool ScreenDesk::mayChange() const { return preferencesMayChange(m_models.permit.phase()); }

void ScreenDesk::restore(int place)
{
    const auto& layouts = m_book.layouts();
    if (place < 0 || std::size_t(place) >= layouts.size()) {
        if (mayChange())
            m_window.showView(View::Screens); // where it is said, and where one is saved
        return say(true, tr("There is no layout %1; F7 saves one.").arg(place + 1));
    }
    choose(layouts[std::size_t(place)]);
}

void ScreenDesk::choose(const ScreenLayout& wanted)
{
    if (!mayChange())
        return say(true, tr("Screens stay as they are while the permit is %1.").arg(word(m_models.permit.phase())));
    const ScreenPlan plan = planFor(wanted, screens());
    apply(plan);
    m_window.setArrangement(wanted.arrangement);
    m_window.activateWindow();
    refreshView();
    if (plan.folded)
        say(true, tr("A screen that this layout asks for is not there: what was on it is in the cockpit."));
    else if (!wanted.name.isEmpty())
        say(false, tr("layout: %1").arg(wanted.name));
}

/// The cockpit first.
void ScreenDesk::apply(const ScreenPlan& plan)
{
    if (plan.cockpit != m_present.cockpit)
        if (QScreen* to = screenOf(plan.cockpit))
            moveCockpit(to);
    if (plan.second != m_present.second || (m_second == nullptr) != plan.second.isEmpty())
        placeSecond(screenOf(plan.second));
    if (plan.third != m_present.third || (m_third == nullptr) != plan.third.isEmpty())
        placeThird(screenOf(plan.third));
    m_present.cockpit = plan.cockpit;
    m_present.second = m_second ? plan.second : QString();
    m_present.third = m_third ? plan.third : QString();
}

void ScreenDesk::screenGone(QScreen* gone)
{
    const QString name = nameOf(gone);
    const bool cockpit = m_present.cockpit == name;
    if (cockpit)
        m_window.noteScreenGone(); // before anything else: what moves, stops
    if (!cockpit && m_present.second != name && m_present.third != name)
        return refreshView();
    apply(planFor(m_present, screens(gone)));
    if (cockpit) {
        m_window.raise();
        m_window.activateWindow();
    }
    refreshView();
    say(true, cockpit
                  ? tr("The screen %1 is gone; the cockpit is on %2. The hand has no keys until you click into the cockpit or press F1.")
                        .arg(name, m_present.cockpit)
                  : tr("The screen %1 is gone; what was on it is in the cockpit.").arg(name));
}

void ScreenDesk::moveCockpit(QScreen* to)
{
    const bool full = m_window.isFullScreen();
    if (full)
        m_window.showNormal(); // a window that fills one screen cannot be moved to another
    if (QWindow* handle = m_window.windowHandle())
        handle->setScreen(to);
    const QRect room = to->availableGeometry();
    m_window.setGeometry(QRect(room.topLeft(), m_window.size().boundedTo(room.size())));
    if (full) {
        m_window.setGeometry(to->geometry());
        m_window.showFullScreen();
    }
}

void ScreenDesk::connectSide(SideWindow& side)
{
    connect(&side, &SideWindow::emergencyStopRequested, &m_window, &CockpitWindow::emergencyStopRequested);
    connect(&side, &SideWindow::panicHoldRequested, &m_window, &CockpitWindow::panicHoldRequested);
    connect(&side, &SideWindow::audioPauseRequested, &m_window, &CockpitWindow::audioPauseRequested);
    connect(&side, &SideWindow::cockpitRequested, &m_window, [this] {
        m_window.comeToTheFront();
        m_window.showView(View::Cockpit);
    });
    connect(
        &side, &SideWindow::closedByPerson, this,
        [this, which = &side] {
            (which == m_second.get() ? m_present.second : m_present.third).clear();
            (which == m_second.get() ? m_second : m_third).reset();
            refreshView();
        },
        Qt::QueuedConnection);
}

void ScreenDesk::placeSecond(QScreen* on)
{
    m_second.reset();
    if (on == nullptr)
        return;
    m_second = std::make_unique<SideWindow>(tr("Overview"));
    m_second->add({new TopologyCanvas(m_models.sessions, TopologyCanvas::Size::Full), new ChecklistPane(m_models.permit)}, 4);
    auto* plots = new PlotsView(m_models);
    connect(plots, &PlotsView::leaveRequested, m_second.get(), &SideWindow::cockpitRequested);
    m_second->add({plots, makeRunning()}, 6);
    connectSide(*m_second);
    m_second->setGeometry(on->geometry());
    m_second->showFullScreen();
    refresh();
}

/// What goes on: trends above the log.
QWidget* ScreenDesk::makeRunning()
{
    auto* running = new QWidget;
    auto* column = new QVBoxLayout(running);
    column->setContentsMargins(0, 0, 0, 0);
    m_trends = new TrendsPane(m_models.trends);
    column->addWidget(m_trends, 2);
    auto* log = new LogLines;
    log->setModel(&m_models.log);
    log->setAccessibleName(tr("Event log, oldest first"));
    column->addWidget(log, 3);
    return running;
}

void ScreenDesk::placeThird(QScreen* on)
{
    m_third.reset();
    if (on == nullptr)
        return;
    m_third = std::make_unique<SideWindow>(tr("Reference picture"));
    m_reference = m_pictures.makeReferenceCopy();
    auto* room = new QWidget;
    auto* centre = new QGridLayout(room);
    centre->setContentsMargins(0, 0, 0, 0);
    centre->addWidget(m_reference, 0, 0);
    m_third->add({room}, 1);
    connectSide(*m_third);
    m_third->setGeometry(on->geometry());
    m_third->showFullScreen();
    refresh();
}

void ScreenDesk::refresh()
{
    if (m_trends)
        m_trends->refresh({m_models.instrument.limits().forceWarn, milliseconds(m_models.picture.limit())},
                          std::chrono::steady_clock::now());
    if (m_reference) // never larger than the live one
        m_reference->setMaximumSize(m_window.regionGeometry(Region::Live).size());
}

void ScreenDesk::refreshView()
{
    ScreensView::State state;
    state.arrangement = m_window.arrangement();
    state.cockpit = m_present.cockpit;
    for (const QString& name : screens())
        if (name != m_present.cockpit)
            state.further << name;
    state.second = m_present.second;
    state.third = m_present.third;
    for (const ScreenLayout& layout : m_book.layouts())
        state.layouts << layout.name;
    if (!mayChange())
        state.fixed =
            tr("Screens and layouts stay as they are: the permit is %1. Pictures can change places.").arg(word(m_models.permit.phase()));
    m_view->showState(state);
}

void ScreenDesk::say(bool trouble, const QString& words)
{
    m_models.log.append(trouble ? LogKind::Trouble : LogKind::Note, words, QDateTime::currentMSecsSinceEpoch());
    m_view->say(words);
}

} // namespace console
