// The alarm log on the disk: what was raised, ended and acknowledged, kept over a loss of power.
#pragma once

#include "app/alarm_line.hpp"
#include "model/alarm_list.hpp"

#include <QLockFile>
#include <QObject>
#include <QString>

#include <chrono>
#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace console {

/// Two files in one folder, `NAME.jsonl` and `NAME.previous.jsonl`, one entry a line; the first becomes the second when it is full, so the
/// last `fileLimit` entries are always there and never more than twice as many. Each line carries a hash of itself and of the line before:
/// the console changes no line, and a line that somebody changed does not fit. Entries are written and forced to the disk by a thread of
/// its own; the GUI thread never waits. What the disk does not take is written anew each second, also where it was taken and then not kept
/// (a failed fdatasync(2) tells of pages that are given up), and is lost only when it is too much.
class AlarmJournal : public QObject {
    Q_OBJECT
public:
    static constexpr std::size_t fileLimit = 2000;                                       ///< entries
    static constexpr qint64 byteLimit = static_cast<qint64>(fileLimit) * alarmLineLimit; ///< of one file: what is larger is not ours
    static constexpr std::size_t queueLimit = 10'000; ///< entries that wait for a slow disk; more are lost, and counted

    static constexpr std::chrono::seconds usualRoomPeriod{10};

    /// `folder` is made if need be. Reads what is there; nothing is written before the first entry. The disk's room is looked at with each
    /// entry and, while none comes, each `roomPeriod`.
    AlarmJournal(const QString& folder, const QString& name, Duration roomPeriod = usualRoomPeriod, QObject* parent = nullptr);
    ~AlarmJournal() override; ///< what waits is written first

    /// Of earlier runs, oldest first.
    const std::vector<AlarmLogEntry>& restored() const { return m_restored; }

    /// What was found when it was opened, in words: a last line that a loss of power tore, a line that does not fit. Empty: all is well.
    const QString& remark() const { return m_remark; }

    /// Why entries do not reach the disk, or soon will not; empty: they do. Later changes are told by troubleChanged.
    const QString& trouble() const { return m_trouble; }

    /// They do reach it, as far as is known.
    bool keeps() const { return m_keeps; }

    QString fileName() const { return m_file; }

    void append(const AlarmLogEntry& entry);

Q_SIGNALS:
    void troubleChanged(const QString& trouble);

private:
    void read(const QString& file, bool newest);
    void run();
    bool waitForWork(std::unique_lock<std::mutex>& lock);
    QString writeAll();
    QString write(const AlarmLogEntry& entry);
    bool openNewest();
    void closeNewest();
    bool sync();
    QString checkRoom() const;
    void report(const QString& trouble, bool keeps);

    QString m_folder;
    Duration m_roomPeriod;
    QString m_file;
    QString m_previous;
    std::unique_ptr<QLockFile> m_lock;
    std::vector<AlarmLogEntry> m_restored;
    QString m_remark;
    QString m_trouble;    ///< GUI thread
    bool m_keeps = false; ///< GUI thread

    /// How far a file goes.
    struct Place {
        std::size_t entries = 0;
        qint64 bytes = 0; ///< where its last whole line ends
        QByteArray chain;
    };

    // Of the writing thread, from its start on.
    int m_descriptor = -1;
    Place m_written;                       ///< of the newest file
    std::deque<AlarmLogEntry> m_unwritten; ///< taken over, and not written yet
    std::deque<AlarmLogEntry> m_unsynced;  ///< written, and not known to be on the disk
    Place m_synced;                        ///< of the newest file: what is known to be there
    bool m_torn = false;                   ///< half a line stands at the end of the newest file
    QString m_reported;
    bool m_reportedKeeps = true;

    std::mutex m_mutex;
    std::condition_variable m_wake;
    std::deque<AlarmLogEntry> m_waiting;
    std::size_t m_lost = 0;
    bool m_stopping = false;
    std::thread m_thread; ///< last: it uses all of the above
};

} // namespace console
