// What the diagnosis prompt names as the likely cause, and what it says to try.
#include "lost_links.hpp"

#include <QTest>

using namespace console;
using namespace console::test;
using namespace std::chrono_literals;

class TestPromptAdvice : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void advisesByWhatTheProbeFound_data()
    {
        QTest::addColumn<ProbeFinding>("probe");
        QTest::addColumn<quint32>("peer");
        QTest::addColumn<int>("lostLinks");
        QTest::addColumn<QString>("cause");
        QTest::addColumn<QString>("tryFirst");
        const auto row = [](const char* name, ProbeFinding probe, quint32 peer, int count, const char* cause, const char* first) {
            QTest::newRow(name) << probe << peer << count << QString::fromUtf8(cause) << QString::fromUtf8(first);
        };
        row("interface", ProbeFinding::InterfaceDown, robot, 1, "This console has no network", "at this side");
        row("no route", ProbeFinding::NoRoute, robot, 1, "no way to the hospital", "VPN");
        row("host", ProbeFinding::HostUnreachable, robot, 1, "others there do", "Power");
        row("refused", ProbeFinding::ConnectionRefused, robot, 1, "its program is not running", "Restart the program");
        row("identity", ProbeFinding::TlsFailure, robot, 1, "identity was refused", "Do not bypass");
        row("silent", ProbeFinding::PeerSilent, robot, 1, "hangs or is overloaded", "Wait 2 s");
        row("not probed", ProbeFinding::NotProbed, robot, 1, "run the checks", "Run checks");
        row("all lost", ProbeFinding::PeerSilent, robot, 3, "All links were lost at once", "VPN of this console");
        row("all lost, refused", ProbeFinding::ConnectionRefused, robot, 3, "its program is not running", "Restart the program");
        row("all lost, identity", ProbeFinding::TlsFailure, robot, 3, "identity was refused", "Do not bypass");
        row("all lost, host", ProbeFinding::HostUnreachable, robot, 3, "All links were lost at once", "VPN of this console");
        row("all lost, no route", ProbeFinding::NoRoute, robot, 3, "All links were lost at once", "Network port");
        row("all lost, interface", ProbeFinding::InterfaceDown, robot, 3, "This console has no network", "at this side");
        row("only pictures", ProbeFinding::PeerSilent, xray, 1, "Only the pictures are lost", "motion stays inhibited");
        row("pictures, identity", ProbeFinding::TlsFailure, xray, 1, "identity was refused", "Do not bypass");
    }

    void advisesByWhatTheProbeFound()
    {
        QFETCH(ProbeFinding, probe);
        QFETCH(quint32, peer);
        QFETCH(int, lostLinks);
        QFETCH(QString, cause);
        QFETCH(QString, tryFirst);
        SessionModel sessions;
        fill(sessions);
        auto incident = lost(peer);
        incident.diagnosis->probe = probe;
        auto seen = around();
        seen.lostLinks = lostLinks;
        seen.lostTogether = lostLinks == 3;
        const auto content = promptContent(incident, sessions, seen, start);
        QVERIFY2(content.likelyCause.contains(cause), qPrintable(content.likelyCause));
        QVERIFY2(content.tryFirst.contains(tryFirst), qPrintable(content.tryFirst));
    }

    void notOnlyThePicturesAreLostWhileAnotherLinkCarriesNothing_data()
    {
        QTest::addColumn<LinkState>("toRobot");
        QTest::addColumn<bool>("only");
        QTest::newRow("open") << LinkState::Open << true;
        QTest::newRow("suspect") << LinkState::Suspect << true;
        for (const auto state :
             {LinkState::Closed, LinkState::Opening, LinkState::Reconnecting, LinkState::StandBy, LinkState::Reopening, LinkState::Closing})
            QTest::newRow(qPrintable(word(state))) << state << false;
    }

    void notOnlyThePicturesAreLostWhileAnotherLinkCarriesNothing()
    {
        QFETCH(LinkState, toRobot);
        QFETCH(bool, only);
        SessionModel sessions;
        fill(sessions);
        sessions.setLinkState(xray, LinkState::StandBy, start);
        sessions.setLinkState(robot, toRobot, start);
        auto incident = lost(xray);
        incident.diagnosis->probe = ProbeFinding::PeerSilent;
        const auto content = promptContent(incident, sessions, around(), start); // one link stands by, as it was counted
        QCOMPARE(content.likelyCause.contains(QStringLiteral("Only the pictures are lost")), only);
        QCOMPARE(content.tryFirst.contains(QStringLiteral("picture link alone")), only);
    }

    void lossesOneAfterTheOtherAreNotAtOnce_data()
    {
        QTest::addColumn<int>("secondMs");
        QTest::addColumn<int>("thirdMs"); ///< -1: not lost
        QTest::addColumn<bool>("together");
        QTest::newRow("in the same moment") << 0 << 0 << true;
        QTest::newRow("within two seconds") << 700 << 2000 << true;
        QTest::newRow("one later") << 700 << 2001 << false;
        QTest::newRow("one before") << -60000 << 0 << false;
        QTest::newRow("one stands") << 100 << -1 << false;
    }

    void lossesOneAfterTheOtherAreNotAtOnce()
    {
        QFETCH(int, secondMs);
        QFETCH(int, thirdMs);
        QFETCH(bool, together);
        SessionModel sessions;
        fill(sessions);
        IncidentModel model;
        const auto raise = [&model](quint64 id, quint32 peer, int ms) {
            auto incident = lost(peer);
            incident.id = id;
            incident.since = start + std::chrono::milliseconds(ms);
            model.raise(incident, incident.since);
        };
        raise(1, robot, 0);
        raise(2, arm, secondMs);
        if (thirdMs >= 0)
            raise(3, xray, thirdMs);
        QCOMPARE(beganTogether(sessions, model), together);
        auto seen = around();
        seen.lostLinks = 3; // all of them stand by
        seen.lostTogether = together;
        auto silent = lost(robot);
        silent.diagnosis->probe = ProbeFinding::PeerSilent;
        QCOMPARE(promptContent(silent, sessions, seen, start).likelyCause.contains(QStringLiteral("All links were lost at once")),
                 together);
    }

    void namesThePortAndTheTroubleWithAnIdentity_data()
    {
        QTest::addColumn<ProbeFinding>("probe");
        QTest::addColumn<QString>("detail");
        QTest::addColumn<QString>("cause");
        const auto row = [](const char* name, ProbeFinding probe, const char* detail, const char* cause) {
            QTest::newRow(name) << probe << QString::fromLatin1(detail) << QString::fromLatin1(cause);
        };
        row("port", ProbeFinding::InterfaceDown, "", "no network on its port with the address 10.0.0.1");
        row("expired", ProbeFinding::TlsFailure,
            "10.0.0.2:1: the peer's certificate was refused: the certificate or its authority has expired",
            "refused: a certificate has expired");
        row("wrong device", ProbeFinding::TlsFailure, "10.0.0.2:1 is device 0x20010208, not 0x00008208 (robot)",
            "refused: it is another device");
        row("unknown", ProbeFinding::TlsFailure, "the certificate is from an unknown authority", "authority that is not known there");
        row("revoked", ProbeFinding::TlsFailure, "the certificate was revoked by the site's authority", "a certificate was revoked");
        row("not said", ProbeFinding::TlsFailure, "the handshake failed", "The device answered but its identity was refused");
    }

    void namesThePortAndTheTroubleWithAnIdentity()
    {
        QFETCH(ProbeFinding, probe);
        QFETCH(QString, detail);
        QFETCH(QString, cause);
        SessionModel sessions;
        fill(sessions);
        auto incident = lost(robot);
        incident.diagnosis->probe = probe;
        incident.diagnosis->probeDetail = detail;
        auto seen = around();
        seen.ownHost = QStringLiteral("10.0.0.1");
        const auto content = promptContent(incident, sessions, seen, start);
        QVERIFY2(content.likelyCause.endsWith(cause), qPrintable(content.likelyCause));
    }

    void neverPromisesToResume()
    {
        SessionModel sessions;
        fill(sessions);
        for (const auto probe : {ProbeFinding::NotProbed, ProbeFinding::PeerSilent, ProbeFinding::Reachable, ProbeFinding::TlsFailure}) {
            auto incident = lost(robot);
            incident.diagnosis->probe = probe;
            const auto content = promptContent(incident, sessions, around(), start);
            QVERIFY(!(content.likelyCause + content.tryFirst + content.patient).contains(QStringLiteral("resume"), Qt::CaseInsensitive));
        }
    }
};

QTEST_GUILESS_MAIN(TestPromptAdvice)
#include "test_prompt_advice.moc"
