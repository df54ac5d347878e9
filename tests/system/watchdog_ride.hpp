// A rider, which stands for the console, and its watchdog, both real processes.
#pragma once

#include <QFile>
#include <QProcess>
#include <QTemporaryDir>

#include <csignal>

namespace console::test {

/// Both write to one file, so that the watchdog is heard when the rider is dead.
class Ride {
public:
    explicit Ride(const QString& how, int mourning = 1)
    {
        m_rider.setStandardErrorFile(said());
        m_rider.start(QStringLiteral(LIENA_PROGRAM_DIR "/watchdog_rider"),
                      {QStringLiteral(LIENA_PROGRAM_DIR "/liena-console-watchdog"), how, QString::number(mourning)});
    }

    ~Ride()
    {
        if (m_rider.state() == QProcess::NotRunning)
            return;
        send(SIGCONT);
        m_rider.kill();
        m_rider.waitForFinished();
    }

    QString said() const { return m_folder.filePath(QStringLiteral("said")); }

    bool says(const char* words) const
    {
        QFile file(said());
        return file.open(QIODevice::ReadOnly) && file.readAll().contains(words);
    }

    /// Of the watchdog, as it says itself; 0 before.
    qint64 watchdog() const
    {
        QFile file(said());
        if (!file.open(QIODevice::ReadOnly))
            return 0;
        const auto text = QString::fromUtf8(file.readAll());
        const auto at = text.indexOf(QStringLiteral("process "));
        return at < 0 ? 0 : text.mid(at + 8).section(QLatin1Char('\n'), 0, 0).toLongLong();
    }

    /// Ended, whoever has to collect it.
    static bool isGone(qint64 process)
    {
        QFile file(QStringLiteral("/proc/%1/stat").arg(process));
        return !file.open(QIODevice::ReadOnly) || file.readAll().contains(") Z ");
    }

    void send(int signal) const { ::kill(static_cast<pid_t>(m_rider.processId()), signal); }
    QProcess& rider() { return m_rider; }

private:
    QTemporaryDir m_folder;
    QProcess m_rider;
};

} // namespace console::test
