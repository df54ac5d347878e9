// The session is looked up, asked, and asked again whenever it says that something of it is another.
#include "seat/login_session.hpp"

#include "seat/bus_question.hpp"

#include <QDBusArgument>
#include <QDBusObjectPath>
#include <QDBusPendingReply>

#include <optional>

namespace console {

namespace {

QString logind() { return QStringLiteral("org.freedesktop.login1"); }
QString sessionInterface() { return QStringLiteral("org.freedesktop.login1.Session"); }
QString properties() { return QStringLiteral("org.freedesktop.DBus.Properties"); }

std::optional<bool> flag(const QVariantMap& facts, const QString& name)
{
    const auto value = facts.value(name);
    return value.typeId() == QMetaType::Bool ? std::optional(value.toBool()) : std::nullopt;
}

std::optional<QString> text(const QVariantMap& facts, const QString& name)
{
    const auto value = facts.value(name);
    return value.typeId() == QMetaType::QString ? std::optional(value.toString()) : std::nullopt;
}

/// Empty: it has none.
std::optional<QString> seatOf(const QVariantMap& facts)
{
    const auto value = facts.value(QStringLiteral("Seat"));
    if (value.metaType() != QMetaType::fromType<QDBusArgument>())
        return std::nullopt;
    const auto argument = value.value<QDBusArgument>();
    if (argument.currentSignature() != QLatin1String("(so)"))
        return std::nullopt;
    QString name;
    argument.beginStructure();
    argument >> name;
    argument.endStructure();
    return name;
}

/// `:0`, `:0.1` and `unix/host:0` are one X server.
QString serverOf(const QString& display) { return display.section(QLatin1Char(':'), -1).section(QLatin1Char('.'), 0, 0); }

bool isGraphical(const QString& type)
{
    return type == QLatin1String("x11") || type == QLatin1String("wayland") || type == QLatin1String("mir");
}

LoginSession::Standing standingOf(const QVariantMap& facts, const QString& display)
{
    const auto type = text(facts, QStringLiteral("Type"));
    const auto kind = text(facts, QStringLiteral("Class"));
    const auto seat = seatOf(facts);
    if (!type || !kind || !seat)
        return LoginSession::Standing::Unknown;
    const auto server = text(facts, QStringLiteral("Display")).value_or(QString());
    const bool here = server.isEmpty() || display.isEmpty() || serverOf(server) == serverOf(display);
    const bool shows = isGraphical(*type) && kind->startsWith(QLatin1String("user")) && !seat->isEmpty() && here;
    return shows ? LoginSession::Standing::Ours : LoginSession::Standing::Foreign;
}

} // namespace

LoginSession::LoginSession(const QDBusConnection& bus, const QString& display, QObject* parent)
    : QObject(parent), m_bus(bus), m_name(bus, logind()), m_display(display)
{}

LoginSession::~LoginSession() { unfollow(); } // as BusName

void LoginSession::begin()
{
    connect(&m_name, &BusName::taken, this, &LoginSession::find);
    connect(&m_name, &BusName::vacant, this, [this] {
        unfollow();
        m_owner.clear();
        doubt(tr("it is not there"));
    });
    m_name.begin();
}

/// `auto` is the session of this program, or, where its desktop started it apart from its session, the one that its user sees.
void LoginSession::find(const QString& owner)
{
    unfollow();
    m_owner = owner;
    auto question = QDBusMessage::createMethodCall(owner, QStringLiteral("/org/freedesktop/login1"),
                                                   QStringLiteral("org.freedesktop.login1.Manager"), QStringLiteral("GetSession"));
    question << QStringLiteral("auto");
    askOver(m_bus, question, this, [this, owner](const QDBusPendingCall& call) {
        const QDBusPendingReply<QDBusObjectPath> path = call;
        if (owner != m_owner)
            return;
        if (path.isValid())
            follow(path.value().path());
        else
            doubt(path.error().message());
    });
}

/// From here on, before it is asked: what changes meanwhile is heard. QDBusConnection takes no other slots than named ones.
void LoginSession::follow(const QString& path)
{
    m_path = path;
    m_bus.connect(m_owner, path, properties(), QStringLiteral("PropertiesChanged"), this, SLOT(ask()));
    m_bus.connect(m_owner, path, sessionInterface(), QStringLiteral("Lock"), this, SLOT(lock()));
    m_bus.connect(m_owner, path, sessionInterface(), QStringLiteral("Unlock"), this, SLOT(unlock()));
    ask();
}

void LoginSession::unfollow()
{
    if (m_path.isEmpty())
        return;
    m_bus.disconnect(m_owner, m_path, properties(), QStringLiteral("PropertiesChanged"), this, SLOT(ask()));
    m_bus.disconnect(m_owner, m_path, sessionInterface(), QStringLiteral("Lock"), this, SLOT(lock()));
    m_bus.disconnect(m_owner, m_path, sessionInterface(), QStringLiteral("Unlock"), this, SLOT(unlock()));
    m_path.clear();
}

void LoginSession::ask()
{
    auto question = QDBusMessage::createMethodCall(m_owner, m_path, properties(), QStringLiteral("GetAll"));
    question << sessionInterface();
    askOver(m_bus, question, this, [this, owner = m_owner](const QDBusPendingCall& call) {
        const QDBusPendingReply<QVariantMap> facts = call;
        if (owner != m_owner)
            return;
        if (facts.isValid())
            take(facts.value());
        else
            doubt(facts.error().message());
    });
}

void LoginSession::take(const QVariantMap& facts)
{
    if (const auto locked = flag(facts, QStringLiteral("LockedHint"))) {
        m_lockAsked = m_lockAsked && (*locked || !m_locked); // answered, once the lock is there and goes
        m_locked = *locked;
    }
    if (const auto active = flag(facts, QStringLiteral("Active")))
        m_away = !*active;
    const auto standing = standingOf(facts, m_display);
    if (standing == Standing::Unknown) {
        doubt(tr("what it answers makes no sense"));
    } else if (m_standing != Standing::Ours) { // what was ours stays so
        m_standing = standing;
        m_why = standing == Standing::Foreign ? tr("this program belongs to no session with a screen") : QString();
    }
    Q_EMIT changed();
}

/// Of what is known already nobody doubts.
void LoginSession::doubt(const QString& why)
{
    if (m_standing != Standing::Awaited)
        return;
    m_standing = Standing::Unknown;
    m_why = why;
    Q_EMIT changed();
}

void LoginSession::lock()
{
    m_lockAsked = true;
    Q_EMIT changed();
}

void LoginSession::unlock()
{
    m_lockAsked = false;
    Q_EMIT changed();
}

} // namespace console
