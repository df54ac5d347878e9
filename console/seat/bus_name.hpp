// Who has a name on a bus of D-Bus.
#pragma once

#include <QDBusConnection>
#include <QDBusServiceWatcher>
#include <QObject>
#include <QString>

namespace console {

/// Asks once, and hears of every change. Any thread, the one that made it.
class BusName : public QObject {
    Q_OBJECT
public:
    BusName(const QDBusConnection& bus, const QString& name, QObject* parent = nullptr);
    ~BusName() override;

    void begin();

Q_SIGNALS:
    void taken(const QString& owner); ///< by a program with that unique name, which no other one ever has
    void vacant();                    ///< nobody has it, or no longer

private:
    void tell(const QString& owner);

    QDBusConnection m_bus;
    QString m_name;
    QDBusServiceWatcher m_watcher;
    bool m_changed = false;
};

} // namespace console
