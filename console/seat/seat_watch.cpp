// The listener's thread, and where it listens.
#include "seat/seat_watch.hpp"

#include "seat/seat_listener.hpp"

#include <QThread>

namespace console {

namespace {

constexpr unsigned long endMs = 500;

QString sessionBus(const QProcessEnvironment& environment)
{
    const auto variable = QStringLiteral("DBUS_SESSION_BUS_ADDRESS");
    if (environment.contains(variable))
        return environment.value(variable);
    const auto folder = environment.value(QStringLiteral("XDG_RUNTIME_DIR"));
    return folder.isEmpty() ? QString() : QStringLiteral("unix:path=%1/bus").arg(folder);
}

QString withoutStarting(const QString& address)
{
    const bool starts = address.contains(QLatin1String("autolaunch:")) || address.contains(QLatin1String("unixexec:"));
    return starts ? QString() : address;
}

} // namespace

SeatBuses seatBusesOf(const QString& platform, const QProcessEnvironment& environment)
{
    const bool x11 = platform == QLatin1String("xcb");
    if (!x11 && !platform.startsWith(QLatin1String("wayland")))
        return {};
    const auto system =
        environment.value(QStringLiteral("DBUS_SYSTEM_BUS_ADDRESS"), QStringLiteral("unix:path=/run/dbus/system_bus_socket"));
    return {withoutStarting(system), withoutStarting(sessionBus(environment)),
            x11 ? environment.value(QStringLiteral("DISPLAY")) : QString()};
}

SeatWatch::SeatWatch(const SeatBuses& buses, QObject* parent)
    : QObject(parent),
      m_thread(std::make_unique<QThread>()),
      m_listener(new SeatListener(buses)),
      m_asks(!buses.system.isEmpty() || !buses.session.isEmpty())
{
    m_thread->setObjectName(QStringLiteral("seat"));
    m_listener->moveToThread(m_thread.get());
    connect(m_thread.get(), &QThread::finished, m_listener, &QObject::deleteLater);
    connect(m_listener, &SeatListener::remarked, this, &SeatWatch::remarked);
    connect(m_listener, &SeatListener::told, this, [this](const QString& why) {
        if (why.isEmpty())
            Q_EMIT seen();
        else
            Q_EMIT notSeen(why);
    });
}

SeatWatch::~SeatWatch()
{
    if (!m_thread->isRunning()) {
        delete m_listener;
        return;
    }
    m_thread->quit();
    // A bus that does not answer must not keep the program: the thread is then left to the end of the process.
    if (!m_thread->wait(endMs))
        (void)m_thread.release();
}

void SeatWatch::start()
{
    if (!m_asks)
        return;
    m_thread->start();
    QMetaObject::invokeMethod(m_listener, &SeatListener::begin);
}

} // namespace console
