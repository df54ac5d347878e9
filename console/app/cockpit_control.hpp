// The loop between the surgeon's hand, the motion permit and the link.
#pragma once

#include "app/alarm_watch.hpp"
#include "app/hand_desk.hpp"
#include "app/interruption_watch.hpp"
#include "link/system_link.hpp"
#include "model/console_models.hpp"

#include <QObject>
#include <QTimer>

#include <optional>

namespace console {

/// GUI thread only; a hundred runs a second. Each run hands the newest permit, hand and picture to the network thread; when the runs stop,
/// motion stops there.
class CockpitControl : public QObject {
    Q_OBJECT
public:
    CockpitControl(ConsoleModels& models, SystemLink& link, HandDesk& hand, QObject* parent = nullptr);

    void start();

    AlarmWatch& alarmWatch() { return m_alarms; }
    InterruptionWatch& interruptionWatch() { return m_interruptions; }

    /// Pedal up and Hold: what is asked of the robot and the X-ray system ends before their sessions do.
    void stop();

    // What the window and the hand ask for.
    void setArmHeld(bool held);
    void setPedal(bool down);
    void setInjectHeld(bool held);
    void panicHold();

    /// `newtons` as it was shown; `who` for the log, may be empty.
    void acceptForce(double newtons, const QString& who);

    /// The hand may use the keyboard: the window is active, and nothing else in it has the focus.
    void setHandHasKeys(bool has);

private:
    void connectHand();
    void run();
    void checkAllGuards(Instant now);
    void checkGuards(Instant now);
    void apply(PermitEventKind kind);
    void apply(const PermitEvent& event, Instant now);
    void interrupt(quint32 peer);
    void carryOut(const PermitActions& actions, Instant now);
    void tellSession();
    void tellRobot();
    void expectPictures(Instant now);
    void driveInjection(Instant now);
    void hearInjection(quint32 number);
    void publishMotion(Instant now);
    void publishStatus(Instant now);
    GuardReadings readGuards(Instant now) const;
    void notePhase(PermitPhase from, PermitPhase to);
    bool pedalDown() const { return m_models.xray.pedalDown(); }

    ConsoleModels& m_models;
    SystemLink& m_link;
    HandDesk& m_hand;
    AlarmWatch m_alarms;
    InterruptionWatch m_interruptions;
    QTimer m_timer;
    std::optional<Instant> m_lastRun;
    quint64 m_runs = 0;
    quint32 m_press;
    quint32 m_injectionNumber;
    bool m_injectHeld = false;
    bool m_unansweredTold = false;
    std::optional<bool> m_confirmed; ///< what was last told of holding
};

} // namespace console
