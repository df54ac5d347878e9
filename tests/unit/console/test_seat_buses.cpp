// Where a console asks whether somebody sees its screen.
#include "seat/seat_watch.hpp"

#include <QTest>

using namespace console;

class TestSeatBuses : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void areToldByPlatformAndEnvironment_data()
    {
        QTest::addColumn<QString>("platform");
        QTest::addColumn<QStringList>("environment");
        QTest::addColumn<QStringList>("buses"); // the system's, the session's, the display
        const auto row = [](const char* name, const char* platform, const QStringList& environment, const QStringList& buses) {
            QTest::newRow(name) << QString::fromLatin1(platform) << environment << buses;
        };
        const QString usual = QStringLiteral("unix:path=/run/dbus/system_bus_socket");
        const QString display = QStringLiteral("DISPLAY=:0");
        const QString session = QStringLiteral("DBUS_SESSION_BUS_ADDRESS=unix:path=/run/user/7/bus");
        const QString address = QStringLiteral("unix:path=/run/user/7/bus");
        row("on X11", "xcb", {display, session}, {usual, address, QStringLiteral(":0")});
        row("on Wayland", "wayland", {display, session}, {usual, address, {}});
        row("on Wayland, by EGL", "wayland-egl", {display, session}, {usual, address, {}});
        row("the session's bus where it usually is", "xcb", {display, QStringLiteral("XDG_RUNTIME_DIR=/run/user/7")},
            {usual, address, QStringLiteral(":0")});
        row("no session's bus", "wayland", {}, {usual, {}, {}});
        row("the system's bus elsewhere", "wayland", {QStringLiteral("DBUS_SYSTEM_BUS_ADDRESS=unix:path=/elsewhere")},
            {QStringLiteral("unix:path=/elsewhere"), {}, {}});
        row("buses that would be started", "wayland",
            {QStringLiteral("DBUS_SYSTEM_BUS_ADDRESS=unixexec:path=/bin/bridge"), QStringLiteral("DBUS_SESSION_BUS_ADDRESS=autolaunch:")},
            {{}, {}, {}});
        row("without a screen", "offscreen", {display, session}, {{}, {}, {}});
        row("served by VNC", "vnc", {display, session}, {{}, {}, {}});
    }

    void areToldByPlatformAndEnvironment()
    {
        QFETCH(QString, platform);
        QFETCH(QStringList, environment);
        QFETCH(QStringList, buses);
        QProcessEnvironment values;
        for (const auto& entry : environment)
            values.insert(entry.section(QLatin1Char('='), 0, 0), entry.section(QLatin1Char('='), 1));
        const auto found = seatBusesOf(platform, values);
        QCOMPARE((QStringList{found.system, found.session, found.display}), buses);
    }
};

QTEST_GUILESS_MAIN(TestSeatBuses)
#include "test_seat_buses.moc"
