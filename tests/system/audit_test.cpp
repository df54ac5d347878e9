// What a device's audit file tells of its sessions, and what happens when it cannot be written. And a log that no peer can forge.
#include "child_process.hpp"
#include "full_disk.hpp"
#include "test_system.hpp"

#include "liena/audit.hpp"

#include <QTest>

#include <fstream>

using namespace liena;
using namespace liena::test;
using Kind = SessionEvent::Kind;

namespace {

std::string contentOf(const std::filesystem::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

bool tells(const std::filesystem::path& file, const std::string& event, const std::string& part = {})
{
    std::istringstream stream(contentOf(file));
    for (std::string line; std::getline(stream, line);)
        if (line.find("\"event\":\"" + event + "\"") != std::string::npos && line.find(part) != std::string::npos)
            return true;
    return false;
}

/// Keeps the lines as a file of them would have them.
class LogFile {
public:
    explicit LogFile(LogFormat format) : m_format(format) {}
    LogSink sink()
    {
        return [this](const LogLine& line) {
            const std::lock_guard lock(m_mutex);
            m_text += formatLog(line, m_format, std::chrono::system_clock::now()) + '\n';
        };
    }
    std::string text() const
    {
        const std::lock_guard lock(m_mutex);
        return m_text;
    }

private:
    LogFormat m_format;
    mutable std::mutex m_mutex;
    std::string m_text;
};

} // namespace

class AuditTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void tellsTheStoryOfASession()
    {
        TestSystem system({reference::cockpit, reference::robot}, {"cockpit robot"});
        auto settings = system.settingsOf("robot");
        settings.audit = system.folder() / "robot.jsonl";
        std::string head;
        settings.log = [&](const LogLine& line) {
            if (line.event == "audit-head")
                head = std::string(line.text);
        };
        {
            TestDevice robot(settings);
            TestDevice cockpit(system.settingsOf("cockpit"));
            QVERIFY(cockpit->openChannel(system.idOf("robot")));
            QTRY_VERIFY2(robot.heard(Kind::Opened), robot.story().c_str());
            robot->audit("permit-granted", "Dr. Liu", "permit 3");
            robot->revokeControl();
            QVERIFY(cockpit->closeChannel(system.idOf("robot"), "done for today"));
            QTRY_VERIFY2(robot.heard(Kind::Closed), robot.story().c_str());
            QVERIFY(robot->openChannel(system.idOf("cockpit")));
            QTRY_COMPARE(robot.events(Kind::Opened).size(), std::size_t{2});
        }
        const auto verdict = verifyAudit(settings.audit).value();
        QVERIFY2(verdict.sound(), verdict.fault.c_str());
        QVERIFY2(tells(settings.audit, "start", "test robot"), contentOf(settings.audit).c_str());
        QVERIFY(tells(settings.audit, "session-opened", "\"peer\":\"cockpit\""));
        QVERIFY(tells(settings.audit, "permit-granted", R"("who":"Dr. Liu","by":"application","text":"permit 3")"));
        QVERIFY(tells(settings.audit, "control-revoked"));
        QVERIFY(tells(settings.audit, "session-closed", "done for today"));
        QVERIFY(tells(settings.audit, "open-commanded", R"("peer":"cockpit","who":"robot")"));
        QVERIFY(tells(settings.audit, "stop"));
        QVERIFY2(head.find(verdict.head.toHex()) != std::string::npos, head.c_str());
    }

