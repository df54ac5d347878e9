// Asked once, and heard.
#include "seat/screen_saver.hpp"

#include "seat/bus_question.hpp"

namespace console {

namespace {

/// KDE's has two.
QStringList pathsOf(QString service)
{
    QStringList paths{QLatin1Char('/') + service.replace(QLatin1Char('.'), QLatin1Char('/'))};
    if (paths.front().startsWith(QLatin1String("/org/freedesktop/")))
        paths << QStringLiteral("/ScreenSaver");
    return paths;
}

} // namespace

QStringList ScreenSaver::names()
{
    return {QStringLiteral("org.freedesktop.ScreenSaver"), QStringLiteral("org.gnome.ScreenSaver"),
            QStringLiteral("org.cinnamon.ScreenSaver"), QStringLiteral("org.mate.ScreenSaver"), QStringLiteral("org.xfce.ScreenSaver")};
}

ScreenSaver::ScreenSaver(const QDBusConnection& bus, const QString& name, QObject* parent)
    : QObject(parent), m_bus(bus), m_service(name), m_name(bus, name)
{}

ScreenSaver::~ScreenSaver() { unfollow(); } // as BusName

void ScreenSaver::begin()
{
    connect(&m_name, &BusName::taken, this, &ScreenSaver::follow);
    connect(&m_name, &BusName::vacant, this, [this] {
        unfollow();
        take(false);
    });
    m_name.begin();
}

/// QDBusConnection takes no other slots than named ones.
void ScreenSaver::follow(const QString& owner)
{
    unfollow();
    m_owner = owner;
    m_bus.connect(owner, QString(), m_service, QStringLiteral("ActiveChanged"), this, SLOT(hear(QDBusMessage)));
    for (const auto& path : pathsOf(m_service)) {
        const auto question = QDBusMessage::createMethodCall(owner, path, m_service, QStringLiteral("GetActive"));
        askOver(m_bus, question, this, [this, owner](const QDBusPendingCall& call) {
            if (owner == m_owner && !call.isError())
                hear(call.reply());
        });
    }
}

void ScreenSaver::unfollow()
{
    if (!m_owner.isEmpty())
        m_bus.disconnect(m_owner, QString(), m_service, QStringLiteral("ActiveChanged"), this, SLOT(hear(QDBusMessage)));
    m_owner.clear();
}

void ScreenSaver::hear(const QDBusMessage& word)
{
    const auto arguments = word.arguments();
    if (arguments.size() == 1)
        take(arguments.front());
}

void ScreenSaver::take(const QVariant& on)
{
    if (on.typeId() != QMetaType::Bool || on.toBool() == m_on)
        return;
    m_on = on.toBool();
    Q_EMIT changed();
}

} // namespace console
