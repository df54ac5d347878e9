// Stands for the console beside the real watchdog: beats to it as the console does, and can be stopped and killed.
#include "app/watchdog_process.hpp"

#include <QCoreApplication>
#include <QSocketNotifier>
#include <QTimer>

#include <chrono>
#include <cstdio>

#include <unistd.h>

/// Arguments: the watchdog, "armed" or "idle", seconds of mourning. Ends in order when its standard input ends.
int main(int argc, char** argv)
{
    QCoreApplication application(argc, argv);
    const auto arguments = QCoreApplication::arguments();
    console::WatchdogProcess watchdog(arguments.at(1), {QStringLiteral("--mourning"), arguments.at(3)});
    const bool armed = arguments.at(2) == QLatin1String("armed");
    QObject::connect(&watchdog, &console::WatchdogProcess::troubleChanged, &application, [](const QString& trouble) {
        std::fprintf(stderr, "rider: %s\n", trouble.isEmpty() ? "is watched" : qUtf8Printable(trouble));
    });
    QTimer beats;
    beats.setInterval(50);
    QObject::connect(&beats, &QTimer::timeout, &application, [&] { watchdog.beat(armed, std::chrono::steady_clock::now()); });
    beats.start();
    QSocketNotifier input(STDIN_FILENO, QSocketNotifier::Read);
    QObject::connect(&input, &QSocketNotifier::activated, &application, &QCoreApplication::quit);
    return QCoreApplication::exec();
}
