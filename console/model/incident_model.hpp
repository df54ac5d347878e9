// The incidents that this console holds, and the words of the diagnosis prompt for each.
#pragma once

#include "model/incident.hpp"
#include "model/picture_state.hpp"

#include <QObject>
#include <QString>
#include <QStringList>

#include <chrono>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

namespace console {

class SessionModel;

/// What the prompt must know besides the incident itself.
struct PromptSurroundings {
    quint32 robot = 0; ///< the device whose hold decides whether the patient is safe; 0 when the topology has none
    PictureCondition picture = PictureCondition::None;
    bool pictureRecorded = false; ///< nothing may be moved by it, but in a rehearsal
    bool rehearsal = false;
    std::optional<qint64> frozenSinceWallMs; ///< when the picture that stands was taken, on this console's clock; else when it came
    bool tipLive = false;
    bool tipKnown = false;
    QString patientSide; ///< how a person there is called; empty: not set up
    QString ownHost;     ///< the address at which this console is reached; empty: not known
    std::chrono::seconds audioPause{60};
    std::optional<Instant> robotHeldAt; ///< when the robot last said over its open link that it holds; nothing: not lately
    int lostLinks = 0;                  ///< this console's links in stand-by
    bool lostTogether = false;          ///< beganTogether()
    int ownLinks = 0;
};

/// The content of the prompt, top to bottom, ready to be shown.
struct PromptContent {
    QString headline;   ///< `Robot link lost`
    QString directions; ///< `to robot: unknown · from robot: silent`
    QString since;      ///< `for 0:12, since 12:03:41`
    QString flaps;      ///< `3rd time in 2 min`; empty the first time
    QString patient;    ///< `Robot holds: CONFIRMED …` or `NOT CONFIRMED that robot holds. …`: the denial is read first
    bool holdConfirmed = false;
    QString call; ///< `Call the patient side: …`; empty when there is nothing to ask
    std::vector<HoldLine> rollCall;
    QString picture; ///< `Picture: live` or `Picture: frozen since 12:03:41.2`
    QString tip;     ///< `Tip position: last known`
    QStringList evidence;
    QStringList details; ///< for whoever has to find the cause: devices, addresses, times in UTC
    QString likelyCause;
    QString tryFirst;
    QString lastTry;        ///< why the last re-opening failed; empty
    QString folded;         ///< the one line of the chip
    QString silence;        ///< `Silence 60 s`
    bool decided = true;    ///< an incident stands: there is something to do about it
    bool healed = false;    ///< there is nothing left to do but to close the sheet
    bool canReopen = false; ///< this console is one end of the pair
    bool reopening = false; ///< that is under way
    int lostLinks = 0;      ///< `Re-open all lost (2)` when more than one
};

/// Pure: no clock, no state.
PromptContent promptContent(const IncidentRecord& incident, const SessionModel& sessions, const PromptSurroundings& around, Instant now);

/// Its details: exact time and number of the incident, both ends with their addresses, what the peer said last, the system's topology.
QStringList promptDetails(const IncidentRecord& incident, const SessionModel& sessions);

/// The same as a text for a file, one fact a line.
QString promptReport(const PromptContent& content);

/// The likely cause and what to try first for what a probe found.
struct ProbeAdvice {
    QString cause;
    QString tryFirst;
};
/// `onlyPictures`: it is the pictures' link, and every other of this console carries messages. `othersThereAnswer`: whether other devices
/// at the same site are in session; nothing when there is none to compare with.
ProbeAdvice adviceFor(const LinkDiagnosis& diagnosis, const PromptSurroundings& around, bool onlyPictures,
                      std::optional<bool> othersThereAnswer);

/// `heartbeats stopped`, `connection broke`, …
QString word(LossKind kind);

class IncidentModel;

/// The losses of all of this console's links began within two seconds of each other, and all of them stand.
bool beganTogether(const SessionModel& sessions, const IncidentModel& incidents);

/// Incidents, and losses of this console's links that may become some: an interruption has its sheet at once, and holds nobody up. Only an
/// incident keeps the system in stand-by and is asked for by permit, guards and accounts. GUI thread only.
class IncidentModel : public QObject {
    Q_OBJECT
public:
    explicit IncidentModel(QObject* parent = nullptr);

    static constexpr std::chrono::seconds healedShown{10};

    /// Those that have not ended, oldest first.
    const std::vector<IncidentRecord>& incidents() const { return m_incidents; }

    /// Of links that are interrupted, or were within the last `healedShown`; one for each link at the most, none where an incident is.
    const std::vector<IncidentRecord>& interruptions() const { return m_interruptions; }

    /// An incident or an interruption.
    const IncidentRecord* incident(quint64 id) const;
    const IncidentRecord* ofPair(quint32 a, quint32 b) const;
    bool empty() const { return m_incidents.empty(); }

    /// All that were ever raised, for the report.
    quint64 raisedInAll() const { return m_raised; }

    // For the link room. An incident that is raised again is updated.
    void raise(const IncidentRecord& incident, Instant now);
    void end(quint64 id);
    void setHolds(quint64 id, std::vector<HoldLine> holds);
    void setDiagnosis(quint64 id, const LinkDiagnosis& diagnosis);
    void setReopenFailure(quint64 id, const QString& reason);
    /// A link of this console may be lost; its number in the record is given here.
    void interrupt(IncidentRecord interruption, Instant now);
    void heal(quint32 peer, Instant now);
    void forgetInterruption(quint32 peer);

    // For widgets: the sheet's own state.
    void setProbing(quint64 id, bool probing);
    void setFolded(quint64 id, bool folded);
    void forgetHealed(Instant now);

Q_SIGNALS:
    void interruptionBegan(quint64 id);                               ///< or began again, after it had healed
    void interruptionEnded(quint64 id);                               ///< its sheet is no longer wanted
    void interruptionDecided(quint64 interruption, quint64 incident); ///< before incidentRaised
    void incidentRaised(quint64 id);
    void incidentChanged(quint64 id);
    void incidentEnded(quint64 id);

private:
    IncidentRecord* find(quint64 id);
    int countFlaps(quint32 a, quint32 b, Instant now);
    IncidentRecord* interruptionOf(quint32 peer);
    std::optional<IncidentRecord> takeInterruption(quint32 peer);

    struct Flap {
        quint32 a = 0;
        quint32 b = 0;
        Instant at;
    };

    std::vector<IncidentRecord> m_incidents;
    std::vector<IncidentRecord> m_interruptions;
    std::deque<Flap> m_flaps;
    quint64 m_raised = 0;
};

} // namespace console
