// Handling of child processes.
#include "child_process.hpp"

#include <QDeadlineTimer>

#include <sys/prctl.h>
#include <sys/wait.h>

#include <csignal>

namespace liena::test {

namespace {
constexpr int patience = 30000;
}

ChildProcess::ChildProcess(const QString& program, const QStringList& arguments)
{
    m_process.setProcessChannelMode(QProcess::MergedChannels);
    // A test that crashes leaves nothing running.
    m_process.setChildProcessModifier([] { ::prctl(PR_SET_PDEATHSIG, SIGKILL); });
    m_process.start(QStringLiteral(LIENA_PROGRAM_DIR "/") + program, arguments);
    m_process.waitForStarted(patience);
}

ChildProcess::~ChildProcess()
{
    if (m_process.state() == QProcess::NotRunning)
        return;
    thaw();
    kill();
}

bool ChildProcess::waitForLine(const QString& text)
{
    const QDeadlineTimer deadline(patience);
    while (!output().contains(text)) {
        if (deadline.hasExpired() || !isRunning())
            return false;
        m_process.waitForReadyRead(100);
    }
    return true;
}

void ChildProcess::say(const QString& line)
{
    m_process.write(line.toUtf8() + '\n');
    m_process.waitForBytesWritten(patience);
}

void ChildProcess::kill()
{
    m_process.kill();
    m_process.waitForFinished(patience);
}

void ChildProcess::freeze()
{
    const auto process = static_cast<pid_t>(m_process.processId());
    ::kill(process, SIGSTOP);
    // One thread takes the signal when it is next given a processor. Until then the others go on, for many milliseconds on a busy machine.
    siginfo_t stopped{};
    ::waitid(P_PID, static_cast<id_t>(process), &stopped, WSTOPPED | WEXITED | WNOWAIT);
}

void ChildProcess::thaw() { ::kill(static_cast<pid_t>(m_process.processId()), SIGCONT); }

int ChildProcess::terminate()
{
    m_process.terminate();
    return waitForEnd();
}

int ChildProcess::waitForEnd()
{
    if (m_process.state() != QProcess::NotRunning && !m_process.waitForFinished(patience))
        return -1;
    return m_process.exitStatus() == QProcess::NormalExit ? m_process.exitCode() : -1;
}

QString ChildProcess::output()
{
    m_output += QString::fromUtf8(m_process.readAll());
    return m_output;
}

} // namespace liena::test
