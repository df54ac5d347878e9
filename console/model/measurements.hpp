// What one run of the console measured, for the report of an unattended run.
#pragma once

#include "model/instant.hpp"
#include "model/robot_values.hpp"

#include <QString>
#include <QtGlobal>

#include <map>
#include <optional>
#include <vector>

class QJsonObject;

namespace console {

/// The value below which `part` (0 … 1) of the values lie, by nearest rank; nothing without values.
std::optional<double> percentile(std::vector<double> values, double part);

class Measurements {
public:
    struct Session {
        QString device;
        QString state;
        bool open = false;
        std::optional<double> openingMs;
        QString failure;
    };

    std::map<quint32, Session> sessions; ///< by peer
    quint64 framesReceived = 0;
    quint64 framesPainted = 0;
    quint64 robotStatuses = 0;
    quint64 commandsSent = 0;
    std::optional<quint64> appliedAtStart; ///< as the robot reported it
    std::optional<quint64> appliedAtEnd;
    std::optional<double> guidewireAtStart; ///< mm
    std::optional<double> guidewireAtEnd;
    double guidewireTravel = 0; ///< mm, sum of the ways
    quint64 incidents = 0;
    quint64 alarms = 0;
    bool armed = false;
    bool engaged = false;
    QString holdCause;              ///< why motion ended before its time; empty
    QString stepFailure;            ///< the step that was not reached in time; empty
    std::optional<double> armingMs; ///< from the request to the robot's answer

    /// Counted while measuring, between begin() and end().
    void begin(Instant now) { m_begin = now; }
    void end(Instant now) { m_end = now; }
    Duration measured() const { return m_begin && m_end > *m_begin ? Duration(m_end - *m_begin) : Duration::zero(); }

    void notePainted(std::optional<double> ageMs);
    void noteRobot(const RobotStatus& status);

    double framesPerSecond() const;
    double statusesPerSecond() const;
    std::optional<double> pictureAge(double part) const { return percentile(m_ages, part); }
    quint64 applied() const
    {
        return appliedAtStart && appliedAtEnd && *appliedAtEnd > *appliedAtStart ? *appliedAtEnd - *appliedAtStart : 0;
    }

    /// What did not work, in words; empty when everything did.
    std::vector<QString> failures() const;

    QJsonObject toJson() const;

private:
    static constexpr std::size_t ageLimit = 200000;

    std::vector<double> m_ages; ///< ms at the paint
    std::optional<double> m_lastGuidewire;
    std::optional<Instant> m_begin;
    Instant m_end;
};

} // namespace console
