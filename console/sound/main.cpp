// liena-console-player: plays the bursts of liena-console and of its watchdog.
#include "sound/player.hpp"

#include <QCommandLineParser>
#include <QCoreApplication>

#include <csignal>
#include <cstdio>

namespace {

const char* const description =
    R"(Started by liena-console, and by its watchdog, each for itself: plays the alarm bursts that are ordered over its standard
input, one character each (l, m, h: low, medium, high; s: silence), on the default sound output, and answers on its
standard output. A sound server that hangs or that takes its library with it holds up this program only, and whoever
started it starts another. Ends with its input. Not for use by hand.)";

/// What Qt's sound has to say would come with each of the programs that follow each other; the trouble is told in the answers.
void sayWhatIsFatal(QtMsgType type, const QMessageLogContext& /*where*/, const QString& text)
{
    if (type == QtFatalMsg)
        std::fprintf(stderr, "liena-console-player: %s\n", qUtf8Printable(text));
}

} // namespace

int main(int argc, char** argv)
{
    // Ctrl-C in the terminal ends the console, which an alarm may outlive. This program's end is that of its input.
    for (const int ignored : {SIGINT, SIGHUP, SIGPIPE})
        std::signal(ignored, SIG_IGN);
    qInstallMessageHandler(sayWhatIsFatal);
    QCoreApplication application(argc, argv);
    QCoreApplication::setApplicationName(QStringLiteral("liena-console-player"));
    QCoreApplication::setApplicationVersion(QStringLiteral(LIENA_VERSION));
    QCommandLineParser parser;
    parser.setApplicationDescription(QString::fromUtf8(description));
    parser.addHelpOption();
    parser.addVersionOption();
    parser.process(application);
    console::Player player;
    player.open();
    return QCoreApplication::exec();
}
