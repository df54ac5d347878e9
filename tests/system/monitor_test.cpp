// `liena monitor` as a person uses it, beside devices that run and one that has fallen silent.
#include "liena_program.hpp"
#include "test_system.hpp"

#include "liena/status.hpp"

#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QTest>

#include <optional>

#include <fcntl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

using namespace liena;
using namespace liena::test;
using Kind = SessionEvent::Kind;

namespace {

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

/// `liena monitor` that repaints its page, as in a person's terminal, until this ends.
class LivePage {
public:
    LivePage(const std::filesystem::path& folder, const QStringList& names)
    {
        m_monitor.setStandardOutputFile(m_terminal.name());
        m_monitor.start(lienaProgram, QStringList{QStringLiteral("monitor"), QStringLiteral("--folder"), text(folder)} + names);
    }
    ~LivePage()
    {
        m_monitor.kill();
        m_monitor.waitForFinished();
    }
    Q_DISABLE_COPY_MOVE(LivePage)

    QByteArray screen() { return m_terminal.screen(); }

private:
    Terminal m_terminal;
    QProcess m_monitor;
};

} // namespace

class MonitorTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
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
        const auto lines = runLiena(monitor + QStringList{QStringLiteral("--json"), QStringLiteral("--once")});
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
        const auto page = runLiena(monitor + QStringList{QStringLiteral("--once"), QStringLiteral("robot")});
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
        const auto all = runLiena(monitor);
        QCOMPARE(all.status, 0);
        QVERIFY2(all.output.contains(QStringLiteral("robot (0x00008208)")), qPrintable(all.output));
        QVERIFY2(all.output.contains(QStringLiteral("0x60008208  SAYS NOTHING for ")), qPrintable(all.output));
        QVERIFY2(all.output.contains(QStringLiteral("0x20010208  SAYS NOTHING for ")), qPrintable(all.output));
        const auto one = runLiena(monitor + QStringList{QStringLiteral("0x00008208"), QStringLiteral("--json")});
        QCOMPARE(one.status, 0);
        QCOMPARE(one.errors, QString()); // nobody asked for the others
        QVERIFY2(!QJsonDocument::fromJson(one.output.toUtf8()).isNull(), qPrintable(one.output));
        const auto none = runLiena(monitor + QStringList{QStringLiteral("0x60008208"), QStringLiteral("--json")});
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
        LivePage page(folder, {});
        device.say(R"({"device":"robot","id":"0x00008208","links":[{"peer":"cockpit","state":"open"}]})");
        QTRY_VERIFY2(page.screen().contains("cockpit       open"), page.screen().constData());
        QTRY_VERIFY2(page.screen().contains("robot (0x00008208)  SAYS NOTHING for "), page.screen().constData());
        QVERIFY2(!page.screen().contains("cockpit       open"), page.screen().constData());
    }

    /// The robot is the only one: with it everything that is watched goes.
    void theMonitorGoesOnWhenItsDeviceRestarts()
    {
        TestSystem system({reference::cockpit, reference::robot}, {"cockpit robot"});
        const auto settings = system.settingsOf("robot");
        std::optional<TestDevice> robot(std::in_place, settings);
        QProcess monitor;
        monitor.start(lienaProgram,
                      {QStringLiteral("monitor"), QStringLiteral("--json"), QStringLiteral("--folder"), text(settings.status)});
        QByteArray lines;
        QByteArray errors;
        const auto heard = [&](const QByteArray& in, const char* part) {
            lines += monitor.readAllStandardOutput();
            errors += monitor.readAllStandardError();
            return in.count(part);
        };
        QTRY_VERIFY_WITH_TIMEOUT(heard(lines, "\"software\":") > 0, 20000);
        robot.reset();
        QTRY_VERIFY_WITH_TIMEOUT(heard(errors, "robot (0x00008208)  HAS GONE") > 0, 20000);
        lines.clear();
        robot.emplace(settings);
        QTRY_VERIFY_WITH_TIMEOUT(heard(lines, "\"software\":") > 1, 20000); // one may be from before
        QCOMPARE(errors.count("HAS GONE"), 1);                              // while it was away, too
        QCOMPARE(monitor.state(), QProcess::Running);
        monitor.kill();
        QVERIFY(monitor.waitForFinished());
    }

    void theLivePageShowsWhoHasGone()
    {
        TestSystem system({reference::cockpit, reference::robot}, {"cockpit robot"});
        const auto settings = system.settingsOf("robot");
        std::optional<TestDevice> robot(std::in_place, settings);
        Terminal terminal;
        QProcess monitor;
        monitor.setStandardOutputFile(terminal.name());
        monitor.start(lienaProgram, {QStringLiteral("monitor"), QStringLiteral("--folder"), text(settings.status)});
        QTRY_VERIFY2(terminal.screen().contains("cockpit       closed"), terminal.screen().constData());
        robot.reset();
        QTRY_VERIFY2(terminal.screen().contains("robot (0x00008208)  HAS GONE"), terminal.screen().constData());
        QVERIFY2(!terminal.screen().contains("cockpit       closed"), terminal.screen().constData());
        robot.emplace(settings);
        QTRY_VERIFY2(terminal.screen().contains("cockpit       closed"), terminal.screen().constData());
        QVERIFY2(!terminal.screen().contains("HAS GONE"), terminal.screen().constData());
        monitor.kill();
        QVERIFY(monitor.waitForFinished());
    }

    void aLogThatIsNotWrittenEndsTheMonitor()
    {
        TestSystem system({reference::cockpit, reference::robot}, {"cockpit robot"});
        const auto settings = system.settingsOf("robot");
        TestDevice robot(settings);
        QProcess monitor;
        monitor.setStandardOutputFile(QStringLiteral("/dev/full"));
        monitor.start(lienaProgram,
                      {QStringLiteral("monitor"), QStringLiteral("--json"), QStringLiteral("--folder"), text(settings.status)});
        const auto full = outcomeOf(monitor); // without --once
        QCOMPARE(full.status, 1);
        QVERIFY2(full.errors.contains(QStringLiteral("liena monitor: the report was not written: ")), qPrintable(full.errors));
        QVERIFY2(full.errors.contains(QStringLiteral("make room on the disk")), qPrintable(full.errors));
    }

    void theMonitorSaysThatNobodyHasAName()
    {
        TestSystem system({reference::cockpit, reference::robot}, {"cockpit robot"});
        const auto settings = system.settingsOf("robot");
        TestDevice robot(settings);
        TestDevice cockpit(system.settingsOf("cockpit"));
        const QStringList monitor{QStringLiteral("monitor"), QStringLiteral("--once"), QStringLiteral("--folder"), text(settings.status)};
        const auto said = QStringLiteral("no device 'robto' offers its status in ") + text(settings.status) +
                          QStringLiteral("; there are robot, cockpit\n"); // in the order of their ids
        const auto nobody = runLiena(monitor + QStringList{QStringLiteral("robto")});
        QCOMPARE(nobody.status, 1);
        QCOMPARE(nobody.output, QString());
        QCOMPARE(nobody.errors, said);
        const auto one = runLiena(monitor + QStringList{QStringLiteral("robot"), QStringLiteral("robto")});
        QCOMPARE(one.status, 0);
        QVERIFY2(one.output.contains(QStringLiteral("robot (0x00008208)")), qPrintable(one.output));
        QCOMPARE(one.errors, said);
    }

    void theLivePageSaysThatNobodyHasAName()
    {
        TestSystem system({reference::cockpit, reference::robot}, {"cockpit robot"});
        const auto folder = system.settingsOf("robot").status;
        std::filesystem::create_directory(folder);
        const StatusSocket device(statusSocket(folder, DeviceId(0x00008208)), 8);
        LivePage page(folder, {QStringLiteral("robto")});
        device.say(R"({"device":"robot","id":"0x00008208","links":[]})");
        QTRY_VERIFY2(page.screen().contains("no device 'robto' offers its status in "), page.screen().constData());
        QVERIFY2(page.screen().contains("; there is robot"), page.screen().constData());
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
        const auto nobody = runLiena({QStringLiteral("monitor"), QStringLiteral("--folder"), text(settings.status)});
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
            watchers.back()->start(
                lienaProgram, {QStringLiteral("monitor"), QStringLiteral("--json"), QStringLiteral("--folder"), text(settings.status)});
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
};

QTEST_GUILESS_MAIN(MonitorTest)
#include "monitor_test.moc"
