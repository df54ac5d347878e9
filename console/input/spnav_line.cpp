// Opening beside the GUI thread, and reading without ever waiting.
#include "input/spnav_line.hpp"

#include <QFile>
#include <QPromise>
#include <QSocketNotifier>
#include <QStringList>

#include <spnav.h>

#include <sys/select.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <mutex>
#include <thread>
#include <unistd.h>
#include <utility>

namespace console {

/// Outlives the line when the library hangs while that is destroyed: whoever comes second closes the connection.
struct SpnavLine::Attempt {
    QPromise<Opened> promise;
    std::mutex mutex;
    bool abandoned = false;
    bool delivered = false;
    bool open = false;
};

namespace {

constexpr std::size_t eventSize = 32; ///< eight integers; the daemon writes them at once

std::mutex& libraryLock()
{
    static std::mutex lock;
    return lock;
}

/// The library looks at descriptors through select(), which ends the program for one that is too large.
bool descriptorsAreSmall()
{
    const int next = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
    if (next >= 0)
        ::close(next);
    constexpr int spare = 8; // others may open some in between
    return next >= 0 && next + spare < FD_SETSIZE;
}

/// Where the library looks for the daemon, in its order.
QStringList daemonSockets()
{
    QStringList paths;
    if (qEnvironmentVariableIsSet("SPNAV_SOCKET"))
        paths << qEnvironmentVariable("SPNAV_SOCKET");
    QFile settings(QStringLiteral("/etc/spnavrc"));
    constexpr qint64 longest = 65536;
    if (settings.open(QIODevice::ReadOnly))
        for (const auto& line : QString::fromLocal8Bit(settings.read(longest)).split(QLatin1Char('\n')))
            if (line.trimmed().startsWith(QLatin1String("socket")) && line.contains(QLatin1Char('=')))
                paths << line.section(QLatin1Char('='), 1).trimmed();
    return paths << QStringLiteral("/var/run/spnav.sock");
}

bool answers(const QString& path)
{
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    const auto name = QFile::encodeName(path);
    if (name.isEmpty() || name.size() >= qsizetype(sizeof address.sun_path))
        return false;
    std::memcpy(address.sun_path, name.constData(), std::size_t(name.size()));
    const int probe = ::socket(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    const bool there = probe >= 0 && ::connect(probe, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
    if (probe >= 0)
        ::close(probe);
    return there;
}

/// The library keeps a little memory for ever at each try that fails: it is asked only when somebody answers.
bool daemonAnswers()
{
    const auto paths = daemonSockets();
    return std::any_of(paths.begin(), paths.end(), answers);
}

/// The library writes without asking whether the other end is there.
void ignoreBrokenPipes()
{
    sigset_t set;
    sigemptyset(&set);
    sigaddset(&set, SIGPIPE);
    pthread_sigmask(SIG_BLOCK, &set, nullptr);
}

} // namespace

SpnavLine::SpnavLine(QObject* parent) : QObject(parent)
{
    m_retry.setInterval(retry);
    m_soon.setInterval(soon);
    m_soon.setSingleShot(true);
    for (auto* timer : {&m_retry, &m_soon})
        connect(timer, &QTimer::timeout, this, &SpnavLine::attempt);
    connect(&m_opening, &QFutureWatcher<Opened>::finished, this, &SpnavLine::finishAttempt);
}

SpnavLine::~SpnavLine()
{
    if (m_attempt) {
        const std::lock_guard guard(m_attempt->mutex);
        m_attempt->abandoned = true;
        m_open = m_attempt->delivered && m_attempt->open;
    }
    m_notifier.reset();
    if (m_open)
        spnav_close();
}

void SpnavLine::start()
{
    m_retry.start();
    attempt();
}

/// On the thread that opens. An older daemon does not say when a mouse is unplugged: its last button would count as held for ever.
SpnavLine::Opened SpnavLine::openNow()
{
    if (!descriptorsAreSmall() || !daemonAnswers() || spnav_open() == -1)
        return Opened::NoDaemon;
    if (spnav_protocol() < 1)
        return Opened::TooOld;
    // Without the bit for its settings the daemon tells a change of them as a deflection of zero.
    spnav_evmask(SPNAV_EVMASK_INPUT | SPNAV_EVMASK_DEV | SPNAV_EVMASK_CFG);
    return spnav_dev_type() == -1 ? Opened::NoMouse : Opened::Mouse;
}

void SpnavLine::attempt()
{
    if (m_mouse || m_attempt)
        return;
    close(); // what a daemon without a mouse told while the line opened, that one was plugged in, may be lost: it is asked again
    m_attempt = std::make_shared<Attempt>();
    m_opening.setFuture(m_attempt->promise.future());
    std::thread([attempt = m_attempt] {
        ignoreBrokenPipes();
        const std::lock_guard oneAtATime(libraryLock());
        attempt->promise.start();
        const auto opened = openNow();
        const std::lock_guard guard(attempt->mutex);
        attempt->open = opened != Opened::NoDaemon;
        if (attempt->abandoned && attempt->open)
            spnav_close();
        attempt->delivered = true;
        attempt->promise.addResult(opened);
        attempt->promise.finish();
    }).detach();
}

void SpnavLine::finishAttempt()
{
    m_attempt.reset();
    const auto opened = m_opening.result();
    m_open = opened != Opened::NoDaemon;
    m_trouble = opened == Opened::TooOld ? tr("spacenavd is too old: it does not say when the mouse is unplugged; install 1.0 or newer")
                                         : QString();
    if (opened == Opened::TooOld)
        return close();
    if (m_open)
        listen();
    m_mouse = opened == Opened::Mouse;
    if (m_mouse)
        Q_EMIT came();
}

void SpnavLine::listen()
{
    m_notifier = std::make_unique<QSocketNotifier>(spnav_fd(), QSocketNotifier::Read);
    connect(m_notifier.get(), &QSocketNotifier::activated, this, &SpnavLine::take);
}

void SpnavLine::take()
{
    for (int i = 0; i < mostAtOnce && m_open; ++i)
        if (!takeOne())
            return;
}

/// The library neither tells the end of the connection nor waits for the rest of an event: both are looked at first.
bool SpnavLine::takeOne()
{
    std::array<char, eventSize> ahead{};
    const auto waiting = ::recv(spnav_fd(), ahead.data(), ahead.size(), MSG_PEEK | MSG_DONTWAIT);
    if (waiting < 0 && (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR))
        return false;
    spnav_event event{};
    if (waiting != static_cast<ssize_t>(eventSize)) {
        close();
        return false;
    }
    const int kind = spnav_poll_event(&event);
    const bool hand = kind == SPNAV_EVENT_MOTION || kind == SPNAV_EVENT_BUTTON;
    // Another set of mice, or one that was not known of: begun anew, and to be seen let go.
    if (kind == SPNAV_EVENT_DEV || (hand && !m_mouse)) {
        close();
        m_soon.start();
        return false;
    }
    if (kind == SPNAV_EVENT_MOTION)
        Q_EMIT deflected({event.motion.x, event.motion.y, event.motion.z, event.motion.rx, event.motion.ry, event.motion.rz});
    else if (kind == SPNAV_EVENT_BUTTON)
        Q_EMIT buttonChanged(event.button.bnum, event.button.press != 0);
    return true;
}

void SpnavLine::close()
{
    if (m_notifier) {
        m_notifier->setEnabled(false);
        m_notifier.release()->deleteLater(); // it may be the one that called
    }
    if (m_open)
        spnav_close();
    m_open = false;
    if (std::exchange(m_mouse, false))
        Q_EMIT went();
}

} // namespace console
