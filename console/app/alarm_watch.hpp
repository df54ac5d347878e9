// Holds the models against the alarm rules.
#pragma once

#include "model/alarm_rules.hpp"
#include "model/console_models.hpp"
#include "model/line_quality.hpp"

#include <QObject>

#include <deque>
#include <map>
#include <optional>
#include <set>

namespace console {

/// GUI thread only.
class AlarmWatch : public QObject {
    Q_OBJECT
public:
    AlarmWatch(ConsoleModels& models, std::optional<quint32> robot, QObject* parent = nullptr);

    /// Ten times a second. `delivered`: pictures that this console has received, in all.
    void update(Instant now, quint64 delivered);

    /// A peer's report is overdue; it counts until the next one comes, and for five seconds, but not beyond the session.
    void noteDeadlineMissed(quint32 peer, const QString& message, Instant now);

    /// A motion command did not leave, since the picture had become too old for it; it need not be by the time of this.
    void notePictureTooOld(Instant now) { m_pictureTooOld = now; }

    /// Motion ended, and the robot has not said yet that it holds, or that another console has armed it.
    bool holdAwaited() const { return m_stopAt.has_value(); }

    // What this program says of itself, each in words; empty: it works.
    void setSoundTrouble(const QString& trouble) { m_soundTrouble = trouble; }
    void setWatchdogTrouble(const QString& trouble) { m_watchdogTrouble = trouble; }

private:
    void notePhase(PermitPhase from, PermitPhase to);
    void noteLink(quint32 peer, LinkState from, LinkState to);
    void noteSettled(Instant now);
    void forgetTrouble();
    void noteIncidents(Instant now);
    void awaitHold(Instant now);
    bool anotherHasRobot() const;
    bool robotHolds() const;
    const std::optional<Instant>* lastHeard(quint32 peer, const QString& message) const;
    QString overdueOf(quint32 peer, Instant now) const;
    AlarmLinkReading linkReading(const LinkNode& link, Instant now) const;
    AlarmReadings readings(Instant now) const;
    bool awaitsNew(std::optional<Instant> received, Duration limit, Instant now) const;
    void readInstruments(AlarmReadings& all, Instant now) const;
    void noteLines(Instant now);
    void noteDelivered(quint64 delivered, Instant now);
    void noteRate(Instant now);
    std::optional<PaintingReading> painting() const;

    struct Counted {
        Instant at;
        quint64 delivered = 0;
        quint64 painted = 0;
    };

    /// An incident of two other devices.
    struct OfOthers {
        bool told = false;                   ///< by an alarm of its own; else by that of the lost link to one of the two
        std::optional<Instant> ownBackSince; ///< since when that link is not lost any more

        void awaitFollowing(Instant now);
    };

    ConsoleModels& m_models;
    std::optional<quint32> m_robot;
    Instant m_armedAt;
    std::optional<Instant> m_stopAt; ///< motion ended and the robot has not yet said that it holds
    Instant m_holdCounts;            ///< what the robot says later than this is about the newest of those stops
    bool m_troubleWhileArmed = false;
    bool m_troubleWhileEngaged = false;                      ///< motion has ended by the time that its cause is looked at
    std::optional<Instant> m_pictureTooOld;                  ///< when the last check before the wire found that, and motion ended
    std::optional<Instant> m_settledSince;                   ///< since when nothing of that trouble is undecided
    std::map<quint32, std::map<QString, Instant>> m_overdue; ///< by peer and message: since when
    std::map<quint32, Instant> m_carriesSince; ///< by peer: from when on its messages pass, for the last time that they began to
    std::set<quint32> m_closedWhileArmed;      ///< peers
    std::map<quint32, LineQuality> m_lines;
    std::map<quint64, OfOthers> m_ofOthers; ///< by incident
    std::deque<Counted> m_counted;          ///< of the last two seconds
    bool m_pictureSlow = false;             ///< too few pictures are shown, and not only for a moment
    std::optional<Instant> m_rateChanged;   ///< since when it is the other way round, without a gap
    QString m_soundTrouble;
    QString m_watchdogTrouble;
};

} // namespace console
