// A recording may stand for the live picture only where nothing but what this computer simulates can be moved by it.
#include "theatre.hpp"

#include <QTest>

using namespace console;
using console::test::cockpitOptions;
namespace reference = liena::test::reference;

namespace {

/// Whether the console gets as far as showing itself.
bool begins(liena::test::TestSystem& files, bool rehearsal, QString& error)
{
    auto options = cockpitOptions(files);
    options.rehearsal = rehearsal;
    CockpitApplication console(options);
    return console.prepare(&error);
}

} // namespace

class RehearsalTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void aRobotThatMayBeARealOneIsRefused_data()
    {
        QTest::addColumn<QString>("robotHost");
        QTest::addColumn<QString>("armHost");
        QTest::addColumn<QString>("xrayHost");
        QTest::addColumn<QString>("refused");
        const QString here = QStringLiteral("127.0.0.1");
        const QString elsewhere = QStringLiteral("192.0.2.7"); // RFC 5737: nobody's
        QTest::newRow("all here") << here << here << here << QString();
        QTest::newRow("here, by another loopback address") << QStringLiteral("127.0.0.2") << here << here << QString();
        QTest::newRow("here, by IPv6") << QStringLiteral("::1") << here << here << QString();
        QTest::newRow("here, by name") << QStringLiteral("localhost") << here << here << QString();
        QTest::newRow("an X-ray system elsewhere moves nothing") << here << here << elsewhere << QString();
        QTest::newRow("robot elsewhere") << elsewhere << here << here << QStringLiteral("\"robot\" at 192.0.2.7:");
        QTest::newRow("robot at a name") << QStringLiteral("robot.hospital") << here << here
                                         << QStringLiteral("\"robot\" at robot.hospital:");
        QTest::newRow("arm elsewhere") << here << elsewhere << here << QStringLiteral("\"arm\" at 192.0.2.7:");
    }
    void aRobotThatMayBeARealOneIsRefused()
    {
        QFETCH(QString, robotHost);
        QFETCH(QString, armHost);
        QFETCH(QString, xrayHost);
        QFETCH(QString, refused);
        auto robot = reference::robot;
        auto arm = reference::arm;
        auto xray = reference::xray;
        robot.host = robotHost.toStdString();
        arm.host = armHost.toStdString();
        xray.host = xrayHost.toStdString();
        liena::test::TestSystem files({reference::cockpit, robot, arm, xray}, {"cockpit robot", "cockpit arm", "cockpit xray"});
        QString error;
        QVERIFY2(begins(files, false, error), qPrintable(error)); // the same without a rehearsal
        QCOMPARE(begins(files, true, error), refused.isEmpty());
        QVERIFY2(error.contains(refused) && error.isEmpty() == refused.isEmpty(), qPrintable(error));
    }

    void aRobotOfAnotherCockpitDoesNotMatter()
    {
        auto robot = reference::robot;
        robot.host = "192.0.2.7";
        liena::test::TestSystem files({reference::cockpit, robot, reference::arm}, {"cockpit arm", "arm robot"});
        QString error;
        QVERIFY2(begins(files, true, error), qPrintable(error));
    }
};

QTEST_MAIN(RehearsalTest)
#include "rehearsal_test.moc"
