// liena-console-watchdog: sounds the high alarm when the console that started it hangs or dies while somebody relies
// on its alarms.
#include "watchdog/watchdog.hpp"

#include <QCommandLineParser>
#include <QCoreApplication>

#include <csignal>
#include <cstdio>

namespace {

const char* const description =
    R"(Started by liena-console, which beats to it over its standard input. When the console is armed, waits for the robot
to arm, is in hold or has a high alarm that nobody acknowledged, and then does not beat for 250 ms or ends without a
goodbye, this program sounds the high alarm and writes why to standard error and the system's log. It ends with the
console; such a console's death it sounds for a minute first. Not for use by hand.)";

} // namespace

int main(int argc, char** argv)
{
    // Ctrl-C in the terminal ends the console; this program must live to say so. Its own end is that of the pipe.
    for (const int ignored : {SIGINT, SIGHUP, SIGPIPE})
        std::signal(ignored, SIG_IGN);
    QCoreApplication application(argc, argv);
    QCoreApplication::setApplicationName(QStringLiteral("liena-console-watchdog"));
    QCoreApplication::setApplicationVersion(QStringLiteral(LIENA_VERSION));
    QCommandLineParser parser;
    parser.setApplicationDescription(QString::fromUtf8(description));
    const QCommandLineOption mourning(QStringLiteral("mourning"),
                                      QStringLiteral("How long the death of a console that was armed, in hold or in alarm is sounded."),
                                      QStringLiteral("SECONDS"), QStringLiteral("60"));
    parser.addOption(mourning);
    parser.addHelpOption();
    parser.addVersionOption();
    parser.process(application);
    bool good = false;
    const int time = parser.value(mourning).toInt(&good);
    if (!good || time < 0 || time > 3600) {
        std::fprintf(stderr, "liena-console-watchdog: --mourning '%s': give 0 to 3600 seconds\n", qUtf8Printable(parser.value(mourning)));
        return 2;
    }
    const console::Watchdog watchdog{std::chrono::seconds(time)};
    return QCoreApplication::exec();
}
