// `liena bench` as a biomedical engineer uses it: the three ways, what goes wrong, and that sessions are unharmed.
#include "liena_program.hpp"
#include "test_system.hpp"

#include <QDir>
#include <QFile>
#include <QHostAddress>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QTcpServer>
#include <QTest>

#include <atomic>
#include <latch>

#include <sys/stat.h>

using namespace liena;
using namespace liena::test;
using Kind = SessionEvent::Kind;

namespace {

/// What any line keeps that works at all, under sanitizers and on a busy machine.
constexpr auto patient = "commands 200 /s\nframes 5 /s\nimage 20 KiB\nround-trip-p99 50000 ms 60000 ms\n"
                         "round-trip-beside-images-p99 50000 ms 60000 ms\ncommands-carried 50 % 20 %\nimages-carried 10 % 5 %\n";

struct Stage {
    TestSystem system{{reference::cockpit, reference::robot, reference::arm}, {"cockpit robot", "arm robot"}};
    DeviceId cockpitId = system.idOf("cockpit");
    DeviceId robotId = system.idOf("robot");

    Stage() { write("patient.profile", patient); }

    QString write(const char* name, const QByteArray& content) const
    {
        QFile file(text(system.folder() / name));
        if (!file.open(QIODevice::WriteOnly) || file.write(content) != content.size())
            throw std::runtime_error("cannot write a profile");
        return file.fileName();
    }

    QStringList bench(const QStringList& more, const char* to = "robot", const QString& profile = {})
    {
        const auto own = system.settingsOf("cockpit");
        const bool named = more.contains(QStringLiteral("--seconds"));
        const auto seconds = named ? QStringList() : QStringList{QStringLiteral("--seconds"), QStringLiteral("1")};
        return QStringList{QStringLiteral("bench"),
                           QStringLiteral("--topology"),
                           text(own.topology),
                           QStringLiteral("--from"),
                           QStringLiteral("cockpit"),
                           QStringLiteral("--to"),
                           QString::fromLatin1(to),
                           QStringLiteral("--pki"),
                           text(own.certificate.parent_path()),
                           QStringLiteral("--registry"),
                           text(own.registry.front()),
                           QStringLiteral("--store"),
                           text(system.folder() / "bench-sets"),
                           QStringLiteral("--folder"),
                           text(own.status),
                           QStringLiteral("--profile"),
                           profile.isEmpty() ? text(system.folder() / "patient.profile") : profile} +
               seconds + more;
    }
};

bool harmed(const TestDevice& device)
{
    return device.heard(Kind::Lost) || device.heard(Kind::Interrupted) || device.heard(Kind::StandByBegan);
}

/// Twenty a second, so that both ends are in use.
void commandsTo(DeviceId robot, DistributedSystem& system, std::atomic<int>& sent)
{
    system.every(std::chrono::milliseconds(50), [&system, &sent, robot] {
        auto command = system.command(robot, "GripperCommand");
        sent += command && system.send(robot, std::move(command.value())) ? 1 : 0;
    });
}

QString said(const ToolOutcome& outcome) { return QString::number(outcome.status) + QLatin1Char('\n') + outcome.output + outcome.errors; }

} // namespace

class BenchCommandTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void bothDevicesOnThisComputer()
    {
        Stage stage;
        const auto svg = text(stage.system.folder() / "line.svg");
        const auto found = runLiena(stage.bench({QStringLiteral("--local"), QStringLiteral("--svg"), svg}));
        QVERIFY2(found.status == 0, qPrintable(said(found)));
        QVERIFY2(found.output.startsWith(QStringLiteral("GO: the line from cockpit to robot (both on this computer)")),
                 qPrintable(found.output));
        for (const char* row : {"commands, paced", "commands, back to back", "commands beside images", "packets by UDP", "images at most"})
            QVERIFY2(found.output.contains(QLatin1String(row)), qPrintable(found.output));
        QFile plot(svg);
        QVERIFY(plot.open(QIODevice::ReadOnly));
        QVERIFY(plot.readAll().endsWith("</svg>\n"));
        QCOMPARE(QDir(QDir::tempPath()).entryList({QStringLiteral("liena-bench.*")}, QDir::Dirs).size(), 0);
    }

    void theExitStatusIsTheVerdict()
    {
        Stage stage;
        const auto impossible = stage.write("impossible.profile", "commands 50 /s\nround-trip-p99 0 ms 0 ms\n");
        const auto found = runLiena(stage.bench({QStringLiteral("--local"), QStringLiteral("--json")}, "robot", impossible));
        QVERIFY2(found.status == 4, qPrintable(said(found)));
        const auto json = QJsonDocument::fromJson(found.output.toUtf8()).object();
        QCOMPARE(json["verdict"].toString(), QStringLiteral("NO-GO"));
        QCOMPARE(json["measurement"].toObject()["phases"].toArray().size(), 5);
        const auto unsure = stage.write("unsure.profile", "commands 200 /s\nround-trip-p99 0 ms 60000 ms\n");
        QCOMPARE(runLiena(stage.bench({QStringLiteral("--local")}, "robot", unsure)).status, 3);
    }

    void aRateThatNoLineCarriesIsNoGo()
    {
        Stage stage;
        const auto profile = stage.write("much.profile", "commands 50 /s\nimages-carried 99 % 90 %\n");
        const auto found = runLiena(stage.bench({QStringLiteral("--local"), QStringLiteral("--frames"), QStringLiteral("1000"),
                                                 QStringLiteral("--image"), QStringLiteral("8MiB")}, // 8.4 GB/s
                                                "robot", profile));
        QVERIFY2(found.status == 4, qPrintable(said(found)));
        QVERIFY2(found.output.startsWith(QStringLiteral("NO-GO: ")) && found.output.contains(QStringLiteral("% is less than 90 %")),
                 qPrintable(found.output));
    }

    void inTheDevicesPlace()
    {
        Stage stage;
        TestDevice robot(stage.system.settingsOf("robot"));
        TestDevice arm(stage.system.settingsOf("arm")); // whose session with the robot goes on
        QVERIFY(arm->openChannel(stage.robotId));
        QTRY_COMPARE(words(arm.state(stage.robotId)), words(SessionState::Open));
        for (int times = 1; times <= 2; ++times) { // and again, at once
            const auto found = runLiena(stage.bench({}));
            QVERIFY2(found.status == 0, qPrintable(said(found) + QString::fromStdString(robot.story())));
            QTRY_COMPARE(robot.events(Kind::Closed).size(), static_cast<std::size_t>(times));
        }
        QVERIFY2(!harmed(robot) && !harmed(arm), robot.story().c_str());
        QCOMPARE(words(robot.state(stage.cockpitId)), words(SessionState::Closed));
        QCOMPARE(words(arm.state(stage.robotId)), words(SessionState::Open));
    }

    void inTheDevicesPlaceItTakesATenthOfWhatADeviceInUseCanSpare()
    {
        Stage stage;
        TestDevice robot(stage.system.settingsOf("robot"));
        std::atomic<int> sent = 0;
        TestDevice arm(stage.system.settingsOf("arm"), [&](DistributedSystem& system) { commandsTo(stage.robotId, system, sent); });
        QVERIFY(arm->openChannel(stage.robotId));
        QTRY_VERIFY(!robot.messages("GripperCommand").empty());
        const auto found = runLiena(stage.bench({QStringLiteral("--json")}));
        const auto measurement = QJsonDocument::fromJson(found.output.toUtf8()).object()["measurement"].toObject();
        QVERIFY2(measurement["in_use"].toBool(), qPrintable(said(found)));
        const auto bulk = measurement["limits"].toObject()["bulk_bytes_per_second"].toDouble(-1);
        QVERIFY2(bulk > 0 && bulk <= 250'000, qPrintable(said(found))); // nothing had filled the path before
        QVERIFY2(!harmed(robot) && !harmed(arm), robot.story().c_str());
    }

    void insideALiveSession()
    {
        Stage stage;
        TestDevice robot(stage.system.settingsOf("robot"));
        auto settings = stage.system.settingsOf("cockpit");
        settings.measureOnRequest = true;
        std::atomic<int> sent = 0;
        TestDevice cockpit(settings, [&](DistributedSystem& system) { commandsTo(stage.robotId, system, sent); });
        const auto early = runLiena(stage.bench({QStringLiteral("--live")}));
        QVERIFY2(early.status == 1 && early.errors.contains(QStringLiteral("closed")), qPrintable(said(early)));
        QVERIFY(cockpit->openChannel(stage.robotId));
        QTRY_VERIFY(sent > 2);
        const auto ask = [&](const char* commands) { // 99 % needs 100 of them, and the budget allows as many in a second
            return runLiena(
                stage.bench({QStringLiteral("--live"), QStringLiteral("--commands"), QString::fromLatin1(commands),
                             QStringLiteral("--command-bytes"), QStringLiteral("200"), QStringLiteral("--seconds"), QStringLiteral("2")}));
        };
        const auto slowed = ask("1000");
        QVERIFY2(slowed.status == 3, qPrintable(said(slowed)));
        QVERIFY2(slowed.output.contains(QStringLiteral("measured with 100 commands a second, which is what the budget allows, not 1000")),
                 qPrintable(slowed.output));
        const auto endless = runLiena(stage.bench({QStringLiteral("--live"), QStringLiteral("--seconds"), QStringLiteral("250")}));
        QVERIFY2(endless.status == 1 && endless.errors.contains(QStringLiteral("for at most 120 s at once")) &&
                     endless.errors.contains(QStringLiteral("measure for a shorter time")),
                 qPrintable(said(endless)));
        const auto found = ask("100");
        QVERIFY2(found.status == 0, qPrintable(said(found)));
        QVERIFY2(found.output.contains(QStringLiteral("budget: 200 probes a second, 0.2 MB/s of images")) ||
                     found.output.contains(QStringLiteral("budget: 200 probes a second, 0.1 MB/s of images")), // 20 KiB five times a second
                 qPrintable(found.output));
        QVERIFY2(found.output.contains(QStringLiteral("a device is in use")), qPrintable(found.output));
        const auto commands = static_cast<std::size_t>(sent.load());
        QTRY_VERIFY(robot.messages("GripperCommand").size() >= commands);
        QVERIFY2(!harmed(robot) && !harmed(cockpit), cockpit.story().c_str());
        QCOMPARE(words(cockpit.state(stage.robotId)), words(SessionState::Open));
    }

    void whoLeavesEndsItsMeasurement()
    {
        Stage stage;
        TestDevice robot(stage.system.settingsOf("robot"));
        auto settings = stage.system.settingsOf("cockpit");
        settings.measureOnRequest = true;
        TestDevice cockpit(settings);
        QVERIFY(cockpit->openChannel(stage.robotId));
        QTRY_VERIFY(robot.heard(Kind::Opened));
        QProcess process;
        process.start(lienaProgram, stage.bench({QStringLiteral("--live"), QStringLiteral("--seconds"), QStringLiteral("30")}));
        const auto before = robot->links().front().bytesReceived;
        QTRY_VERIFY_WITH_TIMEOUT(robot->links().front().bytesReceived > before + 20'000, 20000); // it measures
        process.terminate();
        const auto stopped = outcomeOf(process);
        QVERIFY2(stopped.status == 1 && stopped.errors.contains(QStringLiteral("stopped")), qPrintable(said(stopped)));
        const auto again = [&] { return runLiena(stage.bench({QStringLiteral("--live")})).status == 0; };
        QTRY_VERIFY_WITH_TIMEOUT(again(), longestToolRun); // the line is free
        QVERIFY2(!harmed(robot) && !harmed(cockpit), cockpit.story().c_str());
    }

    void aLiveDeviceThatTakesNoRequestsIsNamed()
    {
        Stage stage;
        TestDevice robot(stage.system.settingsOf("robot"));
        const auto none = runLiena(stage.bench({QStringLiteral("--live")}));
        QVERIFY2(none.status == 1 && none.errors.contains(QStringLiteral("cockpit does not run here")), qPrintable(said(none)));
        TestDevice cockpit(stage.system.settingsOf("cockpit"));
        const auto closed = runLiena(stage.bench({QStringLiteral("--live")}));
        QVERIFY2(closed.status == 1 && closed.errors.contains(QStringLiteral("--measure-on-request")), qPrintable(said(closed)));
        const auto taken = runLiena(stage.bench({}));
        QVERIFY2(taken.status == 1 && taken.errors.contains(QStringLiteral("measure with --live")), qPrintable(said(taken)));
    }

    void anOrderToEndClosesInOrder()
    {
        Stage stage;
        TestDevice robot(stage.system.settingsOf("robot"));
        QProcess process;
        process.start(lienaProgram, stage.bench({QStringLiteral("--seconds"), QStringLiteral("60")}));
        QTRY_VERIFY_WITH_TIMEOUT(robot.heard(Kind::Opened), 20000);
        process.terminate();
        const auto stopped = outcomeOf(process);
        QVERIFY2(stopped.status == 1 && stopped.errors.contains(QStringLiteral("stopped")), qPrintable(said(stopped)));
        QTRY_VERIFY2(robot.heard(Kind::Closed), robot.story().c_str());
        QVERIFY2(!harmed(robot), robot.story().c_str());
    }

    void whatCannotBeMeasuredIsSaid()
    {
        Stage stage;
        const auto unreachable = runLiena(stage.bench({}));
        QVERIFY2(unreachable.status == 1 && unreachable.errors.contains(QStringLiteral("no session with robot")),
                 qPrintable(said(unreachable)));
        QVERIFY(unreachable.errors.contains(QStringLiteral("liena probe robot")));
        QVERIFY(runLiena(stage.bench({}, "arm")).errors.contains(QStringLiteral("no link between cockpit and arm")));
        QVERIFY(runLiena(stage.bench({}, "scalpel")).errors.contains(QStringLiteral("scalpel")));
        const auto profile = stage.write("wrong.profile", "loss 0.1 %\n");
        const auto wrong = runLiena(stage.bench({}, "robot", profile));
        QVERIFY2(wrong.status == 1 && wrong.errors.contains(QStringLiteral("wrong.profile:1: write `loss")), qPrintable(said(wrong)));
        QVERIFY(runLiena(stage.bench({}, "robot", QStringLiteral("brain-surgery")))
                    .errors.contains(QStringLiteral("no profile brain-surgery")));
        QCOMPARE(runLiena({QStringLiteral("bench")}).status, 2);
        QCOMPARE(runLiena(stage.bench({QStringLiteral("--live"), QStringLiteral("--local")})).status, 2);
        QCOMPARE(runLiena(stage.bench({QStringLiteral("--image"), QStringLiteral("9MiB")})).status, 2);
        QFile(text(stage.system.topology())).remove();
        QCOMPARE(runLiena(stage.bench({})).status, 1);
    }

    /// What a site's programs are started with, so that the same class of the network is measured.
    void takesWhatADeviceTakesOfMarksAndThread()
    {
        Stage stage;
        TestDevice robot(stage.system.settingsOf("robot"));
        const auto marked = runLiena(stage.bench({QStringLiteral("--mark-commands"), QStringLiteral("0"), QStringLiteral("--mark-images"),
                                                  QStringLiteral("8"), QStringLiteral("--sleep-in-dialogues")}));
        QVERIFY2(marked.status == 0, qPrintable(said(marked)));
        const auto nowhere = runLiena(stage.bench({QStringLiteral("--processors"), QStringLiteral("4095")}));
        QVERIFY2(nowhere.status == 1 && nowhere.errors.contains(QStringLiteral("4095")), qPrintable(said(nowhere)));
        QCOMPARE(runLiena(stage.bench({QStringLiteral("--mark-images"), QStringLiteral("64")})).status, 2);
        for (const auto& way : {QStringLiteral("--live"), QStringLiteral("--local")})
            for (const auto& option :
                 {QStringList{QStringLiteral("--mark-commands"), QStringLiteral("0")},
                  QStringList{QStringLiteral("--realtime-priority"), QStringLiteral("50")}, QStringList{QStringLiteral("--lock-memory")}}) {
                const auto refused = runLiena(stage.bench(QStringList{way} + option));
                QVERIFY2(refused.status == 2 && refused.errors.contains(option.front() + QStringLiteral(": not with ") + way),
                         qPrintable(said(refused)));
            }
    }

    void aHostThatSaysNothingIsNamed()
    {
        Stage stage;
        QTcpServer mute;
        QVERIFY(mute.listen(QHostAddress::LocalHost, stage.system.portOf("robot")));
        const auto found = runLiena(stage.bench({}));
        QVERIFY2(found.status == 1 && found.errors.contains(QStringLiteral("no session with robot")), qPrintable(said(found)));
        QVERIFY2(found.errors.contains(QStringLiteral("liena probe robot")), qPrintable(said(found)));
    }

    void aPeerThatFallsSilentEndsTheMeasurement()
    {
        Stage stage;
        TestDevice robot(stage.system.settingsOf("robot"));
        QProcess process;
        process.start(lienaProgram, stage.bench({QStringLiteral("--seconds"), QStringLiteral("60")}));
        QTRY_VERIFY_WITH_TIMEOUT(robot.heard(Kind::Opened), 20000);
        const auto before = robot->links().front().bytesReceived;
        QTRY_VERIFY_WITH_TIMEOUT(robot->links().front().bytesReceived > before + 20'000, 20000); // it measures
        std::latch told(1);
        robot->post([&] { told.wait(); });
        const auto broken = outcomeOf(process);
        told.count_down();
        QVERIFY2(broken.status == 1 && broken.errors.contains(QStringLiteral("was interrupted, lost or closed")), qPrintable(said(broken)));
        QVERIFY2(broken.output.isEmpty(), qPrintable(broken.output));
    }

    void aRefusedMeasurementIsSaid()
    {
        Stage stage;
        auto settings = stage.system.settingsOf("robot");
        settings.measuring.allowed = false;
        TestDevice robot(settings);
        const auto refused = runLiena(stage.bench({}));
        QVERIFY2(refused.status == 1 && refused.errors.contains(QStringLiteral("robot refuses to be measured")), qPrintable(said(refused)));
        QTRY_VERIFY(robot.heard(Kind::Closed));
        QVERIFY(!harmed(robot));
    }

    /// The figures are there before the plot waits for its reader, and who does not want to wait ends it.
    void aPlotThatNobodyReadsHoldsNothingBack()
    {
        Stage stage;
        const auto pipe = text(stage.system.folder() / "line.svg");
        QCOMPARE(::mkfifo(pipe.toLocal8Bit().constData(), 0600), 0);
        QProcess process;
        process.start(lienaProgram, stage.bench({QStringLiteral("--local"), QStringLiteral("--svg"), pipe}));
        QByteArray output;
        const auto isReported = [&] { return (output += process.readAllStandardOutput()).contains("CARRIED"); };
        QTRY_VERIFY2_WITH_TIMEOUT(isReported(), output.constData(), longestToolRun);
        QVERIFY2(output.startsWith("GO: "), output.constData());
        QCOMPARE(process.state(), QProcess::Running);
        process.terminate();
        QVERIFY(process.waitForFinished(longestToolRun));
        QCOMPARE(process.exitStatus(), QProcess::CrashExit); // by the signal
    }

    void aFullDiskForTheReportIsSaid()
    {
        Stage stage;
        QProcess process;
        process.setStandardOutputFile(QStringLiteral("/dev/full"));
        process.start(lienaProgram, stage.bench({QStringLiteral("--local"), QStringLiteral("--json")}));
        const auto full = outcomeOf(process);
        QVERIFY2(full.status == 1 && full.errors.contains(QStringLiteral("make room on the disk")), qPrintable(said(full)));
        const auto plot = runLiena(stage.bench({QStringLiteral("--local"), QStringLiteral("--svg"), QStringLiteral("/dev/full")}));
        QVERIFY2(plot.status == 1 && plot.errors.contains(QStringLiteral("/dev/full was not written")), qPrintable(said(plot)));
        QVERIFY(plot.output.startsWith(QStringLiteral("GO: "))); // the figures are not lost with it
        const auto nowhere =
            runLiena(stage.bench({QStringLiteral("--local"), QStringLiteral("--svg"), QStringLiteral("/no/such/place/line.svg")}));
        QVERIFY2(nowhere.status == 1 && nowhere.errors.contains(QStringLiteral("/no/such/place/line.svg was not written")),
                 qPrintable(said(nowhere)));
        QVERIFY(nowhere.output.isEmpty()); // it was not measured first
    }
};

QTEST_GUILESS_MAIN(BenchCommandTest)
#include "bench_command_test.moc"
