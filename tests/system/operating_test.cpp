// `liena probe` and `liena audit` as a person uses them, beside devices that run.
#include "liena_program.hpp"
#include "test_system.hpp"

#include "liena/audit.hpp"

#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QTest>

#include <fstream>

using namespace liena;
using namespace liena::test;
using namespace std::chrono_literals;
using Kind = SessionEvent::Kind;

namespace {

/// The result of one step, from the probe's JSON.
QString stepOf(const ToolOutcome& outcome, const char* name)
{
    const auto steps = QJsonDocument::fromJson(outcome.output.toUtf8()).object()["steps"].toArray();
    for (const auto& step : steps)
        if (step.toObject()["step"].toString() == QLatin1String(name))
            return step.toObject()["result"].toString();
    return QStringLiteral("absent");
}

} // namespace

class OperatingTest : public QObject {
    Q_OBJECT

    static ToolOutcome probe(TestSystem& system, const char* target, const QStringList& more = {QStringLiteral("--json")})
    {
        const auto own = system.settingsOf("cockpit");
        return runLiena(QStringList{QStringLiteral("probe"), QString::fromLatin1(target), QStringLiteral("--topology"), text(own.topology),
                                    QStringLiteral("--device"), QStringLiteral("cockpit"), QStringLiteral("--pki"),
                                    text(own.certificate.parent_path())} +
                        more);
    }

private Q_SLOTS:
    void theProbeFindsAFreeWayAndDisturbsNobody()
    {
        TestSystem system({reference::cockpit, reference::robot}, {"cockpit robot"});
        std::atomic<int> lines = 0;
        auto settings = system.settingsOf("robot");
        TestDevice cockpit(system.settingsOf("cockpit"));
        settings.log = [&](LogLevel level, std::string_view) { lines += level >= LogLevel::Warning ? 1 : 0; };
        TestDevice robot(settings);
        QVERIFY(cockpit->openChannel(system.idOf("robot")));
        QTRY_VERIFY2(robot.heard(Kind::Opened), robot.story().c_str());
        const auto before = robot.story();
        for (int i = 0; i < 3; ++i) {
            const auto found = probe(system, "robot");
            QVERIFY2(found.status == 0, qPrintable(found.output + found.errors));
            for (const auto* step : {"own-files", "name", "route", "port", "tls", "identity", "certificate", "revocation", "acceptance"})
                QCOMPARE(stepOf(found, step), QStringLiteral("ok"));
        }
        QCOMPARE(robot.story(), before); // not an event
        QCOMPARE(lines.load(), 0);
        QCOMPARE(words(cockpit.state(system.idOf("robot"))), words(SessionState::Open));
        const auto spoken = probe(system, "robot", {});
        QVERIFY2(spoken.output.contains(QStringLiteral("ok       identity     robot (0x00008208)")), qPrintable(spoken.output));
    }

    void theProbeNamesWhatStandsBetween_data()
    {
        QTest::addColumn<QString>("what");
        QTest::addColumn<QString>("step");
        QTest::addColumn<QString>("words");
        const auto row = [](const char* what, const char* step, const char* words) {
            QTest::newRow(what) << QString::fromLatin1(what) << QString::fromLatin1(step) << QString::fromLatin1(words);
        };
        row("nobody listens", "port", "start the program");
        row("another site", "identity", "unknown authority");
        row("another device at its place", "identity", "was meant");
        row("revoked there", "revocation", "was revoked");
        row("revoked here", "own-files", "was revoked");
        row("near its end", "certificate", "last 24 hours");
        row("a bad list", "own-files", "ca.crl");
        row("no TLS", "tls", "TLS");
    }
    void theProbeNamesWhatStandsBetween()
    {
        QFETCH(QString, what);
        QFETCH(QString, step);
        QFETCH(QString, words);
        TestSystem system({reference::cockpit, reference::robot, reference::arm}, {"cockpit robot", "cockpit arm", "robot arm"});
        system.identityOf("cockpit");
        TestAuthority stranger;
        if (what == QLatin1String("near its end"))
            system.issueFor("robot", 20h);
        auto settings = system.settingsOf("robot");
        std::optional<TestDevice> robot;
        std::optional<TestSystem> plain;
        if (what == QLatin1String("another site")) {
            stranger.identityOf(system.idOf("robot"), "robot").applyTo(settings);
        } else if (what == QLatin1String("another device at its place")) {
            settings = placedAt(system, "arm", system.portOf("robot"));
        } else if (what == QLatin1String("no TLS")) {
            plain.emplace(std::vector<DeviceSpec>{reference::cockpit, reference::robot}, std::vector<std::string>{"cockpit robot"},
                          TestSystem::Options{.mode = "none"});
            settings = plain->settingsOf("robot");
            settings.topology = moved(*plain, plain->portOf("robot"), system.portOf("robot"));
        }
        if (what != QLatin1String("nobody listens"))
            robot.emplace(settings);
        if (what == QLatin1String("revoked there"))
            system.revoke({"robot"});
        if (what == QLatin1String("revoked here"))
            system.revoke({"cockpit"});
        if (what == QLatin1String("a bad list"))
            std::ofstream(system.revocations()) << "damaged\n";
        const auto found = probe(system, "robot");
        QCOMPARE(found.status, 1);
        QVERIFY2(stepOf(found, step.toLatin1()) == QLatin1String("failed"), qPrintable(found.output));
        const auto spoken = probe(system, "robot", {});
        QVERIFY2(spoken.output.contains(words), qPrintable(spoken.output));
        QVERIFY2(spoken.output.contains(QStringLiteral(" -> ")), qPrintable(spoken.output)); // what to do
    }

