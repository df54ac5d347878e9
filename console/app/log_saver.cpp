// Writing of a log.
#include "app/log_saver.hpp"

#include <QDateTime>
#include <QDir>
#include <QFileInfo>
#include <QSaveFile>
#include <QStandardPaths>

namespace console {

namespace {

QString write(const QByteArray& text, const QString& path)
{
    const QFileInfo file(path);
    if (path.trimmed().isEmpty() || file.fileName().isEmpty())
        return LogSaver::tr("No file is named. Write the name of one, for example %1.").arg(suggestedLogPath(QStringLiteral("events")));
    if (file.exists())
        return LogSaver::tr("%1 is there already and stays as it is. Name another file.").arg(path);
    if (!QDir().mkpath(file.absolutePath()))
        return LogSaver::tr("The folder %1 cannot be made. Name a file in another one.").arg(file.absolutePath());
    QSaveFile saved(path);
    if (saved.open(QIODevice::WriteOnly) && saved.write(text) == text.size() && saved.commit())
        return {};
    return LogSaver::tr("%1 cannot be written: %2. Nothing was saved; make room on the disk or name a file in another folder.")
        .arg(path, saved.errorString());
}

} // namespace

LogSaver::~LogSaver()
{
    if (m_thread.joinable())
        m_thread.join();
}

void LogSaver::save(const QByteArray& text, const QString& path)
{
    if (m_busy) {
        Q_EMIT failed(tr("A log is still being written. Save again when it is done."));
        return;
    }
    if (m_thread.joinable())
        m_thread.join();
    m_busy = true;
    m_thread = std::thread([this, text, path] {
        const QString reason = write(text, path);
        QMetaObject::invokeMethod(
            this, [this, path, reason] { finish(path, reason); }, Qt::QueuedConnection);
    });
}

void LogSaver::finish(const QString& path, const QString& reason)
{
    m_busy = false;
    if (reason.isEmpty())
        Q_EMIT saved(path);
    else
        Q_EMIT failed(reason);
}

QString suggestedLogPath(const QString& log)
{
    const QString folder = QStandardPaths::writableLocation(QStandardPaths::DocumentsLocation);
    const QString time = QDateTime::currentDateTimeUtc().toString(QStringLiteral("yyyy-MM-ddTHH-mm-ss"));
    return QDir(folder).filePath(QStringLiteral("liena/%1_%2.txt").arg(log, time));
}

} // namespace console
