// A message bus of the test's own.
#pragma once

#include <QFile>
#include <QProcess>
#include <QStandardPaths>
#include <QString>
#include <QTemporaryDir>

#include <sys/prctl.h>

#include <csignal>

namespace console::test {

/// A dbus-daemon that nobody else knows of, and that would start a program for each of `activatable` when somebody wants that: it leaves
/// the file wasStarted(). Ends with the object, and with the test's process however that ends.
class PrivateBus {
public:
    explicit PrivateBus(const QStringList& activatable = {})
    {
        QString services;
        for (const auto& name : activatable) {
            write(name + QStringLiteral(".service"),
                  QStringLiteral("[D-BUS Service]\nName=%1\nExec=/usr/bin/touch %2\n").arg(name, startedFile()));
            services = QStringLiteral("<servicedir>%1</servicedir>").arg(m_folder.path());
        }
        write(QStringLiteral("bus.conf"), QStringLiteral("<busconfig><type>session</type><listen>unix:path=%1</listen>%2"
                                                         "<policy context=\"default\"><allow send_destination=\"*\" eavesdrop=\"true\"/>"
                                                         "<allow eavesdrop=\"true\"/><allow own=\"*\"/></policy></busconfig>")
                                              .arg(m_folder.filePath(QStringLiteral("bus")), services));
        m_daemon.setChildProcessModifier([] { ::prctl(PR_SET_PDEATHSIG, SIGKILL); });
        m_daemon.start(QStringLiteral("dbus-daemon"), {QStringLiteral("--nofork"), QStringLiteral("--print-address"),
                                                       QStringLiteral("--config-file=") + m_folder.filePath(QStringLiteral("bus.conf"))});
        if (m_daemon.waitForReadyRead(patience))
            m_address = QString::fromUtf8(m_daemon.readLine()).trimmed();
    }

    ~PrivateBus()
    {
        thaw();
        end();
    }
    Q_DISABLE_COPY_MOVE(PrivateBus)

    /// Why there can be none; empty: there can.
    static QString missing()
    {
        return QStandardPaths::findExecutable(QStringLiteral("dbus-daemon")).isEmpty()
                   ? QStringLiteral("there is no dbus-daemon on this computer: install the package dbus-daemon")
                   : QString();
    }

    const QString& address() const { return m_address; } ///< empty: it did not start

    bool wasStarted() const { return QFile::exists(startedFile()); }

    /// As if it crashed: no goodbye.
    void end()
    {
        m_daemon.kill();
        m_daemon.waitForFinished(patience);
    }

    void freeze() { signal(SIGSTOP); }
    void thaw() { signal(SIGCONT); }

private:
    static constexpr int patience = 30000; ///< milliseconds

    QString startedFile() const { return m_folder.filePath(QStringLiteral("started")); }

    void write(const QString& name, const QString& text) const
    {
        QFile file(m_folder.filePath(name));
        if (file.open(QIODevice::WriteOnly))
            file.write(text.toUtf8());
    }

    void signal(int number)
    {
        if (m_daemon.state() == QProcess::Running)
            ::kill(static_cast<pid_t>(m_daemon.processId()), number);
    }

    QTemporaryDir m_folder;
    QProcess m_daemon;
    QString m_address;
};

} // namespace console::test
