// Puts what happens to sessions into the models, and into the log.
#pragma once

#include "model/console_models.hpp"

#include <liena/session_event.hpp>

#include <QObject>

#include <map>
#include <optional>

namespace console {

/// GUI thread only. Events must come in order: each state change is told, also one that has healed by the time it is read.
class SessionIntake : public QObject {
    Q_OBJECT
public:
    explicit SessionIntake(ConsoleModels& models, QObject* parent = nullptr);

    void take(const liena::SessionEvent& event);

    /// The live figures of every link; rates are reckoned from the reading before.
    void takeFigures(const std::vector<liena::LinkStatus>& links, Instant now);

Q_SIGNALS:
    void interrupted(quint32 peer, double milliseconds);
    void deadlineMissed(quint32 peer, const QString& message);
    void stalled(double milliseconds);
    void auditLost(const QString& reason);
    void auditRestored();

private:
    struct PeerClock {
        Duration offset{}; ///< peer's clock - ours
        Duration uncertainty{};
    };

    void takeIncident(const liena::SessionEvent& event);
    void takeChange(const liena::SessionEvent& event);
    void takeLoss(const liena::SessionEvent& event);
    void takeRemark(const liena::SessionEvent& event);
    IncidentRecord record(const liena::Incident& incident, Instant at) const;
    std::vector<HoldLine> holdLines(const liena::Incident& incident) const;
    void timeHold(HoldLine& line, const liena::Incident& incident, const liena::HoldReport& hold) const;
    void tellOtherWay(const liena::LinkStatus& before, const liena::LinkStatus& now);
    QString failureText(const liena::SessionEvent& event) const;
    QString ofIncident(const QString& line, const liena::Incident& incident) const;
    void log(LogKind kind, const QString& text);
    QString peerName(const liena::SessionEvent& event) const;

    ConsoleModels& m_models;
    std::map<quint32, PeerClock> m_clocks;            ///< last known, kept over a loss
    std::map<quint64, liena::Timestamp> m_localSince; ///< of own incidents, on this console's clock
    std::map<quint32, liena::LinkStatus> m_figuresBefore;
    Instant m_figuresAt;
};

} // namespace console
