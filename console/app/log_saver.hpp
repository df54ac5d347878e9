// Writes a log into a file: the disk keeps nobody waiting, and a file is there whole or not at all.
#pragma once

#include <QByteArray>
#include <QObject>
#include <QString>

#include <thread>

namespace console {

/// GUI thread only; each writing runs on a thread of its own, one at a time.
class LogSaver : public QObject {
    Q_OBJECT
public:
    using QObject::QObject;
    ~LogSaver() override;

    /// A file that is there already stays as it is, and that is told. The folder is made when it is missing.
    void save(const QByteArray& text, const QString& path);

Q_SIGNALS:
    void saved(const QString& path);
    void failed(const QString& reason); ///< one sentence with the file, the reason and what to do

private:
    void finish(const QString& path, const QString& reason);

    bool m_busy = false;
    std::thread m_thread;
};

/// `…/liena` in the person's documents, with a name for a log or a report that is written now.
QString suggestedLogPath(const QString& log);

} // namespace console
