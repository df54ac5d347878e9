// What a console and its player say to each other.
#pragma once

#include "model/alarm_list.hpp"

#include <QByteArray>

#include <optional>

namespace console {

/// To the player's standard input, one character each. Only the newest counts, but for `Answer`, which asks for no more than that; others
/// than these are taken for `Silence`.
enum class PlayerOrder : char { Low = 'l', Medium = 'm', High = 'h', Silence = 's', Answer = '?' };

PlayerOrder orderOf(AlarmPriority priority);
std::optional<AlarmPriority> wished(PlayerOrder order); ///< nothing: silence

/// Why nothing would be heard.
struct SoundTrouble {
    QByteArray text;   ///< in English, of the catalogue's context console::BurstPlayer; empty: none
    QByteArray device; ///< for its %1, where it has one; UTF-8

    bool operator==(const SoundTrouble&) const = default;
};

/// From the player's standard output, one line each.
struct PlayerAnswer {
    enum class Kind : char {
        Followed = '.', ///< one more order, the first of which is to open the output, without a word from the console
        Sounded = '~',  ///< the newest burst was heard to its end, as far as the player can know
        Trouble = '!',  ///< it is another than before
    };

    Kind kind = Kind::Followed;
    SoundTrouble trouble{};

    QByteArray line() const; ///< with its end
    static std::optional<PlayerAnswer> of(const QByteArray& line);
};

} // namespace console
