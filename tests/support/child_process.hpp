// A program of ours as a child process: started, heard, killed, stopped and continued.
#pragma once

#include <QProcess>
#include <QString>
#include <QStringList>

namespace liena::test {

/// Ends with the object, whatever state it is in.
class ChildProcess {
public:
    /// `program` is a name in the build's folder of programs.
    ChildProcess(const QString& program, const QStringList& arguments);
    ~ChildProcess();

    /// Waits until a line on stderr holds `text`; false when the program ended or 30 s passed first.
    bool waitForLine(const QString& text);

    void say(const QString& line); ///< to its stdin
    void kill();                   ///< SIGKILL, and waits for the end
    void freeze();                 ///< SIGSTOP, and waits until all its threads have stopped
    void thaw();                   ///< SIGCONT
    int terminate();               ///< SIGTERM, and waits; the exit status, -1 when it crashed or hung

    qint64 id() const { return m_process.processId(); }
    bool isRunning() const { return m_process.state() == QProcess::Running; }
    int waitForEnd(); ///< the exit status, -1 when it crashed or did not end in 30 s
    QString output(); ///< all of stderr and stdout so far

private:
    QProcess m_process;
    QString m_output;
};

} // namespace liena::test