    void tellsOfLossReopeningAndWhoDecided()
    {
        TestSystem system({reference::cockpit, reference::robot}, {"cockpit robot"});
        auto settings = system.settingsOf("cockpit");
        settings.audit = system.folder() / "cockpit.jsonl";
        const auto robotFile = system.folder() / "robot.jsonl";
        const auto startRobot = [&] {
            return std::make_unique<ChildProcess>(
                QStringLiteral("liena-device"),
                QStringList{QStringLiteral("robot")} + system.argumentsOf("robot") +
                    QStringList{QStringLiteral("--audit"), QString::fromStdString(robotFile.string()), QStringLiteral("--log-format"),
                                QStringLiteral("json"), QStringLiteral("--status"), QString::fromStdString(settings.status.string())});
        };
        TestDevice cockpit(settings);
        const auto robotId = system.idOf("robot");
        auto robot = startRobot();
        QVERIFY2(robot->waitForLine(QStringLiteral("\"event\":\"listening\"")), qPrintable(robot->output()));
        QVERIFY(cockpit->openChannel(robotId));
        QTRY_VERIFY2(cockpit.heard(Kind::Opened), cockpit.story().c_str());
        robot->kill();
        QTRY_VERIFY2(cockpit.heard(Kind::StandByBegan), cockpit.story().c_str());
        robot = startRobot();
        QVERIFY2(robot->waitForLine(QStringLiteral("\"event\":\"listening\"")), qPrintable(robot->output()));
        cockpit->audit("confirmation", "Dr. Liu", "re-open the robot");
        QVERIFY(cockpit->reopenChannel(robotId));
        QTRY_VERIFY2(cockpit.heard(Kind::ReOpened), cockpit.story().c_str());
        QTRY_VERIFY2(tells(settings.audit, "standby-ended"), contentOf(settings.audit).c_str());
        QTRY_VERIFY2(tells(settings.audit, "session-reopened"), contentOf(settings.audit).c_str());
        char incident[17];
        std::snprintf(incident, sizeof incident, "%016llx", static_cast<unsigned long long>(cockpit.events(Kind::Lost)[0].incident.id));
        for (const auto* event : {"session-lost", "incident-raised", "reopen-commanded", "session-reopened", "incident-ended"})
            QVERIFY2(tells(settings.audit, event, incident), (event + ("\n" + contentOf(settings.audit))).c_str());
        QVERIFY(tells(settings.audit, "confirmation", "Dr. Liu"));
        QVERIFY(verifyAudit(settings.audit).value().sound());
        QCOMPARE(robot->terminate(), 0);
        // The robot was killed, and its file is whole all the same: two starts, one stop.
        const auto verdict = verifyAudit(robotFile).value();
        QVERIFY2(verdict.sound(), verdict.fault.c_str());
        QCOMPARE(QString::fromStdString(contentOf(robotFile)).count(QStringLiteral("\"event\":\"start\"")), 2);
        QCOMPARE(QString::fromStdString(contentOf(robotFile)).count(QStringLiteral("\"event\":\"stop\"")), 1);
        QVERIFY(robot->output().contains(QString::fromStdString(verdict.head.toHex())));
    }

    void tellsRefusedHandshakesOncePerCause()
    {
        TestSystem system({reference::cockpit, reference::robot}, {"cockpit robot"});
        auto settings = system.settingsOf("robot");
        settings.audit = system.folder() / "robot.jsonl";
        LogFile log(LogFormat::Text);
        settings.log = log.sink();
        TestDevice robot(settings);
        TestAuthority stranger;
        auto foreign = system.settingsOf("cockpit");
        stranger.identityOf(system.idOf("cockpit"), "cockpit").applyTo(foreign);
        foreign.authority = system.settingsOf("cockpit").authority; // it believes us; we do not believe it
        foreign.certificate = stranger.folder() / "cockpit.crt";
        foreign.authority = stranger.certificate();
        TestDevice attacker(foreign);
        for (int i = 0; i < 5; ++i) {
            const auto before = attacker.events(Kind::OpenFailed).size();
            QVERIFY(attacker->openChannel(system.idOf("robot")));
            QTRY_COMPARE(attacker.events(Kind::OpenFailed).size(), before + 1);
        }
        QTRY_VERIFY2(tells(settings.audit, "handshake-refused"), contentOf(settings.audit).c_str());
        QCOMPARE(robot.events(Kind::IdentityRefused).size(), std::size_t(1));
        QCOMPARE(QString::fromStdString(log.text()).count(QStringLiteral("refused 1 connection")), 1);
        QCOMPARE(QString::fromStdString(contentOf(settings.audit)).count(QStringLiteral("handshake-refused")), 1);
    }

