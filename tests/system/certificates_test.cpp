// Certificates in a running system: a list that arrives, certificates near their end, and sessions that are open already.
#include "test_system.hpp"

#include <QTest>

#include <fstream>

using namespace liena;
using namespace liena::test;
using namespace std::chrono_literals;
using Kind = SessionEvent::Kind;

namespace {

std::string failureOf(const TestDevice& device)
{
    const auto failures = device.events(Kind::OpenFailed);
    return failures.empty() ? "" : failures.back().detail;
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

} // namespace

class CertificatesTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void aRevokedPeerIsRefusedOnConnect()
    {
        TestSystem system({reference::cockpit, reference::robot, reference::arm}, {"cockpit robot", "cockpit arm"});
        TestDevice robot(system.settingsOf("robot"));
        TestDevice arm(system.settingsOf("arm"));
        TestDevice cockpit(system.settingsOf("cockpit"));
        system.revoke({"robot"});
        QVERIFY(cockpit->openChannel(system.idOf("robot")));
        QTRY_VERIFY2(cockpit.heard(Kind::OpenFailed), cockpit.story().c_str());
        QVERIFY2(contains(failureOf(cockpit), "was revoked"), failureOf(cockpit).c_str());
        QCOMPARE(words(cockpit.events(Kind::OpenFailed)[0].diagnosis.probe), words(ProbeResult::TlsFailure));
        QVERIFY(cockpit->openChannel(system.idOf("arm")));
        QTRY_VERIFY2(cockpit.heard(Kind::Opened, system.idOf("arm")), cockpit.story().c_str());
    }

    void aRevokedPeerIsRefusedOnAccept()
    {
        TestSystem system({reference::cockpit, reference::robot}, {"cockpit robot"});
        auto settings = system.settingsOf("cockpit");
        // The revoked device has an older copy of the site's files and tries all the same.
        const auto own = system.folder() / "own-ca.crt";
        std::filesystem::copy_file(settings.authority, own);
        settings.authority = own;
        TestDevice robot(system.settingsOf("robot"));
        TestDevice cockpit(settings);
        system.revoke({"cockpit"});
        QVERIFY(cockpit->openChannel(system.idOf("robot")));
        QTRY_VERIFY2(robot.heard(Kind::IdentityRefused), robot.story().c_str());
        QVERIFY2(contains(robot.events(Kind::IdentityRefused)[0].detail, "was revoked"), robot.story().c_str());
        QTRY_VERIFY2(cockpit.heard(Kind::OpenFailed), cockpit.story().c_str());
        QVERIFY2(contains(failureOf(cockpit), "names our certificate"), failureOf(cockpit).c_str());
        QVERIFY(!robot.heard(Kind::Opened));
    }

    void aSessionThatIsOpenOutlivesTheListAndABadList()
    {
        TestSystem system({reference::cockpit, reference::robot, reference::arm}, {"cockpit robot", "cockpit arm"});
        TestDevice robot(system.settingsOf("robot"));
        TestDevice arm(system.settingsOf("arm"));
        TestDevice cockpit(system.settingsOf("cockpit"));
        QVERIFY(cockpit->openChannel(system.idOf("robot")));
        QTRY_VERIFY2(robot.heard(Kind::Opened), robot.story().c_str());
        system.revoke({"robot"});
        std::ofstream(system.revocations()) << "damaged\n";
        QVERIFY(cockpit->openChannel(system.idOf("arm")));
        QTRY_VERIFY2(cockpit.heard(Kind::OpenFailed, system.idOf("arm")), cockpit.story().c_str());
        QVERIFY2(contains(failureOf(cockpit), "ca.crl"), failureOf(cockpit).c_str());
        QCOMPARE(words(cockpit.events(Kind::OpenFailed)[0].reason), words(RejectReason::NotAdmitted));
        auto status = robot->report("RobotStatus").value();
        QCOMPARE(robot->publish(status), std::size_t{1});
        QTRY_VERIFY(!cockpit.messages("RobotStatus").empty());
        QCOMPARE(words(cockpit.state(system.idOf("robot"))), words(SessionState::Open));
        QVERIFY(!cockpit.heard(Kind::Interrupted) && !cockpit.heard(Kind::Lost));
    }

    void noSessionBeginsNearACertificatesEnd_data()
    {
        QTest::addColumn<QString>("ending");
        QTest::addColumn<QString>("words");
        QTest::newRow("our own") << QStringLiteral("cockpit") << QStringLiteral("cockpit.crt ends on");
        QTest::newRow("the peer's") << QStringLiteral("robot") << QStringLiteral("0x00008208 ends on");
    }
    void noSessionBeginsNearACertificatesEnd()
    {
        QFETCH(QString, ending);
        QFETCH(QString, words);
        TestSystem system({reference::cockpit, reference::robot}, {"cockpit robot"});
        system.issueFor(ending.toStdString(), 23h);
        TestDevice robot(system.settingsOf("robot"));
        TestDevice cockpit(system.settingsOf("cockpit"));
        QVERIFY(cockpit->openChannel(system.idOf("robot")));
        QTRY_VERIFY2(cockpit.heard(Kind::OpenFailed), cockpit.story().c_str());
        QVERIFY2(contains(failureOf(cockpit), words.toStdString()), failureOf(cockpit).c_str());
        QVERIFY2(contains(failureOf(cockpit), "liena pki issue") || contains(failureOf(cockpit), "issue a new one"),
                 failureOf(cockpit).c_str());
        QVERIFY(!robot.heard(Kind::Opened));
        // The other way round: the responder says it too.
        QVERIFY(robot->openChannel(system.idOf("cockpit")));
        QTRY_VERIFY2(robot.heard(Kind::OpenFailed), robot.story().c_str());
        QCOMPARE(liena::test::words(robot.state(system.idOf("cockpit"))), liena::test::words(SessionState::Closed));
    }

    void theOtherEndIsToldWhyItIsNotAdmitted()
    {
        TestSystem system({reference::cockpit, reference::robot}, {"cockpit robot"});
        TestDevice robot(system.settingsOf("robot"));
        auto settings = system.settingsOf("cockpit");
        const auto own = system.folder() / "own-ca.crt";
        std::filesystem::copy_file(settings.authority, own);
        settings.authority = own;
        TestDevice cockpit(settings);
        std::ofstream(system.revocations()) << "damaged\n"; // seen by the robot only
        QVERIFY(cockpit->openChannel(system.idOf("robot")));
        QTRY_VERIFY2(cockpit.heard(Kind::OpenFailed), cockpit.story().c_str());
        QCOMPARE(words(cockpit.events(Kind::OpenFailed)[0].reason), words(RejectReason::NotAdmitted));
        QVERIFY2(contains(failureOf(cockpit), "ca.crl"), failureOf(cockpit).c_str());
        std::filesystem::remove(system.revocations());
        QVERIFY(cockpit->openChannel(system.idOf("robot")));
        QTRY_VERIFY2(cockpit.heard(Kind::Opened), cockpit.story().c_str());
    }

    void aCertificateWithADayAndAnHourOpens()
    {
        TestSystem system({reference::cockpit, reference::robot}, {"cockpit robot"});
        system.issueFor("cockpit", 25h);
        TestDevice robot(system.settingsOf("robot"));
        TestDevice cockpit(system.settingsOf("cockpit"));
        QVERIFY(cockpit->openChannel(system.idOf("robot")));
        QTRY_VERIFY2(robot.heard(Kind::Opened), robot.story().c_str());
    }
};

QTEST_GUILESS_MAIN(CertificatesTest)
#include "certificates_test.moc"
