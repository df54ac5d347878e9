// Beats to the watchdog, and listens whether it answers.
#include "app/watchdog_process.hpp"

#include "watchdog/beat_watch.hpp"

#include <utility>

namespace console {

namespace {

constexpr std::chrono::seconds startAgain{5};
constexpr std::chrono::seconds answerTime{3};
constexpr qint64 unread = 256; ///< beats that a watchdog which hangs may leave behind
constexpr int goodbyeMs = 1000;

} // namespace

WatchdogProcess::WatchdogProcess(const QString& program, const QStringList& arguments, QObject* parent)
    : QObject(parent), m_program(program), m_arguments(arguments), m_process(this)
{
    m_process.setProcessChannelMode(QProcess::ForwardedErrorChannel);
    connect(&m_process, &QProcess::readyReadStandardOutput, this, [this] {
        const auto answers = m_process.readAllStandardOutput();
        m_answered = std::chrono::steady_clock::now();
        tell({});
        const bool silent = answers.endsWith(static_cast<char>(Answer::Silent));
        if (std::exchange(m_silent, silent) != silent)
            Q_EMIT silentChanged(silent);
    });
    connect(&m_process, &QProcess::errorOccurred, this, [this](QProcess::ProcessError error) {
        if (error == QProcess::FailedToStart)
            tell(tr("%1 was not started: %2").arg(m_program, m_process.errorString()));
    });
    connect(&m_process, &QProcess::finished, this, [this] { tell(tr("its watchdog has ended")); });
}

WatchdogProcess::~WatchdogProcess()
{
    disconnect(&m_process, nullptr, this, nullptr);
    if (m_process.state() == QProcess::NotRunning)
        return;
    m_process.putChar(static_cast<char>(Beat::Goodbye));
    m_process.closeWriteChannel();
    if (m_process.waitForFinished(goodbyeMs))
        return;
    m_process.kill();
    m_process.waitForFinished(goodbyeMs);
}

void WatchdogProcess::tell(const QString& trouble)
{
    if (m_told == trouble)
        return;
    m_told = trouble;
    Q_EMIT troubleChanged(trouble);
}

void WatchdogProcess::start(Instant now)
{
    if (m_started && now - *m_started < startAgain)
        return;
    m_started = now;
    m_answered.reset();
    m_process.start(m_program, m_arguments);
}

void WatchdogProcess::beat(bool attended, Instant now)
{
    if (m_process.state() == QProcess::NotRunning)
        start(now);
    if (m_process.state() == QProcess::NotRunning)
        return;
    if (m_process.bytesToWrite() < unread)
        m_process.putChar(static_cast<char>(attended ? Beat::Attended : Beat::Idle));
    if (now - m_answered.value_or(*m_started) > answerTime)
        tell(tr("its watchdog does not answer"));
}

} // namespace console
