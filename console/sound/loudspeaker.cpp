// A thread, and on it the player.
#include "sound/loudspeaker.hpp"

#include "sound/burst_player.hpp"

#include <QThread>

namespace console {

namespace {

constexpr unsigned long endMs = 500;

} // namespace

Loudspeaker::Loudspeaker(QObject* parent) : AlarmVoice(parent), m_thread(std::make_unique<QThread>()), m_player(new BurstPlayer)
{
    m_thread->setObjectName(QStringLiteral("alarm sound"));
    m_player->moveToThread(m_thread.get());
    connect(m_thread.get(), &QThread::finished, m_player, &QObject::deleteLater);
    connect(m_player, &BurstPlayer::troubleChanged, this, &AlarmVoice::troubleChanged);
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
    QMetaObject::invokeMethod(m_player, &BurstPlayer::open);
}

// Only the newest wish counts; a player that waits for its output must not play a queue of old ones later.
void Loudspeaker::play(AlarmPriority priority)
{
    m_player->setWish(priority);
    QMetaObject::invokeMethod(m_player, &BurstPlayer::followWish);
}

void Loudspeaker::silence()
{
    m_player->setWish(std::nullopt);
    QMetaObject::invokeMethod(m_player, &BurstPlayer::followWish);
}

} // namespace console
