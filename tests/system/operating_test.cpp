// `liena probe`, `liena monitor` and `liena audit` as a person uses them, beside devices that run.
#include "test_system.hpp"

#include "liena/audit.hpp"
#include "liena/status.hpp"

#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QProcess>
#include <QTest>

#include <fstream>

#include <fcntl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

using namespace liena;
using namespace liena::test;
using namespace std::chrono_literals;
using Kind = SessionEvent::Kind;

namespace {

struct Outcome {
    int status = -1;
    QString output;
    QString errors;
};

Outcome liena_(const QStringList& arguments)
{
    QProcess process;
    process.start(QStringLiteral(LIENA_PROGRAM_DIR "/liena"), arguments);
    if (!process.waitForFinished() || process.exitStatus() != QProcess::NormalExit)
        return {};
    return {process.exitCode(), QString::fromUtf8(process.readAllStandardOutput()), QString::fromUtf8(process.readAllStandardError())};
}

/// A device's status socket that says only what the test says.
class StatusSocket {
public:
    StatusSocket(const std::filesystem::path& file, int waiting) : m_address(addressOf(file)), m_socket(open())
    {
        if (::bind(m_socket, reinterpret_cast<const sockaddr*>(&m_address), sizeof m_address) != 0 || ::listen(m_socket, waiting) != 0)
            throw std::runtime_error("no status socket at " + file.string());
    }
    ~StatusSocket() { ::close(m_socket); }
    Q_DISABLE_COPY_MOVE(StatusSocket)

    /// To the next who connects; it stays connected.
    void say(const QByteArray& line) const
    {
        const int watcher = ::accept(m_socket, nullptr, nullptr);
        QCOMPARE(::send(watcher, (line + '\n').constData(), std::size_t(line.size()) + 1, 0), line.size() + 1);
    }

    /// Somebody who connects and waits.
    class Caller {
    public:
        explicit Caller(const StatusSocket& to) : m_socket(open())
        {
            if (::connect(m_socket, reinterpret_cast<const sockaddr*>(&to.m_address), sizeof to.m_address) != 0)
                throw std::runtime_error("not connected");
        }
        ~Caller() { ::close(m_socket); }
        Q_DISABLE_COPY_MOVE(Caller)

    private:
        int m_socket;
    };

private:
    static int open() { return ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0); }
    static sockaddr_un addressOf(const std::filesystem::path& file)
    {
        sockaddr_un address{};
        address.sun_family = AF_UNIX;
        file.string().copy(address.sun_path, sizeof address.sun_path - 1);
        return address;
    }

    sockaddr_un m_address;
    int m_socket;
};

/// What a program shows on its terminal.
class Terminal {
public:
    Terminal() : m_master(::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC))
    {
        if (m_master < 0 || ::grantpt(m_master) != 0 || ::unlockpt(m_master) != 0)
            throw std::runtime_error("no terminal");
    }
    ~Terminal() { ::close(m_master); }
    Q_DISABLE_COPY_MOVE(Terminal)

    QString name() const { return QString::fromLocal8Bit(::ptsname(m_master)); }

    /// What was written since it was cleared last.
    QByteArray screen()
    {
        char bytes[4096];
        for (auto count = ::read(m_master, bytes, sizeof bytes); count > 0; count = ::read(m_master, bytes, sizeof bytes))
            m_written.append(bytes, count);
        return m_written.mid(std::max<qsizetype>(0, m_written.lastIndexOf("\x1b[2J")));
    }

private:
    int m_master;
    QByteArray m_written;
};

QString text(const std::filesystem::path& path) { return QString::fromStdString(path.string()); }

