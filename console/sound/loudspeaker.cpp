// A thread, and on it the player.
#include "sound/loudspeaker.hpp"

#include "sound/burst_player.hpp"

namespace console {

Loudspeaker::Loudspeaker(QObject* parent) : AlarmVoice(parent), m_player(new BurstPlayer)
{
    m_thread.setObjectName(QStringLiteral("alarm sound"));
    m_player->moveToThread(&m_thread);
    connect(&m_thread, &QThread::finished, m_player, &QObject::deleteLater);
    connect(m_player, &BurstPlayer::troubleChanged, this, &AlarmVoice::troubleChanged);
}

Loudspeaker::~Loudspeaker()
{
    if (!m_thread.isRunning()) {
        delete m_player;
        return;
    }
    m_thread.quit();
    m_thread.wait();
}

void Loudspeaker::start()
{
    m_thread.start();
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
