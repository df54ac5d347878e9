// Two buses, and one word of them.
#include "seat/seat_listener.hpp"

#include <algorithm>
#include <utility>

namespace console {

namespace {

// What D-Bus itself says in the program when a connection is lost.
QString localPath() { return QStringLiteral("/org/freedesktop/DBus/Local"); }
QString local() { return QStringLiteral("org.freedesktop.DBus.Local"); }
QString disconnected() { return QStringLiteral("Disconnected"); }

} // namespace

SeatListener::SeatListener(SeatBuses buses) : m_buses(std::move(buses)) {}

SeatListener::~SeatListener()
{
    m_savers.clear();
    m_login.reset();
    for (const auto& line : m_lines) {
        QDBusConnection(line.name).disconnect(QString(), localPath(), local(), disconnected(), this, line.slot); // as BusName
        QDBusConnection::disconnectFromBus(line.name);
    }
}

void SeatListener::begin()
{
    const auto bus = open(m_buses.system, SLOT(endSystem()));
    if (!bus) {
        remark(tr("there is no system bus"));
        return beginSavers();
    }
    m_login = std::make_unique<LoginSession>(*bus, m_buses.display);
    connect(m_login.get(), &LoginSession::changed, this, &SeatListener::look);
    m_login->begin();
}

/// A connection of its own, so that nobody else's is closed. `slot` is told when it ends; QDBusConnection takes no other than named ones.
std::optional<QDBusConnection> SeatListener::open(const QString& address, const char* slot)
{
    if (address.isEmpty())
        return std::nullopt;
    m_lines.push_back({QStringLiteral("liena-seat-%1-%2").arg(quintptr(this), 0, 16).arg(m_lines.size()), slot});
    auto bus = QDBusConnection::connectToBus(address, m_lines.back().name);
    if (!bus.isConnected())
        return std::nullopt;
    bus.connect(QString(), localPath(), local(), disconnected(), this, slot);
    return bus;
}

/// In a session without a screen a person's bus may be that of another one, which has.
void SeatListener::look()
{
    using Standing = LoginSession::Standing;
    const auto standing = m_login->standing();
    if (standing == Standing::Foreign || standing == Standing::Unknown)
        remark(m_login->why());
    if (standing == Standing::Ours || standing == Standing::Unknown)
        beginSavers();
    tell();
}

void SeatListener::beginSavers()
{
    if (std::exchange(m_saversBegun, true))
        return;
    const auto bus = open(m_buses.session, SLOT(endSession()));
    if (!bus)
        return;
    for (const auto& name : ScreenSaver::names()) {
        auto& saver = m_savers.emplace_back(std::make_unique<ScreenSaver>(*bus, name));
        connect(saver.get(), &ScreenSaver::changed, this, [this, saver = saver.get()] {
            if (!saver->on() && m_login)
                m_login->unlock(); // what it locked when it was asked to
            tell();
        });
        saver->begin();
    }
}

void SeatListener::remark(const QString& why)
{
    if (!std::exchange(m_remarked, true))
        Q_EMIT remarked(tr("logind does not tell whether somebody sees this screen: %1").arg(why));
}

void SeatListener::endSystem()
{
    m_systemEnded = true;
    remark(tr("its bus has ended"));
    tell();
}

void SeatListener::endSession()
{
    m_sessionEnded = true;
    tell();
}

QString SeatListener::reason() const
{
    const bool locked = m_login && m_login->locked();
    const bool away = m_login && m_login->away();
    const bool saver = std::any_of(m_savers.begin(), m_savers.end(), [](const auto& one) { return one->on(); });
    if (locked && !m_systemEnded)
        return tr("Screen is locked");
    if (away && !m_systemEnded)
        return tr("Another session is on this screen");
    if (saver && !m_sessionEnded)
        return tr("Screen saver is on");
    return locked || away || saver ? tr("Screen was hidden, no word since: restart the console") : QString();
}

void SeatListener::tell()
{
    if (const auto why = reason(); why != std::exchange(m_told, why))
        Q_EMIT told(why);
}

} // namespace console
