// The player's loop: orders in, bursts and answers out.
#pragma once

#include "sound/burst_player.hpp"

#include <QObject>
#include <QSocketNotifier>

namespace console {

/// Reads standard input and answers on standard output; quits the program when the input ends.
class Player : public QObject {
    Q_OBJECT
public:
    Player();

    void open(); ///< may take as long as the sound server likes

private:
    void read();

    BurstPlayer m_bursts;
    QSocketNotifier m_input;
};

} // namespace console
