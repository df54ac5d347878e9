// A process, and a socket to it.
#include "sound/loudspeaker.hpp"

#include <QCoreApplication>

#include <array>
#include <cerrno>
#include <csignal>
#include <utility>

#include <sys/prctl.h>
#include <sys/socket.h>
#include <unistd.h>

namespace console {

namespace {

constexpr std::chrono::milliseconds lookEvery{500};
constexpr std::chrono::seconds startAgain{5};
constexpr std::chrono::seconds askEvery{2};
constexpr int goodbyeMs = 500;

Instant present() { return std::chrono::steady_clock::now(); }

QString wordsFor(const SoundTrouble& trouble)
{
    const auto text = QCoreApplication::translate("console::BurstPlayer", trouble.text.constData());
    return trouble.device.isEmpty() ? text : text.arg(QString::fromUtf8(trouble.device));
}

} // namespace

Loudspeaker::Loudspeaker(const QString& program, QObject* parent) : AlarmVoice(parent), m_program(program), m_player(this), m_look(this)
{
    m_player.setProcessChannelMode(QProcess::ForwardedErrorChannel);
    m_player.setInputChannelMode(QProcess::ForwardedInputChannel);
    connect(&m_player, &QProcess::readyReadStandardOutput, this, &Loudspeaker::read);
    connect(&m_player, &QProcess::errorOccurred, this, [this](QProcess::ProcessError error) {
        if (error == QProcess::FailedToStart)
            tell(tr("%1 was not started: %2").arg(m_program, m_player.errorString()));
    });
    connect(&m_player, &QProcess::finished, this, [this] {
        if (m_replaced)
            launch(present());
        else
            tell(tr("its sound player has ended"));
    });
    m_look.setInterval(lookEvery);
    connect(&m_look, &QTimer::timeout, this, &Loudspeaker::look);
}

Loudspeaker::~Loudspeaker()
{
    disconnect(&m_player, nullptr, this, nullptr);
    hangUp();
    if (m_player.state() == QProcess::NotRunning || m_player.waitForFinished(goodbyeMs))
        return;
    m_player.kill();
    m_player.waitForFinished(goodbyeMs);
}

void Loudspeaker::start()
{
    m_look.start();
    launch(present());
}

/// Orders do not go by QProcess, which writes only in the event loop: an alarm is not to wait for what is painted before.
void Loudspeaker::launch(Instant now)
{
    if (m_program.isEmpty())
        return tell(tr("no sound player was named"));
    hangUp();
    m_replaced = false;
    m_launched = m_looked = now;
    m_plan.noteStarted(now);
    m_trouble.reset();
    m_followed = 0;
    m_watch = {};
    std::array<int, 2> ends{-1, -1};
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
        return tell(tr("%1 was not started: %2").arg(m_program, qt_error_string(errno)));
    m_orders = ends.front();
    m_player.setChildProcessModifier([input = ends.back()] {
        ::dup2(input, STDIN_FILENO);
        ::prctl(PR_SET_PDEATHSIG, SIGKILL); // one that hangs does not hear that its input ends
    });
    m_watch.ask(now); // to open the output
    m_player.start(m_program, {});
    ::close(ends.back());
    if (const auto burst = m_burst.at(now))
        order(*burst);
}

void Loudspeaker::hangUp()
{
    if (m_orders >= 0)
        ::close(std::exchange(m_orders, -1));
}

void Loudspeaker::play(AlarmPriority priority)
{
    const auto burst = orderOf(priority);
    m_burst.keep(burst, present());
    order(burst);
}

void Loudspeaker::silence()
{
    m_burst.forget();
    order(PlayerOrder::Silence);
}

/// What a player that hangs does not take is kept by `m_burst` for the next one.
void Loudspeaker::order(PlayerOrder order)
{
    const auto word = static_cast<char>(order);
    m_asked = present();
    if (m_orders >= 0 && ::send(m_orders, &word, 1, MSG_NOSIGNAL | MSG_DONTWAIT) == 1)
        m_watch.ask(m_asked);
}

void Loudspeaker::read()
{
    while (m_player.canReadLine())
        if (const auto answer = PlayerAnswer::of(m_player.readLine()))
            take(*answer);
}

void Loudspeaker::take(const PlayerAnswer& answer)
{
    switch (answer.kind) {
    case PlayerAnswer::Kind::Followed:
        m_watch.noteAnswered(++m_followed, present());
        break;
    case PlayerAnswer::Kind::Sounded:
        if (!m_watch.isWaiting()) // else it is an older one that has sounded
            m_burst.forget();
        break;
    case PlayerAnswer::Kind::Trouble:
        m_trouble = wordsFor(answer.trouble);
        tell(*m_trouble);
        break;
    }
}

/// A player that hangs, since the sound server does, says nothing of itself.
void Loudspeaker::look()
{
    const auto now = present();
    if (m_burst.isTooOld(now))
        silence();
    // When this program itself stood still, the answers are read first.
    if (now - std::exchange(m_looked, now) > 2 * lookEvery)
        return;
    if (m_player.state() == QProcess::NotRunning) {
        if (now - m_launched >= startAgain)
            launch(now);
        return;
    }
    if (m_watch.isLate(now))
        tell(tr("the sound output does not answer"));
    else if (m_trouble)
        tell(*m_trouble);
    if (m_watch.isWaiting() || !m_trouble || !m_trouble->isEmpty())
        return replace(now);
    m_plan.noteWell(now);
    if (now - m_asked >= askEvery)
        order(PlayerOrder::Answer);
}

/// When its time is over; the end of the process starts the next one.
void Loudspeaker::replace(Instant now)
{
    if (!m_plan.isDue(now))
        return;
    m_replaced = true;
    m_player.kill();
}

void Loudspeaker::tell(const QString& trouble)
{
    if (m_told == trouble)
        return;
    m_told = trouble;
    Q_EMIT troubleChanged(trouble);
}

} // namespace console
