// A desktop's screen saver, as far as it says whether it is on.
#pragma once

#include "seat/bus_name.hpp"

#include <QDBusMessage>
#include <QStringList>

namespace console {

/// Any thread, the one that made it. What makes no sense is not heard; the word of one that ends is void with it.
class ScreenSaver : public QObject {
    Q_OBJECT
public:
    /// What the desktops call it, on the bus of a person's session.
    static QStringList names();

    ScreenSaver(const QDBusConnection& bus, const QString& name, QObject* parent = nullptr);
    ~ScreenSaver() override;

    void begin();

    bool on() const { return m_on; }

Q_SIGNALS:
    void changed();

private Q_SLOTS:
    void hear(const QDBusMessage& word);

private:
    void follow(const QString& owner);
    void unfollow();
    void take(const QVariant& on);

    QDBusConnection m_bus;
    QString m_service;
    BusName m_name;
    QString m_owner; ///< its unique name
    bool m_on = false;
};

} // namespace console
