// What the console's network thread asks of its surroundings.
#pragma once

#include <QList>

namespace console {

/// As liena::RealTimeOptions and liena::PacketMarks; SystemLink::create() refuses what is not permitted.
struct NetworkSettings {
    int realTimePriority = 0; ///< SCHED_FIFO; 0: an ordinary thread
    QList<int> processors;    ///< that it may run on; empty: all
    bool lockMemory = false;
    int cardPollUs = 0;
    int busyPollUs = 0;
    int commandMark = 46; ///< DSCP; 0: none
    int imageMark = 34;
};

} // namespace console
