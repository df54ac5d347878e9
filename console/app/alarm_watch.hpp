// Holds the models against the alarm rules.
#pragma once

#include "model/alarm_rules.hpp"
#include "model/console_models.hpp"

#include <QObject>

#include <map>
#include <optional>

namespace console {

/// GUI thread only.
class AlarmWatch : public QObject {
    Q_OBJECT
public:
    AlarmWatch(ConsoleModels& models, std::optional<quint32> robot, QObject* parent = nullptr);

    /// Ten times a second.
    void update(Instant now);

    /// A peer's report is overdue; it counts until reports come again.
    void noteDeadlineMissed(quint32 peer, const QString& message, Instant now);

private:
    void notePhase(PermitPhase from, PermitPhase to);
    bool robotHoldsSince(Instant stop) const;
    AlarmLinkReading linkReading(const LinkNode& link, Instant now) const;
    AlarmReadings readings(Instant now) const;

    struct Overdue {
        QString message;
        Instant at;
    };

    ConsoleModels& m_models;
    std::optional<quint32> m_robot;
    std::optional<Instant> m_stopAt; ///< motion ended and the robot has not yet said that it holds
    bool m_troubleWhileArmed = false;
    std::map<quint32, Overdue> m_overdue;
};

} // namespace console
