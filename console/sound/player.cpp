// Only the newest order counts: what was held up by the sound server must not play a queue of old ones later.
#include "sound/player.hpp"

#include <QCoreApplication>

#include <algorithm>
#include <array>
#include <cerrno>

#include <unistd.h>

namespace console {

namespace {

/// To a console that is gone it may fail: the input's end then says so.
void answer(const PlayerAnswer& answer)
{
    const auto line = answer.line();
    (void)!::write(STDOUT_FILENO, line.constData(), static_cast<std::size_t>(line.size()));
}

} // namespace

Player::Player() : m_input(STDIN_FILENO, QSocketNotifier::Read)
{
    connect(&m_bursts, &BurstPlayer::troubleChanged, this, [](const SoundTrouble& trouble) {
        answer({PlayerAnswer::Kind::Trouble, trouble});
    });
    connect(&m_bursts, &BurstPlayer::sounded, this, [] { answer({PlayerAnswer::Kind::Sounded}); });
    connect(&m_input, &QSocketNotifier::activated, this, &Player::read);
}

void Player::open()
{
    m_bursts.open();
    answer({PlayerAnswer::Kind::Followed});
}

void Player::read()
{
    std::array<char, 64> orders{};
    const auto count = ::read(STDIN_FILENO, orders.data(), orders.size());
    if (count < 0 && (errno == EAGAIN || errno == EINTR))
        return;
    if (count <= 0) {
        m_input.setEnabled(false);
        return QCoreApplication::quit();
    }
    const auto end = orders.rend();
    const auto newest = std::find_if(end - count, end, [](char order) { return order != static_cast<char>(PlayerOrder::Answer); });
    if (newest != end)
        m_bursts.follow(wished(static_cast<PlayerOrder>(*newest)));
    for (ssize_t i = 0; i < count; ++i)
        answer({PlayerAnswer::Kind::Followed});
}

} // namespace console
