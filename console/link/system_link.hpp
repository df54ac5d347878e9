// The console's part in the robotic system: sessions, messages in, orders out.
#pragma once

#include "link/message_intake.hpp"
#include "link/network_settings.hpp"
#include "link/session_intake.hpp"
#include "model/console_models.hpp"
#include "model/frame_sink.hpp"
#include "model/motion_order.hpp"
#include "model/pedal_order.hpp"

#include <QObject>
#include <QString>
#include <QStringList>
#include <QTimer>

#include <atomic>
#include <memory>
#include <optional>

namespace liena {
class DistributedSystem;
class Message;
class MessageSet;
} // namespace liena

namespace console {

class MotionStreamer;
class PedalStreamer;

struct LinkSettings {
    QString topology;
    QString device; ///< name or id; empty: the device whose message set is `siat-cockpit`
    QStringList registry;
    QString store;
    QString certificate;
    QString key;
    QString authority;
    bool measureOnRequest = false; ///< `liena bench --live` may ask this console
    NetworkSettings network;
};

/// What the console says of itself, twenty times a second.
struct CockpitReport {
    PermitPhase phase = PermitPhase::Off;
    bool deadMan = false;
    bool clutch = false;
    double scale = 1;
    double pictureAgeMs = 0;
    int alarmsHigh = 0;
    int alarmsMedium = 0;
    int alarmsLow = 0;
};

/// GUI thread, unless a function says otherwise.
class SystemLink : public QObject {
    Q_OBJECT
public:
    /// Reads everything and takes the port; null with one sentence in `error` when it cannot. `sink` gets pictures on the network thread
    /// from start() on and must outlive this object, like `models`.
    static std::unique_ptr<SystemLink> create(const LinkSettings& settings, ConsoleModels& models, FrameSink& sink, QString* error);

    ~SystemLink() override; ///< closes every session in order, within a second

    void start();
    void stop();

    std::optional<quint32> robot() const { return m_robot; }
    std::optional<quint32> xray() const { return m_xray; }

    // A person's commands.
    void open(quint32 peer);
    void openAll();
    void close(quint32 peer);
    void reopen(quint32 peer);
    void reopenAll();
    void probe(quint32 peer);
    void dismiss(quint64 incident, const QString& reason);

    // Orders.
    void requestArm(quint32 permit);
    void releasePermit(quint32 permit);

    /// The planned injection, once, under a number that was never used; what cannot be sent is refused here, and nothing is on its way.
    void inject(quint32 permit, quint32 number);

    /// To the robot under a token of its own, whatever stop is in force, repeated until the robot names it; over a session that is opened
    /// later as well.
    void emergencyStop(const QString& reason);

    /// Ends the stop that the robot names. It then holds, or names another one that is in force and has to be reset by itself.
    void resetEmergencyStop();

    void setMotion(const MotionSnapshot& snapshot);

    /// The permit under which nothing moves any more, whatever is asked: see MotionGate.
    std::optional<BlockedPermit> blockedPermit() const;
    void setPedal(const PedalSnapshot& snapshot);
    void confirmHold(bool holding);
    void publish(const CockpitReport& report);

    // Any thread.
    quint64 framesReceived() const { return m_framesReceived.load(std::memory_order_relaxed); }
    quint64 commandsSent() const;

    SessionIntake& sessionEvents() { return m_sessionIntake; }

private:
    SystemLink(std::unique_ptr<liena::DistributedSystem> system, ConsoleModels& models, FrameSink& sink);

    bool subscribe(QString* error);
    void takeFrame(std::shared_ptr<const liena::Message> message);
    void drain();
    void readFigures();
    void readRobotSet();
    void repeatEmergencyStop();
    void sendPermit(quint32 permit, const char* request);
    void note(LogKind kind, const QString& text);

    ConsoleModels& m_models;
    FrameSink& m_sink;
    MessageIntake m_messageIntake;
    SessionIntake m_sessionIntake;
    std::optional<quint32> m_robot;
    std::optional<quint32> m_xray;
    std::shared_ptr<const liena::MessageSet> m_robotSet; ///< the one that was looked at last
    QTimer m_figures;
    quint64 m_stopToken = 0; ///< of the newest stop, while the robot has not named it; 0: none
    QString m_stopReason;
    QString m_stopTrouble; ///< why it could not be sent when it was tried last; empty
    std::atomic<quint64> m_framesReceived{0};
    std::atomic<Duration::rep> m_xrayUncertainty{Duration::max().count()}; ///< of its clock against ours
    std::atomic<bool> m_frameComplaint{false};
    std::atomic<bool> m_foreignFrames{false}; ///< told once
    std::unique_ptr<MotionStreamer> m_motion;
    std::unique_ptr<PedalStreamer> m_pedal;
    std::unique_ptr<liena::DistributedSystem> m_system; ///< last: it goes first, and with it the network thread
};

} // namespace console
