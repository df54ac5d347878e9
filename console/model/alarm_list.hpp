// Alarm conditions by priority: present, latched, acknowledged, and their log. Follows the conventions of IEC 60601-1-8.
#pragma once

#include "model/instant.hpp"

#include <QObject>
#include <QString>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

namespace console {

enum class AlarmPriority : std::uint8_t { Low, Medium, High };
QString word(AlarmPriority priority);

enum class AlarmCondition : std::uint8_t {
    LinkLost,         ///< subject: the peer; or with `other` a pair of other devices
    HoldNotConfirmed, ///< the robot has not confirmed its hold 200 ms after the stop
    ImageLost,        ///< subject: the peer that sends the live picture
    PictureStale,
    PictureReduced,
    PictureSlow, ///< noticeably fewer pictures than expected, and more than end motion
    ForceStop,
    ForceWarn,
    DriveFault,
    EmergencyStop,
    StopUnheard,    ///< a person asks for an emergency stop, and the robot has not told of one after 200 ms
    DeadlineMissed, ///< subject: the peer
    LinkUnsteady,   ///< subject: the peer; suspect three times within a minute, or jitter or loss above the limit
    PacketsLost,    ///< subject: the peer; UDP packets passed, and do so no more
    ClockUncertain, ///< subject: the peer
    SoftLimit,
    HardLimit,
    CommandRoundTrip, ///< subject: the robot
    TrackerStale,
    RoadmapRemoved,
    ContrastLow,
    ContrastEmpty,
    AirKerma,        ///< raised anew with every further gray
    FluoroscopyTime, ///< raised anew with every further five minutes
    PaintingBehind,  ///< pictures arrive faster than they are painted
    SystemDiffers,   ///< subject: the peer whose topology or message set is another
    RecorderStopped, ///< alarms or sessions are not recorded, or will soon not be
    SoundFailed,
    WatchdogGone, ///< nobody would sound an alarm for this program
};

struct Alarm {
    quint64 id = 0;
    AlarmCondition condition = AlarmCondition::LinkLost;
    quint32 subject = 0; ///< the device it is about; 0 when none
    AlarmPriority priority = AlarmPriority::Low;
    QString text;   ///< what is wrong
    QString remedy; ///< what to do now, one sentence
    Instant raised;
    qint64 raisedWallMs = 0; ///< Unix time, milliseconds
    bool present = true;     ///< false: it ended (endDelay() is over), and stays until acknowledged
    bool latching = false;
    bool acknowledged = false;
    int step = 0;
    quint64 causes = 0;
    std::optional<Instant> missingSince; ///< not reported any more, and not ended yet
    std::optional<Instant> lesserSince;  ///< reported with fewer causes or, once acknowledged, with a lower priority
    quint32 other = 0;                   ///< the second device of a pair that it is about; 0 when none
    qint64 endedWallMs = 0;              ///< when it is not present: since when

    /// It flashes.
    bool demandsAttention() const { return !acknowledged; }

    /// What is shown latches; what sounds does not.
    bool sounds() const { return present && !acknowledged; }
};

struct AlarmLogEntry {
    qint64 wallMs = 0;
    AlarmPriority priority = AlarmPriority::Low;
    QString text;                ///< `raised: …`, `ended: …`, `acknowledged by …: …`
    std::optional<Instant> at{}; ///< for comparing: a wall clock may be set; nothing for those of earlier runs
};

/// For how long a condition must be gone before it has ended. It is raised at once, and one that trembles at its limit stays one alarm,
/// which sounds in its rhythm and stays acknowledged. None where the end is an event, after which the next one is another alarm, and where
/// the rule waits for the end itself.
Duration endDelay(AlarmCondition condition);

/// What a rule says about one condition now.
struct AlarmReport {
    AlarmCondition condition = AlarmCondition::LinkLost;
    quint32 subject = 0;
    AlarmPriority priority = AlarmPriority::Low;
    bool latching = false;
    QString text;
    QString remedy;
    int step = 0;       ///< of a condition that grows in steps of one priority: a higher one demands attention anew
    quint64 causes = 0; ///< one bit for each of several causes of one condition: one that joins demands attention anew
    quint32 other = 0;  ///< with `subject` the pair that it is about
};

/// GUI thread only.
class AlarmList : public QObject {
    Q_OBJECT
public:
    static constexpr std::size_t logLimit = 2000;
    static constexpr std::chrono::seconds longestEndDelay{2};
    static constexpr std::chrono::seconds audioPause{60};
    static constexpr std::chrono::seconds leastAudioPause{30};
    static constexpr std::chrono::seconds mostAudioPause{120}; ///< the site's limit
    static constexpr std::chrono::seconds leastAudible{10};    ///< each medium alarm is heard once in that time, each high one twice

