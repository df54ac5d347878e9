// A logind with one session, and screen savers, that say on a bus what a test tells them.
#pragma once

#include <QDBusArgument>
#include <QDBusConnection>
#include <QDBusMessage>
#include <QDBusObjectPath>
#include <QDBusVirtualObject>
#include <QString>
#include <QVariantMap>

#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace console::test {

/// Somebody on a bus, with a name or without. Answers in the event loop of the thread that made it.
class BusMember : public QDBusVirtualObject {
public:
    explicit BusMember(const QString& address)
        : m_id(QStringLiteral("fake-%1").arg(quintptr(this), 0, 16)), m_bus(QDBusConnection::connectToBus(address, m_id))
    {
        m_bus.registerVirtualObject(QStringLiteral("/"), this, QDBusConnection::SubPath);
    }

    /// In this order: Qt 6.4 may crash when a connection closes just as an object on it is destroyed.
    ~BusMember() override
    {
        m_bus.unregisterObject(QStringLiteral("/"), QDBusConnection::UnregisterTree);
        QDBusConnection::disconnectFromBus(m_id);
    }
    Q_DISABLE_COPY_MOVE(BusMember)

    bool takeName(const QString& name) { return m_bus.registerService(name); }
    bool giveName(const QString& name) { return m_bus.unregisterService(name); }

    void emitSignal(const QString& path, const QString& interface, const QString& name, const QVariantList& arguments = {})
    {
        auto signal = QDBusMessage::createSignal(path, interface, name);
        signal.setArguments(arguments);
        m_bus.send(signal);
    }

    /// To a call.
    std::function<QDBusMessage(const QDBusMessage&)> answer;

    int asked = 0; ///< calls

    QString introspect(const QString&) const override { return {}; }

    bool handleMessage(const QDBusMessage& message, const QDBusConnection& connection) override
    {
        ++asked;
        connection.send(answer ? answer(message) : message.createErrorReply(QDBusError::UnknownMethod, QStringLiteral("unknown")));
        return true;
    }

private:
    QString m_id;
    QDBusConnection m_bus;
};

inline QVariant seatNamed(const QString& name)
{
    QDBusArgument seat;
    seat.beginStructure();
    seat << name << QDBusObjectPath(name.isEmpty() ? QStringLiteral("/") : QStringLiteral("/org/freedesktop/login1/seat/") + name);
    seat.endStructure();
    return QVariant::fromValue(seat);
}

/// What logind tells of a person's session on X11's `:0`, which shows and is not locked.
inline QVariantMap inSight()
{
    return {{QStringLiteral("Id"), QStringLiteral("7")},
            {QStringLiteral("Type"), QStringLiteral("x11")},
            {QStringLiteral("Class"), QStringLiteral("user")},
            {QStringLiteral("Seat"), seatNamed(QStringLiteral("seat0"))},
            {QStringLiteral("Display"), QStringLiteral(":0")},
            {QStringLiteral("Active"), true},
            {QStringLiteral("LockedHint"), false}};
}

class FakeLogind {
public:
    explicit FakeLogind(const QString& address) : m_member(std::make_unique<BusMember>(address))
    {
        m_member->answer = [this](const QDBusMessage& call) { return reply(call); };
        m_member->takeName(service());
    }

    QVariantMap facts = inSight();
    QVariant session = QVariant::fromValue(QDBusObjectPath(path())); ///< what GetSession answers; invalid: that there is none
    std::optional<QVariantList> answered;                            ///< to GetAll, in place of the facts
    int asked() const { return m_member->asked; }

    /// And says that it did.
    void set(const char* fact, const QVariant& value)
    {
        const auto name = QString::fromLatin1(fact);
        facts.insert(name, value);
        m_member->emitSignal(path(), QStringLiteral("org.freedesktop.DBus.Properties"), QStringLiteral("PropertiesChanged"),
                             {sessionInterface(), QVariantMap{{name, value}}, QStringList()});
    }

    void askToLock() { m_member->emitSignal(path(), sessionInterface(), QStringLiteral("Lock")); }
    void askToUnlock() { m_member->emitSignal(path(), sessionInterface(), QStringLiteral("Unlock")); }

    static QString path() { return QStringLiteral("/org/freedesktop/login1/session/_37"); }
    static QString sessionInterface() { return QStringLiteral("org.freedesktop.login1.Session"); }

private:
    static QString service() { return QStringLiteral("org.freedesktop.login1"); }

    QDBusMessage reply(const QDBusMessage& call) const
    {
        if (call.member() == QLatin1String("GetSession") && session.isValid() && call.arguments() == QVariantList{QStringLiteral("auto")})
            return call.createReply(session);
        if (call.member() == QLatin1String("GetAll") && call.path() == path() && call.arguments() == QVariantList{sessionInterface()})
            return call.createReply(answered.value_or(QVariantList{facts}));
        return call.createErrorReply(QStringLiteral("org.freedesktop.login1.NoSessionForPID"), QStringLiteral("no session"));
    }

    std::unique_ptr<BusMember> m_member;
};

class FakeSaver {
public:
    explicit FakeSaver(const QString& address, const QString& name = QStringLiteral("org.gnome.ScreenSaver"))
        : m_member(std::make_unique<BusMember>(address)),
          m_name(name),
          m_path(QLatin1Char('/') + QString(name).replace(QLatin1Char('.'), QLatin1Char('/')))
    {
        m_member->answer = [this](const QDBusMessage& call) {
            if (call.member() == QLatin1String("GetActive") && call.interface() == m_name && call.path() == m_path)
                return call.createReply(on);
            return call.createErrorReply(QDBusError::UnknownMethod, QStringLiteral("unknown"));
        };
        m_member->takeName(m_name);
    }

    QVariant on = false;
    int asked() const { return m_member->asked; }

    /// And says that it did.
    void turn(const QVariant& value)
    {
        on = value;
        m_member->emitSignal(m_path, m_name, QStringLiteral("ActiveChanged"), {value});
    }

private:
    std::unique_ptr<BusMember> m_member;
    QString m_name;
    QString m_path;
};

} // namespace console::test
