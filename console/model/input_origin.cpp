// Sessions that say that they are remote.
#include "model/input_origin.hpp"

namespace console {

namespace {

struct Mark {
    const char* variable; ///< that a remote desktop sets in the sessions it makes
    const char* name;
};

constexpr Mark marks[] = {
    {"XRDP_SESSION", "XRDP"},
    {"X2GO_SESSION", "X2Go"},
    {"VNCDESKTOP", "VNC"},
    {"CHROME_REMOTE_DESKTOP_SESSION", "Chrome Remote Desktop"},
};

/// `localhost:10.0`, `host:0` and `tcp/host:0` are reached over a network; `:0`, `unix:0`, `unix/host:0` and the path of a socket are this
/// computer's.
bool overNetwork(const QString& display)
{
    const auto host = display.left(display.lastIndexOf(QLatin1Char(':')));
    const bool here =
        host.isEmpty() || host == QLatin1String("unix") || host.startsWith(QLatin1Char('/')) || host.startsWith(QLatin1String("unix/"));
    return display.contains(QLatin1Char(':')) && !here;
}

} // namespace

QString remoteInputOf(const QString& platform, const QProcessEnvironment& environment)
{
    if (platform == QLatin1String("vnc"))
        return QStringLiteral("VNC");
    const bool withScreen = platform == QLatin1String("xcb") || platform.startsWith(QLatin1String("wayland"));
    if (!withScreen)
        return {};
    for (const Mark& mark : marks)
        if (!environment.value(QString::fromLatin1(mark.variable)).isEmpty())
            return QString::fromLatin1(mark.name);
    if (platform != QLatin1String("xcb"))
        return {};
    const auto display = environment.value(QStringLiteral("DISPLAY"));
    if (!overNetwork(display))
        return {};
    return environment.contains(QStringLiteral("SSH_CONNECTION")) ? QStringLiteral("SSH") : display;
}

} // namespace console
