// The owner, asked of the bus and told by it.
#include "seat/bus_name.hpp"

#include "seat/bus_question.hpp"

#include <QDBusPendingReply>

namespace console {

BusName::BusName(const QDBusConnection& bus, const QString& name, QObject* parent)
    : QObject(parent), m_bus(bus), m_name(name), m_watcher(name, bus, QDBusServiceWatcher::WatchForOwnerChange)
{}

/// Qt 6.4 may crash when a connection closes just as whoever still hears by it is destroyed: he is taken off it before.
BusName::~BusName() { m_watcher.removeWatchedService(m_name); }

void BusName::begin()
{
    connect(&m_watcher, &QDBusServiceWatcher::serviceOwnerChanged, this, [this](const QString&, const QString&, const QString& owner) {
        m_changed = true;
        tell(owner);
    });
    auto question = QDBusMessage::createMethodCall(QStringLiteral("org.freedesktop.DBus"), QStringLiteral("/org/freedesktop/DBus"),
                                                   QStringLiteral("org.freedesktop.DBus"), QStringLiteral("GetNameOwner"));
    question << m_name;
    askOver(m_bus, question, this, [this](const QDBusPendingCall& call) {
        const QDBusPendingReply<QString> owner = call;
        if (!m_changed) // else it is known already, and newer
            tell(owner.isValid() ? owner.value() : QString());
    });
}

void BusName::tell(const QString& owner)
{
    if (owner.isEmpty())
        Q_EMIT vacant();
    else
        Q_EMIT taken(owner);
}

} // namespace console
