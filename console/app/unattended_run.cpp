// A whole session, operated by the program itself.
#include "app/unattended_run.hpp"

#include "widgets/cockpit_window.hpp"
#include "widgets/self_test_block.hpp"

#include <QAbstractButton>
#include <QApplication>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QSaveFile>

#include <algorithm>

namespace console {

namespace {

constexpr std::chrono::milliseconds lookPeriod{20};
constexpr std::chrono::seconds showTime{10};
constexpr std::chrono::seconds openTime{20};
constexpr std::chrono::seconds clickAgain{2};
constexpr std::chrono::seconds imageTime{20};
constexpr std::chrono::seconds armTime{6};
constexpr std::chrono::seconds engageTime{2};

constexpr int logLines = 100;

constexpr int armKey = Qt::Key_R;
constexpr int deadManKey = Qt::Key_D;
constexpr int pedalKey = Qt::Key_F;

void sendMouse(QWidget* widget, QEvent::Type type, Qt::MouseButtons buttons)
{
    const QPointF local = widget->rect().center();
    QMouseEvent event(type, local, widget->mapToGlobal(local), Qt::LeftButton, buttons, Qt::NoModifier);
    QCoreApplication::sendEvent(widget, &event);
}

} // namespace

UnattendedRun::UnattendedRun(CockpitWindow& window, ConsoleModels& models, SystemLink& link, const UnattendedSettings& settings,
                             QObject* parent)
    : QObject(parent), m_window(window), m_models(models), m_link(link), m_settings(settings)
{
    m_timer.setInterval(lookPeriod);
    connect(&m_timer, &QTimer::timeout, this, &UnattendedRun::proceed);
    connect(&models.picture, &PictureState::painted, this, [this] {
        if (!m_measuring)
            return;
        const auto age = m_models.picture.reading(std::chrono::steady_clock::now()).age;
        m_measurements.notePainted(age ? std::optional<double>(milliseconds(*age)) : std::nullopt);
    });
    connect(&window, &CockpitWindow::closed, this, [this] {
        if (m_step != Step::Done)
            finish(QStringLiteral("the cockpit's window was closed"));
    });
    connect(&models.instrument, &InstrumentState::robotChanged, this, [this] {
        if (m_measuring)
            m_measurements.noteRobot(m_models.instrument.robot().value);
    });
}

void UnattendedRun::start()
{
    enter(Step::Show);
    m_timer.start();
}

void UnattendedRun::enter(Step step)
{
    m_step = step;
    m_entered = std::chrono::steady_clock::now();
}

Duration UnattendedRun::inStep() const { return std::chrono::steady_clock::now() - m_entered; }

void UnattendedRun::proceed()
{
    clickSelfTest();
    switch (m_step) {
    case Step::Show:
        return show();
    case Step::Open:
        return open();
    case Step::Image:
        return image();
    case Step::Arm:
        return arm();
    case Step::Engage:
        return engage();
    case Step::Jog:
        return jog();
    case Step::Done:
        return;
    }
}

void UnattendedRun::show()
{
    if (!m_window.isActiveWindow()) {
        m_window.activateWindow();
        if (inStep() > showTime)
            finish(QStringLiteral("the window did not become active"));
        return;
    }
    m_window.showView(View::Topology);
    if (!clickOpenAll())
        return finish(QStringLiteral("there is no button 'Open all'"));
    enter(Step::Open);
}

void UnattendedRun::open()
{
    if (m_models.sessions.allOpen()) {
        m_window.showView(View::Cockpit);
        sendKey(pedalKey, true);
        return enter(Step::Image);
    }
    if (inStep() > openTime)
        return finish(QStringLiteral("%1 of %2 sessions opened").arg(m_models.sessions.openCount()).arg(m_models.sessions.ownLinkCount()));
    if (std::chrono::steady_clock::now() - m_lastClick > clickAgain)
        clickOpenAll();
}

void UnattendedRun::image()
{
    if (m_models.permit.phase() == PermitPhase::Ready) {
        sendKey(armKey, true);
        return enter(Step::Arm);
    }
    if (inStep() > imageTime)
        finish(QStringLiteral("not ready to arm: %1").arg(m_models.permit.unmetText()));
}

void UnattendedRun::arm()
{
    const auto phase = m_models.permit.phase();
    if (phase == PermitPhase::Armed) {
        m_measurements.armed = true;
        m_measurements.armingMs = milliseconds(inStep());
        sendKey(armKey, false);
        sendKey(deadManKey, true);
        return enter(Step::Engage);
    }
    // A condition that failed meanwhile sends a person back to the start of the hold.
    if (phase == PermitPhase::Ready || phase == PermitPhase::Standby) {
        sendKey(armKey, false);
        return enter(Step::Image);
    }
    if (phase == PermitPhase::Hold || inStep() > armTime)
        finish(QStringLiteral("not armed: %1").arg(word(m_models.permit.state().cause)));
}

void UnattendedRun::engage()
{
    if (m_models.permit.phase() == PermitPhase::Engaged) {
        m_measurements.engaged = true;
        m_framesBefore = m_link.framesReceived();
        m_commandsBefore = m_link.commandsSent();
        m_measurements.begin(std::chrono::steady_clock::now());
        m_measuring = true;
        return enter(Step::Jog);
    }
    if (inStep() > engageTime)
        finish(QStringLiteral("the dead-man did not engage motion: %1").arg(m_models.permit.unmetText()));
}

void UnattendedRun::jog()
{
    if (m_models.permit.phase() != PermitPhase::Engaged) {
        const auto cause = word(m_models.permit.state().cause);
        m_measurements.holdCause =
            cause.isEmpty() ? word(m_models.permit.phase()) : cause + QStringLiteral(" (") + m_models.permit.unmetText() + QLatin1Char(')');
        return finish({});
    }
    if (seconds(inStep()) >= m_settings.jogSeconds)
        finish({});
}

void UnattendedRun::gather()
{
    m_measuring = false;
    m_measurements.end(std::chrono::steady_clock::now());
    if (m_measurements.engaged) {
        m_measurements.framesReceived = m_link.framesReceived() - m_framesBefore;
        m_measurements.commandsSent = m_link.commandsSent() - m_commandsBefore;
    }
    for (const auto& link : m_models.sessions.links())
        if (link.own)
            m_measurements.sessions[link.peer] = {m_models.sessions.titleOf(link.peer), word(link.state), carriesMessages(link.state),
                                                  link.openingMs, link.failure};
    m_measurements.incidents = m_models.incidents.raisedInAll();
    m_measurements.alarms = m_models.alarms.raisedInAll();
}

void UnattendedRun::finish(const QString& failure)
{
    m_timer.stop();
    m_step = Step::Done;
    gather();
    if (!failure.isEmpty())
        m_measurements.stepFailure = failure;
    auto failures = m_measurements.failures();
    // The picture of the end shows the motion that was; what it costs the screen no longer counts.
    if (!m_settings.screenshot.isEmpty() && !m_window.grab().save(m_settings.screenshot))
        failures.push_back(QStringLiteral("%1: the screenshot could not be written").arg(m_settings.screenshot));
    for (const int key : {deadManKey, armKey, pedalKey})
        sendKey(key, false);
    if (const auto wrong = save(); !wrong.isEmpty())
        failures.push_back(wrong);
    Q_EMIT finished(failures.empty() ? 0 : 1,
                    failures.empty() ? QString() : QStringList(failures.begin(), failures.end()).join(QStringLiteral("; ")));
}

QString UnattendedRun::save() const
{
    if (m_settings.report.isEmpty())
        return {};
    QSaveFile file(m_settings.report);
    auto json = m_measurements.toJson();
    QJsonArray log;
    for (int row = std::max(0, m_models.log.rowCount() - logLines); row < m_models.log.rowCount(); ++row)
        log.append(m_models.log.data(m_models.log.index(row)).toString());
    json.insert(QStringLiteral("log"), log);
    json.insert(QStringLiteral("alarm_self_test"), m_models.selfTest.passedInAll() > 0
                                                       ? QStringLiteral("confirmed by the run itself; no person saw or heard it")
                                                       : QStringLiteral("not confirmed"));
    const bool written = file.open(QIODevice::WriteOnly) && file.write(QJsonDocument(json).toJson()) > 0 && file.commit();
    return written ? QString() : QStringLiteral("%1: the report could not be written: %2").arg(m_settings.report, file.errorString());
}

bool UnattendedRun::clickOpenAll()
{
    m_lastClick = std::chrono::steady_clock::now();
    QAbstractButton* found = nullptr;
    for (auto* button : m_window.findChildren<QAbstractButton*>())
        if (button->isVisible() &&
            button->text().remove(QLatin1Char('&')) == QCoreApplication::translate("console::TopologyView", "Open all"))
            found = button;
    if (found == nullptr || !found->isEnabled())
        return found != nullptr;
    sendMouse(found, QEvent::MouseButtonPress, Qt::LeftButton);
    sendMouse(found, QEvent::MouseButtonRelease, Qt::NoButton);
    return true;
}

/// To begin it, and to confirm it: whichever button is offered first.
void UnattendedRun::clickSelfTest()
{
    const auto* block = m_window.findChild<SelfTestBlock*>();
    if (block == nullptr || m_models.selfTest.passed())
        return;
    for (auto* button : block->findChildren<QAbstractButton*>())
        if (button->isVisible()) {
            sendMouse(button, QEvent::MouseButtonPress, Qt::LeftButton);
            sendMouse(button, QEvent::MouseButtonRelease, Qt::NoButton);
            return;
        }
}

void UnattendedRun::sendKey(int key, bool press)
{
    auto* focus = QApplication::focusWidget();
    QWidget* receiver = focus != nullptr && focus->window() == &m_window ? focus : &m_window;
    QKeyEvent event(press ? QEvent::KeyPress : QEvent::KeyRelease, key, Qt::NoModifier);
    QCoreApplication::sendEvent(receiver, &event);
}

} // namespace console
