// What logind says of the session that this program belongs to: whether its screen is locked, and whether it is the one that shows.
#pragma once

#include "seat/bus_name.hpp"

#include <QDBusMessage>
#include <QVariantMap>

#include <cstdint>

namespace console {

/// Any thread, the one that made it. Silence, an error and an answer that makes no sense change nothing of what was said before.
///
/// A session counts only when it shows on a screen of this computer: it is a graphical one of a person, and it has a seat. `display`: the
/// X server that the window is on, as `:0`; empty: not known, or another platform. A session whose X server is another one does not count.
class LoginSession : public QObject {
    Q_OBJECT
public:
    enum class Standing : std::uint8_t {
        Awaited, ///< it has not answered yet
        Ours,
        Foreign, ///< no session that shows on a screen
        Unknown,
    };

    LoginSession(const QDBusConnection& bus, const QString& display, QObject* parent = nullptr);
    ~LoginSession() override;

    void begin();

    Standing standing() const { return m_standing; }
    const QString& why() const { return m_why; } ///< Foreign, Unknown
    bool locked() const { return m_standing == Standing::Ours && (m_locked || m_lockAsked); }
    bool away() const { return m_standing == Standing::Ours && m_away; } ///< another session is the one that shows

Q_SIGNALS:
    void changed();

public Q_SLOTS:
    /// Whatever lock the desktop was asked for is gone. One that it tells of itself stays.
    void unlock();

private Q_SLOTS:
    void ask();
    void lock();

private:
    void find(const QString& owner);
    void follow(const QString& path);
    void unfollow();
    void take(const QVariantMap& facts);
    void doubt(const QString& why);

    QDBusConnection m_bus;
    BusName m_name;
    QString m_display;
    QString m_owner; ///< logind's unique name
    QString m_path;  ///< the session's; empty: not known yet
    Standing m_standing = Standing::Awaited;
    QString m_why;
    bool m_locked = false;
    bool m_lockAsked = false; ///< of the desktop, which may lock and never tell
    bool m_away = false;
};

} // namespace console
