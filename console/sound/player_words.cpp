// A character in front says what a line is.
#include "sound/player_words.hpp"

namespace console {

namespace {

constexpr char between = '\t';

/// In one line, and without what stands between.
QByteArray plain(const QByteArray& text) { return text.simplified(); }

} // namespace

PlayerOrder orderOf(AlarmPriority priority)
{
    switch (priority) {
    case AlarmPriority::Low:
        return PlayerOrder::Low;
    case AlarmPriority::Medium:
        return PlayerOrder::Medium;
    case AlarmPriority::High:
        break;
    }
    return PlayerOrder::High;
}

std::optional<AlarmPriority> wished(PlayerOrder order)
{
    for (const auto priority : {AlarmPriority::Low, AlarmPriority::Medium, AlarmPriority::High})
        if (orderOf(priority) == order)
            return priority;
    return std::nullopt;
}

QByteArray PlayerAnswer::line() const
{
    QByteArray line(1, static_cast<char>(kind));
    if (kind == Kind::Trouble)
        line += plain(trouble.text) + between + plain(trouble.device);
    return line + '\n';
}

std::optional<PlayerAnswer> PlayerAnswer::of(const QByteArray& line)
{
    if (line.size() < 2 || !line.endsWith('\n'))
        return std::nullopt;
    const auto rest = line.mid(1).chopped(1);
    const auto kind = static_cast<Kind>(line.front());
    switch (kind) {
    case Kind::Followed:
    case Kind::Sounded:
        return rest.isEmpty() ? std::optional(PlayerAnswer{kind}) : std::nullopt;
    case Kind::Trouble:
        if (const auto at = rest.indexOf(between); at >= 0)
            return PlayerAnswer{kind, {rest.left(at), rest.mid(at + 1)}};
        break;
    }
    return std::nullopt;
}

} // namespace console
