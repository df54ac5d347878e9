// The watchdog's loop: beats in, alarm out.
#pragma once

#include "sound/loudspeaker.hpp"
#include "watchdog/beat_watch.hpp"

#include <QObject>
#include <QSocketNotifier>
#include <QTimer>

#include <optional>

namespace console {

/// Reads standard input, which it makes non-blocking; each reading is answered with one character on standard output, so that the console
/// knows that it is watched, and whether an alarm would be heard.
class Watchdog : public QObject {
    Q_OBJECT
public:
    explicit Watchdog(std::chrono::seconds mourning, QObject* parent = nullptr);

private:
    void read();
    void look();
    void sound(Instant now);
    void say(const char* text, qint64 number = 0);

    BeatWatch m_watch;
    BeatWatch::State m_known = BeatWatch::State::Watching;
    Loudspeaker m_voice;
    bool m_silent = false; ///< nothing would be heard
    QSocketNotifier m_input;
    QTimer m_timer;
    std::optional<Instant> m_lastBurst;
};

} // namespace console
