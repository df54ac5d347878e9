// A thread, and on it the player.
#include "sound/loudspeaker.hpp"

#include "sound/burst_player.hpp"

#include <QThread>

namespace console {

namespace {

constexpr unsigned long endMs = 500;
constexpr std::chrono::milliseconds lookEvery{500};

Instant present() { return std::chrono::steady_clock::now(); }

} // namespace

Loudspeaker::Loudspeaker(QObject* parent) : AlarmVoice(parent), m_thread(std::make_unique<QThread>()), m_player(new BurstPlayer)
{
    m_thread->setObjectName(QStringLiteral("alarm sound"));
    m_player->moveToThread(m_thread.get());
    connect(m_thread.get(), &QThread::finished, m_player, &QObject::deleteLater);
    connect(m_player, &BurstPlayer::troubleChanged, this, &Loudspeaker::noteTrouble);
    m_look.setInterval(lookEvery);
    connect(&m_look, &QTimer::timeout, this, &Loudspeaker::look);
}

Loudspeaker::~Loudspeaker()
{
    if (!m_thread->isRunning()) {
        delete m_player;
        return;
    }
    m_thread->quit();
    // A sound server that does not answer must not keep the program: its thread is then left to the end of the process.
    if (!m_thread->wait(endMs))
        (void)m_thread.release();
}

void Loudspeaker::start()
{
    m_thread->start();
    m_look.start();
    m_watch.ask(present());
    QMetaObject::invokeMethod(m_player, &BurstPlayer::open);
}

// Only the newest wish counts; a player that waits for its output must not play a queue of old ones later.
void Loudspeaker::play(AlarmPriority priority)
{
    m_player->setWish(priority);
    m_watch.ask(present());
    QMetaObject::invokeMethod(m_player, &BurstPlayer::followWish);
}

void Loudspeaker::silence()
{
    m_player->setWish(std::nullopt);
    m_watch.ask(present());
    QMetaObject::invokeMethod(m_player, &BurstPlayer::followWish);
}

void Loudspeaker::noteTrouble(const QString& trouble)
{
    m_trouble = trouble;
    if (!m_late)
        Q_EMIT troubleChanged(trouble);
}

/// A sound server that hangs says nothing of itself.
void Loudspeaker::look()
{
    const auto now = present();
    m_watch.noteAnswered(m_player->served(), now);
    if (m_watch.isLate(now) == m_late)
        return;
    m_late = !m_late;
    Q_EMIT troubleChanged(m_late ? tr("the sound output does not answer") : m_trouble);
}

} // namespace console
