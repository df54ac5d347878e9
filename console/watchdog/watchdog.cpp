// The watchdog's loop.
#include "watchdog/watchdog.hpp"

#include "model/alarm_burst.hpp"

#include <QCoreApplication>

#include <array>
#include <cerrno>
#include <cstdio>
#include <utility>

#include <fcntl.h>
#include <syslog.h>
#include <unistd.h>

namespace console {

namespace {

constexpr std::chrono::milliseconds period{25};

Instant presentTime() { return std::chrono::steady_clock::now(); }

} // namespace

Watchdog::Watchdog(std::chrono::seconds mourning, QObject* parent)
    : QObject(parent),
      m_watch(mourning),
      m_voice(QCoreApplication::applicationDirPath() + QStringLiteral("/liena-console-player")),
      m_input(STDIN_FILENO, QSocketNotifier::Read)
{
    ::fcntl(STDIN_FILENO, F_SETFL, ::fcntl(STDIN_FILENO, F_GETFL) | O_NONBLOCK);
    connect(&m_input, &QSocketNotifier::activated, this, &Watchdog::read);
    connect(&m_voice, &AlarmVoice::troubleChanged, this, [this](const QString& trouble) {
        m_silent = !trouble.isEmpty();
        if (m_silent)
            say("has no sound; it will only write");
    });
    m_timer.setTimerType(Qt::PreciseTimer);
    m_timer.setInterval(period);
    connect(&m_timer, &QTimer::timeout, this, &Watchdog::look);
    m_timer.start();
    m_voice.start();
    say("watches, process %lld", QCoreApplication::applicationPid());
}

void Watchdog::read()
{
    std::array<char, 64> bytes{};
    const auto count = ::read(STDIN_FILENO, bytes.data(), bytes.size());
    if (count < 0 && (errno == EAGAIN || errno == EINTR))
        return;
    const auto now = presentTime();
    if (count <= 0) {
        m_input.setEnabled(false);
        m_watch.noteEnd(now);
    }
    for (ssize_t i = 0; i < count; ++i)
        m_watch.take(bytes.at(static_cast<std::size_t>(i)), now);
    // A console that does not read them is not kept waiting for: what does not fit is lost.
    const auto answer = static_cast<char>(m_silent ? Answer::Silent : Answer::Watching);
    if (count > 0 && ::write(STDOUT_FILENO, &answer, 1) < 0 && errno == EPIPE)
        ::close(STDOUT_FILENO);
    look();
}

void Watchdog::look()
{
    const auto now = presentTime();
    const auto state = m_watch.look(now);
    const auto before = std::exchange(m_known, state);
    if (state == BeatWatch::State::Hung || state == BeatWatch::State::Died)
        sound(now);
    if (state == before)
        return;
    if (state == BeatWatch::State::Hung)
        say("ALARM: the console hangs while armed, in hold or in alarm, silent for %lld ms; motion stops, look at the robot",
            static_cast<qint64>(milliseconds(m_watch.silence(now))));
    else if (state == BeatWatch::State::Died)
        say("ALARM: the console has ended while armed, in hold or in alarm; motion stops, look at the robot");
    else if (state == BeatWatch::State::Watching) {
        say("the console beats again");
        m_voice.silence();
        m_lastBurst.reset();
    } else {
        say("ends with the console");
        QCoreApplication::quit();
    }
}

void Watchdog::sound(Instant now)
{
    if (m_lastBurst && now - *m_lastBurst < *burstRepeat(AlarmPriority::High))
        return;
    m_lastBurst = now;
    m_voice.play(AlarmPriority::High);
}

void Watchdog::say(const char* text, qint64 number)
{
    std::array<char, 200> line{};
    std::snprintf(line.data(), line.size(), text, static_cast<long long>(number));
    std::fprintf(stderr, "liena-console-watchdog: %s\n", line.data());
    ::syslog(LOG_USER | LOG_WARNING, "%s", line.data());
}

} // namespace console