    void aLostFileIsAnAlarmAndStopsNewSessionsOnly()
    {
        TestSystem system({reference::cockpit, reference::robot, reference::arm}, {"cockpit robot", "cockpit arm"});
        auto settings = system.settingsOf("cockpit");
        settings.audit = system.folder() / "cockpit.jsonl";
        TestDevice cockpit(settings);
        TestDevice robot(system.settingsOf("robot"));
        TestDevice arm(system.settingsOf("arm"));
        const auto robotId = system.idOf("robot");
        QVERIFY(cockpit->openChannel(robotId));
        QTRY_VERIFY2(robot.heard(Kind::Opened), robot.story().c_str());
        {
            const FullDisk full;
            cockpit->audit("note", "somebody");
            QTRY_VERIFY2(cockpit.heard(Kind::AuditLost), cockpit.story().c_str());
            QVERIFY(cockpit.events(Kind::AuditLost)[0].detail.find("cockpit.jsonl") != std::string::npos);
            // Nothing opens, from here or from there.
            QVERIFY(cockpit->openChannel(system.idOf("arm")));
            QTRY_VERIFY2(cockpit.heard(Kind::OpenFailed), cockpit.story().c_str());
            QCOMPARE(words(cockpit.events(Kind::OpenFailed)[0].reason), words(RejectReason::NotAdmitted));
            QVERIFY(arm->openChannel(system.idOf("cockpit")));
            QTRY_VERIFY2(arm.heard(Kind::OpenFailed), arm.story().c_str());
            QCOMPARE(words(arm.events(Kind::OpenFailed)[0].reason), words(RejectReason::NotAdmitted));
            // What is open goes on.
            QCOMPARE(robot->publish(robot->report("RobotStatus").value()), std::size_t{1});
            QTRY_VERIFY(!cockpit.messages("RobotStatus").empty());
            QCOMPARE(words(cockpit.state(robotId)), words(SessionState::Open));
            QCOMPARE(cockpit.events(Kind::AuditLost).size(), std::size_t(1));
        }
        QTRY_VERIFY2(cockpit.heard(Kind::AuditRestored), cockpit.story().c_str());
        QVERIFY(cockpit->openChannel(system.idOf("arm")));
        QTRY_VERIFY2(cockpit.heard(Kind::Opened, system.idOf("arm")), cockpit.story().c_str());
        QVERIFY(!cockpit.heard(Kind::Interrupted) && !cockpit.heard(Kind::Lost));
        QTRY_VERIFY2(tells(settings.audit, "audit-lost"), contentOf(settings.audit).c_str());
    }

    void doesNotStartWithoutItsFile()
    {
        TestSystem system({reference::cockpit, reference::robot}, {"cockpit robot"});
        auto settings = system.settingsOf("robot");
        settings.audit = system.folder() / "missing" / "robot.jsonl";
        const auto created = DistributedSystem::create(settings);
        QVERIFY(!created);
        QVERIFY2(created.error().what.find(settings.audit.string()) != std::string::npos, created.error().what.c_str());
    }

    void aPeersWordsForgeNoLogLine_data()
    {
        QTest::addColumn<int>("format");
        QTest::newRow("text") << int(LogFormat::Text);
        QTest::newRow("json") << int(LogFormat::Json);
    }
    void aPeersWordsForgeNoLogLine()
    {
        QFETCH(int, format);
        TestSystem system({reference::cockpit, reference::robot}, {"cockpit robot"});
        LogFile log(static_cast<LogFormat>(format));
        auto settings = system.settingsOf("robot");
        settings.log = log.sink();
        settings.audit = system.folder() / "robot.jsonl";
        {
            TestDevice robot(settings);
            auto attacker = system.settingsOf("cockpit");
            attacker.software = "x\n2026-01-01T00:00:00.000Z info ok";
            TestDevice cockpit(attacker);
            QVERIFY(cockpit->openChannel(system.idOf("robot")));
            QTRY_VERIFY2(robot.heard(Kind::Opened), robot.story().c_str());
            QVERIFY(cockpit->closeChannel(system.idOf("robot"),
                                          "bye\n2026-01-01T00:00:00.000Z info the operator confirmed \x1b[2J\xE2\x80\xAE"));
            QTRY_VERIFY2(robot.heard(Kind::Closed), robot.story().c_str());
            const auto detail = robot.events(Kind::Closed)[0].detail;
            QVERIFY2(detail.find('\n') == std::string::npos && detail.find('\x1b') == std::string::npos && detail.size() < 100,
                     detail.c_str());
        }
        for (const auto& text : {log.text(), contentOf(settings.audit)}) {
            QVERIFY(text.find("\n2026-01-01T00:00:00.000Z") == std::string::npos);
            QVERIFY(text.find('\x1b') == std::string::npos && text.find("\xE2\x80\xAE") == std::string::npos);
        }
        QVERIFY(verifyAudit(settings.audit).value().sound());
    }
};

QTEST_GUILESS_MAIN(AuditTest)
#include "audit_test.moc"