    void theProbeTellsThatTheDeviceRefusesUs()
    {
        TestSystem system({reference::cockpit, reference::robot}, {"cockpit robot"});
        auto settings = system.settingsOf("robot");
        const auto own = system.folder() / "own-ca.crt";
        std::filesystem::copy_file(settings.authority, own);
        settings.authority = own; // and so its own list
        system.identityOf("cockpit");
        system.revoke({"cockpit"});
        std::filesystem::copy_file(system.revocations(), system.folder() / "own-ca.crl");
        std::filesystem::remove(system.revocations());
        TestDevice robot(settings);
        const auto found = probe(system, "robot");
        QCOMPARE(found.status, 1);
        QVERIFY2(stepOf(found, "identity") == QLatin1String("ok") && stepOf(found, "acceptance") == QLatin1String("failed"),
                 qPrintable(found.output));
        QVERIFY2(found.output.contains(QStringLiteral("names our certificate")), qPrintable(found.output));
    }

    void theProbeRefusesWrongUse()
    {
        TestSystem system({reference::cockpit, reference::robot, reference::arm}, {"cockpit robot"});
        system.identityOf("cockpit");
        QCOMPARE(runLiena({QStringLiteral("probe")}).status, 2);
        const auto unlinked = probe(system, "arm");
        QCOMPARE(unlinked.status, 1);
        QVERIFY2(unlinked.errors.contains(QStringLiteral("no link between")), qPrintable(unlinked.errors));
        QVERIFY(probe(system, "scalpel").errors.contains(QStringLiteral("scalpel")));
    }

    /// What is shorter than a buffer is written at the end only.
    void whatIsNotWrittenIsNoSuccess()
    {
        const QStringList check{QStringLiteral("check"), QStringLiteral(LIENA_SOURCE_DIR "/resources/devices/vascular-robot.xml")};
        QCOMPARE(runLiena(check).status, 0);
        QProcess process;
        process.setStandardOutputFile(QStringLiteral("/dev/full"));
        process.start(lienaProgram, check);
        const auto full = outcomeOf(process);
        QCOMPARE(full.status, 1);
        QVERIFY2(full.errors.contains(QStringLiteral("liena check: the output was not written: ")), qPrintable(full.errors));
    }

    void theAuditCommandNamesTheAlteredLine()
    {
        TestSystem system({reference::cockpit, reference::robot}, {"cockpit robot"});
        auto settings = system.settingsOf("robot");
        settings.audit = system.folder() / "robot.jsonl";
        {
            TestDevice robot(settings);
            for (int i = 0; i < 5; ++i)
                robot->audit("note", "somebody", "number " + std::to_string(i));
        }
        const QStringList verify{QStringLiteral("audit"), QStringLiteral("verify"), text(settings.audit)};
        const auto whole = runLiena(verify);
        QVERIFY2(whole.status == 0 && whole.output.contains(QStringLiteral("whole, 7 entries, head ")), qPrintable(whole.output));
        const auto head = whole.output.trimmed().right(64);
        QCOMPARE(runLiena(verify + QStringList{QStringLiteral("--expect-head"), head}).status, 0);
        const auto foreign = runLiena(verify + QStringList{QStringLiteral("--expect-head"), QString(64, QLatin1Char('a'))});
        QCOMPARE(foreign.status, 1);
        QCOMPARE(runLiena(verify + QStringList{QStringLiteral("--expect-head"), QStringLiteral("abc")}).status, 2);
        std::ifstream stream(settings.audit);
        std::string content{std::istreambuf_iterator<char>(stream), {}};
        content.replace(content.find("number 2"), 8, "number 8");
        std::ofstream(settings.audit) << content;
        const auto altered = runLiena(verify);
        QCOMPARE(altered.status, 1);
        QVERIFY2(altered.output.contains(QStringLiteral("robot.jsonl:4: this line was altered")), qPrintable(altered.output));
        QCOMPARE(runLiena({QStringLiteral("audit"), QStringLiteral("verify"), QStringLiteral("/no/such/file")}).status, 1);
    }

private:
    /// The same topology with one port in another's place.
    static std::filesystem::path moved(const TestSystem& system, std::uint16_t from, std::uint16_t to)
    {
        std::ifstream stream(system.topology());
        std::string xml{std::istreambuf_iterator<char>(stream), {}};
        const auto old = "port=\"" + std::to_string(from) + "\"";
        xml.replace(xml.find(old), old.size(), "port=\"" + std::to_string(to) + "\"");
        const auto file = system.folder() / "moved.xml";
        std::ofstream(file) << xml;
        return file;
    }

    static Settings placedAt(TestSystem& system, const std::string& name, std::uint16_t port)
    {
        auto settings = system.settingsOf(name);
        std::ifstream stream(moved(system, port, freePort()));
        std::string xml{std::istreambuf_iterator<char>(stream), {}};
        const auto old = "port=\"" + std::to_string(system.portOf(name)) + "\"";
        xml.replace(xml.find(old), old.size(), "port=\"" + std::to_string(port) + "\"");
        settings.topology = system.folder() / "placed.xml";
        std::ofstream(settings.topology) << xml;
        return settings;
    }
};

QTEST_GUILESS_MAIN(OperatingTest)
#include "operating_test.moc"
