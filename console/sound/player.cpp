// Only the newest order counts: what was held up by the sound server must not play a queue of old ones later.
#include "sound/player.hpp"

#include <QCoreApplication>

#include <array>
#include <cerrno>

#include <unistd.h>

namespace console {

namespace {

constexpr unsigned farewellSeconds = 2;

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
        ::alarm(farewellSeconds); // whatever the sound server does
        return QCoreApplication::quit();
    }
    m_bursts.follow(wished(static_cast<PlayerOrder>(orders.at(static_cast<std::size_t>(count) - 1))));
    for (ssize_t i = 0; i < count; ++i)
        answer({PlayerAnswer::Kind::Followed});
}

} // namespace console