    explicit AlarmList(QObject* parent = nullptr);

    /// Highest priority first, then those that are present, then the unacknowledged, then the newest: what ended never stands before what
    /// is there and as urgent.
    const std::vector<Alarm>& alarms() const { return m_alarms; }
    const Alarm* highest() const { return m_alarms.empty() ? nullptr : &m_alarms.front(); }
    int count(AlarmPriority priority) const;

    /// It is shown, so nobody arms beside it: also one that ended and latched, and one whose endDelay() runs.
    bool unacknowledgedHigh() const;

    /// The condition is there, or has not been gone for its endDelay() yet; of whatever device, acknowledged or not.
    bool stands(AlarmCondition condition) const;

    /// Replaces the set of present conditions: new ones are raised at once, missing ones end after their endDelay(); a condition whose
    /// priority rises is raised anew. To be called ten times a second: an end is found at a call.
    void update(const std::vector<AlarmReport>& present, Instant now, qint64 wallMs);

    /// `who` is for the log; empty when nobody said who it is.
    void acknowledge(quint64 id, qint64 wallMs, const QString& who = {}, Instant now = std::chrono::steady_clock::now());

    /// How long a pause lasts, within its bounds; one that runs already keeps its end.
    void setAudioPause(std::chrono::seconds length) { m_audioPause = std::clamp(length, leastAudioPause, mostAudioPause); }

    /// Silences the sound for that long; a new high alarm ends it.
    void pauseAudio(Instant now, qint64 wallMs = 0, const QString& who = {});
    void resumeAudio(Instant now, qint64 wallMs);

    /// Sound can be heard again for `leastAudible` since the last pause ended, however it did, or there was none. While armed nobody pauses
    /// it sooner: pause after pause would be silence for good.
    bool audibleForLong(Instant now) const { return audibleForLongIn(now) == Duration::zero(); }
    Duration audibleForLongIn(Instant now) const; ///< when nothing pauses it again; zero: it is

    std::chrono::seconds audioPauseLength() const { return m_audioPause; }
    std::optional<Duration> audioPauseLeft(Instant now) const;

    const std::deque<AlarmLogEntry>& log() const { return m_log; } ///< oldest first

    /// Of earlier runs, oldest first; they stand before everything that this run logs.
    void restoreLog(const std::vector<AlarmLogEntry>& entries);

    /// Something about alarms that is no condition: a self-test, a start.
    void note(qint64 wallMs, const QString& text, Instant now = std::chrono::steady_clock::now())
    {
        write(wallMs, AlarmPriority::Low, text, now);
    }

    quint64 raisedInAll() const { return m_raised; }

Q_SIGNALS:
    void changed();
    void raised(quint64 id);
    void acknowledged(console::AlarmPriority priority); ///< one of that priority, before `changed`
    void logged(const console::AlarmLogEntry& entry);
    void logRestored();

private:
    bool raise(const AlarmReport& report, Instant now, qint64 wallMs);
    void endPause(Instant now);
    void write(qint64 wallMs, AlarmPriority priority, const QString& text, Instant now);
    void sort();

    std::vector<Alarm> m_alarms;
    std::deque<AlarmLogEntry> m_log;
    std::chrono::seconds m_audioPause = audioPause;
    std::optional<Instant> m_audioPausedUntil;
    std::optional<Instant> m_audibleSince; ///< the end of the last pause, or of this one
    quint64 m_nextId = 1;
    quint64 m_raised = 0;
};

} // namespace console