/// The result of one step, from the probe's JSON.
QString stepOf(const Outcome& outcome, const char* name)
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

    static Outcome probe(TestSystem& system, const char* target, const QStringList& more = {QStringLiteral("--json")})
    {
        const auto own = system.settingsOf("cockpit");
        return liena_(QStringList{QStringLiteral("probe"), QString::fromLatin1(target), QStringLiteral("--topology"), text(own.topology),
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
        QCOMPARE(liena_({QStringLiteral("probe")}).status, 2);
        const auto unlinked = probe(system, "arm");
        QCOMPARE(unlinked.status, 1);
        QVERIFY2(unlinked.errors.contains(QStringLiteral("no link between")), qPrintable(unlinked.errors));
        QVERIFY(probe(system, "scalpel").errors.contains(QStringLiteral("scalpel")));
    }

    void theMonitorShowsWhatADeviceSees()
    {
        TestSystem system({reference::cockpit, reference::robot, reference::arm}, {"cockpit robot", "cockpit arm"});
        auto settings = system.settingsOf("robot");
        settings.audit = system.folder() / "robot.jsonl";
        TestDevice robot(settings);
        TestDevice cockpit(system.settingsOf("cockpit"));
        QVERIFY(cockpit->openChannel(system.idOf("robot")));
        QTRY_VERIFY(cockpit->links()[0].clockOffset.has_value());
        const QStringList monitor{QStringLiteral("monitor"), QStringLiteral("--folder"), text(settings.status)};
        const auto lines = liena_(monitor + QStringList{QStringLiteral("--json"), QStringLiteral("--once")});
        QCOMPARE(lines.errors, QString());
        QCOMPARE(lines.status, 0);
        const auto said = lines.output.split(QLatin1Char('\n'), Qt::SkipEmptyParts);
        QCOMPARE(said.size(), 2);
        for (const auto& line : said) {
            const auto object = QJsonDocument::fromJson(line.toUtf8()).object();
            const bool isCockpit = object["device"].toString() == QLatin1String("cockpit");
            QCOMPARE(object["links"].toArray().size(), isCockpit ? 2 : 1);
            QCOMPARE(object["audit"].isNull(), isCockpit);
            QCOMPARE(object["stands_by"].toBool(), false);
            for (const auto& link : object["links"].toArray())
                if (link.toObject()["peer"].toString() != QLatin1String("arm")) {
                    QCOMPARE(link.toObject()["state"].toString(), QStringLiteral("open"));
                    QVERIFY2(link.toObject()["rates"].toObject()["bytes_in"].toDouble() > 0, qPrintable(line)); // heartbeats
                    QVERIFY2(link.toObject()["latency_uncertainty_ms"].isDouble(), qPrintable(line));
                }
        }
        const auto page = liena_(monitor + QStringList{QStringLiteral("--once"), QStringLiteral("robot")});
        QVERIFY2(page.output.contains(QStringLiteral("cockpit       open")), qPrintable(page.output));
        QVERIFY2(page.output.contains(QStringLiteral("entries, head ")), qPrintable(page.output));
        QVERIFY(!page.output.contains(QStringLiteral("arm           closed")));
        QCOMPARE(words(cockpit.state(system.idOf("robot"))), words(SessionState::Open));
    }

    /// A program that is frozen: the kernel takes the connection, and nobody speaks.
    void theMonitorEndsBesideADeviceThatSaysNothing()
    {
        TestSystem system({reference::cockpit, reference::robot}, {"cockpit robot"});
        const auto settings = system.settingsOf("robot");
        TestDevice robot(settings);
        const StatusSocket frozen(statusSocket(settings.status, DeviceId(0x60008208)), 8);
        const StatusSocket full(statusSocket(settings.status, DeviceId(0x20010208)), 0);
        const StatusSocket::Caller waits(full); // as many as the kernel keeps: the next one would wait for ever
        const QStringList monitor{QStringLiteral("monitor"), QStringLiteral("--once"), QStringLiteral("--folder"), text(settings.status)};
        const auto all = liena_(monitor);
        QCOMPARE(all.status, 0);
        QVERIFY2(all.output.contains(QStringLiteral("robot (0x00008208)")), qPrintable(all.output));
        QVERIFY2(all.output.contains(QStringLiteral("0x60008208  SAYS NOTHING for ")), qPrintable(all.output));
        QVERIFY2(all.output.contains(QStringLiteral("0x20010208  SAYS NOTHING for ")), qPrintable(all.output));
        const auto one = liena_(monitor + QStringList{QStringLiteral("0x00008208"), QStringLiteral("--json")});
        QCOMPARE(one.status, 0);
        QCOMPARE(one.errors, QString()); // nobody asked for the others
        QVERIFY2(!QJsonDocument::fromJson(one.output.toUtf8()).isNull(), qPrintable(one.output));
        const auto none = liena_(monitor + QStringList{QStringLiteral("0x60008208"), QStringLiteral("--json")});
        QCOMPARE(none.status, 1);
        QCOMPARE(none.output, QString());
        QVERIFY2(none.errors.contains(QStringLiteral("0x60008208  SAYS NOTHING for ")), qPrintable(none.errors));
    }

    void theLivePageShowsWhoHasFallenSilent()
    {
        TestSystem system({reference::cockpit, reference::robot}, {"cockpit robot"});
        const auto folder = system.settingsOf("robot").status;
        std::filesystem::create_directory(folder);
        const StatusSocket device(statusSocket(folder, DeviceId(0x00008208)), 8);
        Terminal terminal;
        QProcess monitor;
        monitor.setStandardOutputFile(terminal.name());
        monitor.start(QStringLiteral(LIENA_PROGRAM_DIR "/liena"), {QStringLiteral("monitor"), QStringLiteral("--folder"), text(folder)});
        device.say(R"({"device":"robot","id":"0x00008208","links":[{"peer":"cockpit","state":"open"}]})");
        QTRY_VERIFY2(terminal.screen().contains("cockpit       open"), terminal.screen().constData());
        QTRY_VERIFY2(terminal.screen().contains("robot (0x00008208)  SAYS NOTHING for "), terminal.screen().constData());
        QVERIFY2(!terminal.screen().contains("cockpit       open"), terminal.screen().constData());
        monitor.kill();
        QVERIFY(monitor.waitForFinished());
    }

    void theMonitorsSocketIsForItsUserAlone()
    {
        TestSystem system({reference::cockpit, reference::robot}, {"cockpit robot"});
        const auto settings = system.settingsOf("robot");
        const auto socket = statusSocket(settings.status, system.idOf("robot"));
        {
            TestDevice robot(settings);
            struct stat status {};
            QCOMPARE(::stat(socket.c_str(), &status), 0);
            QCOMPARE(static_cast<int>(status.st_mode & 0777U), 0600);
            QCOMPARE(::stat(settings.status.c_str(), &status), 0);
            QCOMPARE(static_cast<int>(status.st_mode & 0777U), 0700);
        }
        QVERIFY(!std::filesystem::exists(socket));
        const auto nobody = liena_({QStringLiteral("monitor"), QStringLiteral("--folder"), text(settings.status)});
        QCOMPARE(nobody.status, 1);
        QVERIFY(nobody.errors.contains(QStringLiteral("no device offers its status")));
    }

    void aDeviceWorksWithoutBeingWatched()
    {
        TestSystem system({reference::cockpit, reference::robot}, {"cockpit robot"});
        auto settings = system.settingsOf("robot");
        std::filesystem::create_directory(settings.status);
        std::filesystem::permissions(settings.status, std::filesystem::perms::all); // anybody could put a socket there
        std::string told;
        settings.log = [&](const LogLine& line) {
            if (line.event == "no-status")
                told = std::string(line.text);
        };
        TestDevice robot(settings);
        TestDevice cockpit(system.settingsOf("cockpit"));
        QVERIFY(cockpit->openChannel(system.idOf("robot")));
        QTRY_VERIFY2(robot.heard(Kind::Opened), robot.story().c_str());
        QVERIFY2(told.find("chmod 700") != std::string::npos, told.c_str());
        QVERIFY(!std::filesystem::exists(statusSocket(settings.status, system.idOf("robot"))));
    }

    void aWatcherThatNeverReadsDisturbsNobody()
    {
        TestSystem system({reference::cockpit, reference::robot}, {"cockpit robot"});
        const auto settings = system.settingsOf("robot");
        TestDevice robot(settings);
        TestDevice cockpit(system.settingsOf("cockpit"));
        std::vector<std::unique_ptr<QProcess>> watchers;
        for (int i = 0; i < 12; ++i) { // more than are let in
            watchers.push_back(std::make_unique<QProcess>());
            watchers.back()->start(QStringLiteral(LIENA_PROGRAM_DIR "/liena"), {QStringLiteral("monitor"), QStringLiteral("--json"),
                                                                                QStringLiteral("--folder"), text(settings.status)});
            QVERIFY(watchers.back()->waitForStarted());
        }
        QVERIFY(cockpit->openChannel(system.idOf("robot")));
        QTRY_VERIFY2(robot.heard(Kind::Opened), robot.story().c_str());
        QTRY_VERIFY(cockpit->links()[0].heartbeatsReceived > 20);
        QVERIFY(!cockpit.heard(Kind::Interrupted) && !robot.heard(Kind::LocalStall));
        for (auto& watcher : watchers) {
            watcher->kill();
            watcher->waitForFinished();
        }
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
        const auto whole = liena_(verify);
        QVERIFY2(whole.status == 0 && whole.output.contains(QStringLiteral("whole, 7 entries, head ")), qPrintable(whole.output));
        const auto head = whole.output.trimmed().right(64);
        QCOMPARE(liena_(verify + QStringList{QStringLiteral("--expect-head"), head}).status, 0);
        const auto foreign = liena_(verify + QStringList{QStringLiteral("--expect-head"), QString(64, QLatin1Char('a'))});
        QCOMPARE(foreign.status, 1);
        QCOMPARE(liena_(verify + QStringList{QStringLiteral("--expect-head"), QStringLiteral("abc")}).status, 2);
        std::ifstream stream(settings.audit);
        std::string content{std::istreambuf_iterator<char>(stream), {}};
        content.replace(content.find("number 2"), 8, "number 8");
        std::ofstream(settings.audit) << content;
        const auto altered = liena_(verify);
        QCOMPARE(altered.status, 1);
        QVERIFY2(altered.output.contains(QStringLiteral("robot.jsonl:4: this line was altered")), qPrintable(altered.output));
        QCOMPARE(liena_({QStringLiteral("audit"), QStringLiteral("verify"), QStringLiteral("/no/such/file")}).status, 1);
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
