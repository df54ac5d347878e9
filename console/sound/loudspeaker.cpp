// A process, and a socket to it.
#include "sound/loudspeaker.hpp"

#include <QCoreApplication>

#include <array>
#include <cerrno>
#include <utility>

#include <sys/socket.h>
#include <unistd.h>

namespace console {

namespace {

constexpr std::chrono::milliseconds lookEvery{500};
constexpr std::chrono::seconds startAgain{5};
constexpr std::chrono::seconds replaceAfter{10};
constexpr int goodbyeMs = 1000;

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
    m_launched = m_well = now;
    m_trouble.reset();
    m_followed = 0;
    m_watch = {};
    std::array<int, 2> ends{-1, -1};
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
        return tell(tr("%1 was not started: %2").arg(m_program, qt_error_string(errno)));
    m_orders = ends.front();
    m_player.setChildProcessModifier([input = ends.back()] { ::dup2(input, STDIN_FILENO); });
    m_watch.ask(now); // to open the output
    m_player.start(m_program, {});
    ::close(ends.back());
    if (m_burst)
        order(*m_burst);
}

void Loudspeaker::hangUp()
{
    if (m_orders >= 0)
        ::close(std::exchange(m_orders, -1));
}

void Loudspeaker::play(AlarmPriority priority)
{
    m_burst = orderOf(priority);
    order(*m_burst);
}

void Loudspeaker::silence()
{
    m_burst.reset();
    order(PlayerOrder::Silence);
}

/// What a player that hangs does not take is kept by `m_burst` for the next one.
void Loudspeaker::order(PlayerOrder order)
{
    const auto word = static_cast<char>(order);
    if (m_orders >= 0 && ::send(m_orders, &word, 1, MSG_NOSIGNAL | MSG_DONTWAIT) == 1)
        m_watch.ask(present());
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
            m_burst.reset();
        break;
    case PlayerAnswer::Kind::Trouble:
        m_trouble = wordsFor(answer.trouble);
        tell(*m_trouble);
        break;
    }
}

/// A sound server that hangs says nothing of itself.
void Loudspeaker::look()
{
    const auto now = present();
    if (m_player.state() == QProcess::NotRunning) {
        if (now - m_launched >= startAgain)
            launch(now);
        return;
    }
    const bool late = m_watch.isLate(now);
    if (late)
        tell(tr("the sound output does not answer"));
    else if (m_trouble)
        tell(*m_trouble);
    if (!late && m_trouble && m_trouble->isEmpty())
        m_well = now;
    else if (now - m_well >= replaceAfter && !std::exchange(m_replaced, true))
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
