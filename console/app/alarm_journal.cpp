// The alarm log on the disk.
#include "app/alarm_journal.hpp"

#include "app/alarm_line.hpp"

#include <QDir>
#include <QFile>
#include <QStorageInfo>

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

namespace console {

namespace {

constexpr std::chrono::seconds retryPeriod{1};
constexpr qint64 leastRoom = 64 * 1024 * 1024;

QString because(const QString& what, const QString& file) { return what.arg(file, QString::fromLocal8Bit(std::strerror(errno))); }

void forceFolder(const QString& folder)
{
    const int descriptor = ::open(QFile::encodeName(folder).constData(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0)
        return;
    ::fsync(descriptor);
    ::close(descriptor);
}

} // namespace

AlarmJournal::AlarmJournal(const QString& folder, const QString& name, Duration roomPeriod, QObject* parent)
    : QObject(parent),
      m_folder(QDir(folder).absolutePath()),
      m_roomPeriod(roomPeriod),
      m_file(m_folder + QLatin1Char('/') + name + QStringLiteral(".jsonl")),
      m_previous(m_folder + QLatin1Char('/') + name + QStringLiteral(".previous.jsonl"))
{
    if (!QDir().mkpath(m_folder)) {
        m_trouble = tr("%1 cannot be made").arg(m_folder);
        return;
    }
    m_lock = std::make_unique<QLockFile>(m_file + QStringLiteral(".lock"));
    m_lock->setStaleLockTime(0);
    if (!m_lock->tryLock(0)) {
        m_trouble = m_lock->error() == QLockFile::LockFailedError ? tr("%1 is in use by another console").arg(m_file)
                                                                  : tr("%1 may not be written").arg(m_folder);
        return;
    }
    read(m_previous, false);
    read(m_file, true);
    m_synced = m_written;
    if (!openNewest()) {
        m_trouble = because(tr("%1 cannot be opened: %2"), m_file);
        return;
    }
    m_trouble = checkRoom();
    m_reported = m_trouble;
    m_keeps = true;
    m_thread = std::thread([this] { run(); });
}

AlarmJournal::~AlarmJournal()
{
    if (m_thread.joinable()) {
        {
            const std::lock_guard lock(m_mutex);
            m_stopping = true;
        }
        m_wake.notify_one();
        m_thread.join();
    }
    closeNewest();
}

/// The chain runs on from the older file into the newer. Only the newest file's last line can be torn.
void AlarmJournal::read(const QString& name, bool newest)
{
    QFile file(name);
    if (!file.open(QIODevice::ReadOnly))
        return;
    const QByteArray bytes = file.read(byteLimit);
    qsizetype at = 0;
    bool fits = true;
    for (auto end = bytes.indexOf('\n'); end >= 0; end = bytes.indexOf('\n', at)) {
        const auto line = bytes.mid(at, end - at);
        const auto entry = readAlarmLine(line, m_written.chain);
        // The very first line follows one that is no more.
        fits = fits && (entry.fits || m_restored.empty());
        if (entry.readable)
            m_restored.push_back(entry.entry);
        m_written.chain = entry.chain;
        at = end + 1;
        if (newest)
            ++m_written.entries;
    }
    if (!fits)
        m_remark += tr("%1: a line does not follow from the one before it; the file was changed or damaged. ").arg(name);
    if (at < bytes.size())
        m_remark += tr("%1: the last line is torn, as a loss of power leaves it; it was dropped. ").arg(name);
    if (newest)
        m_written.bytes = at;
}

bool AlarmJournal::openNewest()
{
    m_descriptor = ::open(QFile::encodeName(m_file).constData(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600);
    if (m_descriptor < 0)
        return false;
    if (::lseek(m_descriptor, 0, SEEK_END) > m_written.bytes && ::ftruncate(m_descriptor, m_written.bytes) != 0) {
        const int failed = errno;
        closeNewest();
        errno = failed;
        return false;
    }
    forceFolder(m_folder);
    return true;
}

void AlarmJournal::closeNewest()
{
    if (m_descriptor >= 0)
        ::close(std::exchange(m_descriptor, -1));
}

/// False: what was written since the last time is to be written again. The kernel tells of it once, and takes those pages for clean then.
bool AlarmJournal::sync()
{
    if (m_unsynced.empty())
        return true;
    if (::fdatasync(m_descriptor) == 0) {
        m_unsynced.clear();
        m_synced = m_written;
        return true;
    }
    const int failed = errno;
    m_unwritten.insert(m_unwritten.begin(), m_unsynced.begin(), m_unsynced.end());
    m_unsynced.clear();
    m_written = m_synced;
    m_torn = false;
    closeNewest(); // it is cut to what is known to be there when it is opened again
    errno = failed;
    return false;
}

QString AlarmJournal::checkRoom() const
{
    const auto room = QStorageInfo(m_folder).bytesAvailable();
    return room >= 0 && room < leastRoom ? tr("the disk of %1 is nearly full, %2 MB left").arg(m_folder).arg(room / 1024 / 1024)
                                         : QString();
}

void AlarmJournal::append(const AlarmLogEntry& entry)
{
    {
        const std::lock_guard lock(m_mutex);
        if (m_waiting.size() >= queueLimit || !m_thread.joinable()) {
            ++m_lost;
            return;
        }
        m_waiting.push_back(entry);
    }
    m_wake.notify_one();
}

/// False: there is none, and all that there was is on the disk.
bool AlarmJournal::waitForWork(std::unique_lock<std::mutex>& lock)
{
    if (m_unwritten.empty())
        return m_wake.wait_for(lock, m_roomPeriod, [this] { return m_stopping || !m_waiting.empty(); });
    m_wake.wait_for(lock, retryPeriod, [this] { return m_stopping; });
    return true;
}

void AlarmJournal::run()
{
    std::unique_lock lock(m_mutex);
    bool ending = false;
    while (!ending) {
        if (!waitForWork(lock)) {
            lock.unlock();
            report(checkRoom(), true); // another program may have filled the disk, or somebody made room
            lock.lock();
            continue;
        }
        ending = m_stopping;
        while (!m_waiting.empty() && m_unwritten.size() < queueLimit) {
            m_unwritten.push_back(std::move(m_waiting.front()));
            m_waiting.pop_front();
        }
        const auto lost = std::exchange(m_lost, 0);
        lock.unlock();
        auto failure = writeAll();
        if (lost > 0)
            failure = tr("%1 entries were lost, the disk is too slow").arg(lost);
        if (!sync() && failure.isEmpty())
            failure = because(tr("%1 is not kept: %2"), m_file);
        report(failure.isEmpty() ? checkRoom() : failure, failure.isEmpty());
        lock.lock();
    }
}

/// In their order: what a disk does not take now waits for it.
QString AlarmJournal::writeAll()
{
    while (!m_unwritten.empty()) {
        if (const auto wrong = write(m_unwritten.front()); !wrong.isEmpty())
            return wrong;
        m_unsynced.push_back(std::move(m_unwritten.front()));
        m_unwritten.pop_front();
    }
    return {};
}

QString AlarmJournal::write(const AlarmLogEntry& entry)
{
    if (m_written.entries >= fileLimit || m_written.bytes > byteLimit - alarmLineLimit) {
        if (!sync() || std::rename(QFile::encodeName(m_file).constData(), QFile::encodeName(m_previous).constData()) != 0)
            return because(tr("%1 cannot be put aside: %2"), m_file);
        closeNewest();
        m_written = {0, 0, m_written.chain};
        m_synced = m_written;
    }
    if (m_descriptor < 0 && !openNewest())
        return because(tr("%1 cannot be opened: %2"), m_file);
    if (m_torn && ::ftruncate(m_descriptor, m_written.bytes) != 0)
        return because(tr("%1 cannot be put right: %2"), m_file);
    m_torn = false;
    const auto line = alarmLine(entry, m_written.chain);
    const auto written = ::write(m_descriptor, line.bytes.constData(), static_cast<std::size_t>(line.bytes.size()));
    if (written != line.bytes.size()) {
        const auto wrong = because(tr("%1 cannot be written: %2"), m_file);
        m_torn = ::ftruncate(m_descriptor, m_written.bytes) != 0; // half a line would be taken for one that was torn
        return wrong;
    }
    m_written.chain = line.chain;
    m_written.bytes += written;
    ++m_written.entries;
    return {};
}

void AlarmJournal::report(const QString& trouble, bool keeps)
{
    if (trouble == m_reported && keeps == m_reportedKeeps)
        return;
    m_reported = trouble;
    m_reportedKeeps = keeps;
    QMetaObject::invokeMethod(this, [this, trouble, keeps] {
        m_trouble = trouble;
        m_keeps = keeps;
        Q_EMIT troubleChanged(trouble);
    });
}

} // namespace console
