// Which sessions are recognised as remote.
#include "model/input_origin.hpp"

#include <QTest>

using namespace console;

class TestInputOrigin : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void isToldByPlatformAndEnvironment_data()
    {
        QTest::addColumn<QString>("platform");
        QTest::addColumn<QStringList>("environment");
        QTest::addColumn<QString>("origin");
        const auto row = [](const char* name, const char* platform, const QStringList& environment, const char* origin) {
            QTest::newRow(name) << QString::fromLatin1(platform) << environment << QString::fromLatin1(origin);
        };
        const QString ssh = QStringLiteral("SSH_CONNECTION=10.0.0.7 50022 10.0.0.9 22");
        row("at the computer", "xcb", {QStringLiteral("DISPLAY=:0")}, "");
        row("at the computer, wayland", "wayland", {QStringLiteral("WAYLAND_DISPLAY=wayland-0"), QStringLiteral("DISPLAY=:0")}, "");
        row("at the computer, by name", "xcb", {QStringLiteral("DISPLAY=unix:0")}, "");
        row("at the computer, by socket", "xcb", {QStringLiteral("DISPLAY=/tmp/x11:0")}, "");
        row("nothing is said", "xcb", {}, "");
        row("served by VNC", "vnc", {}, "VNC");
        row("served by VNC, at the computer", "vnc", {QStringLiteral("DISPLAY=:0")}, "VNC");
        row("XRDP", "xcb", {QStringLiteral("DISPLAY=:10.0"), QStringLiteral("XRDP_SESSION=1")}, "XRDP");
        row("a VNC server's session", "xcb", {QStringLiteral("DISPLAY=:1"), QStringLiteral("VNCDESKTOP=host:1")}, "VNC");
        row("X2Go", "xcb", {QStringLiteral("DISPLAY=:50"), QStringLiteral("X2GO_SESSION=a-50")}, "X2Go");
        row("Chrome", "xcb", {QStringLiteral("DISPLAY=:20"), QStringLiteral("CHROME_REMOTE_DESKTOP_SESSION=1")}, "Chrome Remote Desktop");
        row("SSH forwards the display", "xcb", {ssh, QStringLiteral("DISPLAY=localhost:10.0")}, "SSH");
        row("SSH forwards it, and sudo forgot", "xcb", {QStringLiteral("DISPLAY=localhost:10.0")}, "localhost:10.0");
        row("a display of another computer", "xcb", {QStringLiteral("DISPLAY=10.0.0.7:0")}, "10.0.0.7:0");
        row("the same, by its protocol", "xcb", {QStringLiteral("DISPLAY=tcp/10.0.0.7:0")}, "tcp/10.0.0.7:0");
        row("at the computer, by its protocol", "xcb", {QStringLiteral("DISPLAY=unix/cockpit:0")}, "");
        row("SSH, on this computer's screen", "xcb", {ssh, QStringLiteral("DISPLAY=:0")}, "");
        row("a machine for tests, by SSH", "offscreen", {ssh, QStringLiteral("DISPLAY=localhost:10.0")}, "");
        row("a machine for tests, Xvfb by SSH", "xcb", {ssh, QStringLiteral("DISPLAY=:99")}, "");
        row("a machine for tests, within XRDP", "offscreen", {QStringLiteral("XRDP_SESSION=1")}, "");
    }

    void isToldByPlatformAndEnvironment()
    {
        QFETCH(QString, platform);
        QFETCH(QStringList, environment);
        QFETCH(QString, origin);
        QProcessEnvironment values;
        for (const auto& entry : environment)
            values.insert(entry.section(QLatin1Char('='), 0, 0), entry.section(QLatin1Char('='), 1));
        QCOMPARE(remoteInputOf(platform, values), origin);
    }
};

QTEST_GUILESS_MAIN(TestInputOrigin)
#include "test_input_origin.moc"
