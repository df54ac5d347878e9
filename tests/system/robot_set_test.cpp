// A robot whose message set is another than the programs know: the robot does not start, and the console says why it cannot be moved.
#include "link/motion_streamer.hpp"
#include "link/system_link.hpp"
#include "robot_device.hpp"
#include "test_system.hpp"

#include "liena/known_sets.hpp"

#include <QByteArray>
#include <QFile>
#include <QTest>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>

using namespace liena;
using namespace liena::test;
using Kind = SessionEvent::Kind;

namespace {

constexpr auto otherSet =
    R"(<message-set xmlns="urn:liena:message-set:1" name="desk" version="1.0" class="brain" manufacturer="9" type="1"
             device-version="1" vendor="Test" title="Reports what the robot has as a command">
  <message number="0x0201" name="MotionCommand" role="report" priority="status" title="No command">
    <field name="permit" type="uint32" title="Any"/>
    <field name="sequence" type="uint32" title="Any"/>
    <field name="engaged" type="bool" title="Any"/>
    <field name="guidewire_velocity" type="float32" title="Any"/>
    <field name="guidewire_rotation" type="float32" title="Any"/>
    <field name="catheter_velocity" type="float32" title="Any"/>
    <field name="catheter_rotation" type="float32" title="Any"/>
  </message>
</message-set>
)";
const DeviceSpec desk{"desk", "0x40048208", "desk"};

void write(const std::filesystem::path& file, const QByteArray& text)
{
    QFile out(QString::fromStdString(file.string()));
    if (!out.open(QIODevice::WriteOnly) || out.write(text) != text.size())
        throw std::runtime_error("cannot write " + file.string());
}

/// The register, with `to` for `from` in the robot's set, and the desk's set in it.
std::filesystem::path registry(const TestSystem& system, const QByteArray& from, const QByteArray& to)
{
    const auto folder = system.folder() / "changed";
    std::filesystem::copy(std::filesystem::path(LIENA_SOURCE_DIR) / "resources" / "devices", folder);
    write(folder / "desk.xml", otherSet);
    QFile robot(QString::fromStdString((folder / "vascular-robot.xml").string()));
    auto xml = robot.open(QIODevice::ReadOnly) ? robot.readAll() : QByteArray();
    robot.close();
    if (!xml.contains(from))
        throw std::runtime_error("the robot's set has no " + from.toStdString());
    write(folder / "vascular-robot.xml", xml.replace(from, to));
    return folder;
}

std::filesystem::path withoutSequence(const TestSystem& system)
{
    return registry(system, "name=\"sequence\" type", "name=\"number\" type");
}

class NoPictures : public console::FrameSink {
public:
    void showFrame(std::shared_ptr<const console::XrayFrame> /*frame*/) override {}
};

console::LinkSettings linkSettings(TestSystem& system, const std::filesystem::path& sets)
{
    const auto text = [](const std::filesystem::path& path) { return QString::fromStdString(path.string()); };
    const auto own = system.settingsOf("cockpit");
    console::LinkSettings settings;
    settings.topology = text(own.topology);
    settings.device = QStringLiteral("cockpit");
    settings.registry = {text(sets)};
    settings.store = text(own.store);
    settings.certificate = text(own.certificate);
    settings.key = text(own.key);
    settings.authority = text(own.authority);
    return settings;
}

bool says(const console::ConsoleModels& models, const QString& words)
{
    const auto& lines = models.log.lines();
    return std::any_of(lines.begin(), lines.end(), [&](const console::LogLine& line) { return line.text.contains(words); });
}

/// No motion, and the lease is kept.
console::MotionSnapshot neutral()
{
    console::MotionSnapshot snapshot;
    snapshot.stream = console::MotionStream::Zero;
    snapshot.permit = 5;
    return snapshot;
}

} // namespace

class RobotSetTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void aRobotDoesNotStartWithASetThatLacksAField()
    {
        TestSystem system({reference::cockpit, reference::robot}, {"cockpit robot"});
        auto settings = system.settingsOf("robot");
        settings.registry = {withoutSequence(system)};
        const auto own = DistributedSystem::create(settings);
        QVERIFY2(own, own ? "" : own.error().what.c_str());
        const auto robot = devices::RobotDevice::create(*own.value(), devices::VesselTree::cerebral(), {}, settings.log);
        QVERIFY(!robot);
        QVERIFY2(robot.error().what.find("MotionCommand of message set vascular-robot") != std::string::npos &&
                     robot.error().what.find("has no field sequence") != std::string::npos,
                 robot.error().what.c_str());
    }

    /// The library guards commands, and a report is none, whatever its name.
    void aReportThatIsNamedLikeACommandIsNotTakenForIt()
    {
        TestSystem system({reference::cockpit, reference::robot, desk}, {"robot cockpit", "robot desk"});
        const auto sets = registry(system, "title=\"Interventional", "title=\"Interventional"); // as it is
        const auto settingsOf = [&](const char* name) {
            auto settings = system.settingsOf(name);
            settings.registry = {sets};
            return settings;
        };
        std::atomic<int> commands = 0;
        TestDevice robot(settingsOf("robot"),
                         [&](DistributedSystem& own) { own.subscribe("MotionCommand", [&](const Message&) { ++commands; }).value(); });
        TestDevice cockpit(settingsOf("cockpit"));
        TestDevice other(settingsOf("desk"));
        for (const auto& peer : {&cockpit, &other}) {
            QVERIFY((*peer)->openChannel(system.idOf("robot")));
            QTRY_VERIFY2(peer->heard(Kind::Opened), peer->story().c_str());
        }
        QCOMPARE(other->publish(other->report("MotionCommand").value()), std::size_t{1});
        QTRY_COMPARE(robot.messages("MotionCommand").size(), std::size_t{1}); // as what it is, by whoever looks into the cache
        QCOMPARE(commands.load(), 0);
        const auto sent = [&] { // until one is heard: a slow computer makes one too old
            return cockpit->send(system.idOf("robot"), cockpit->command(system.idOf("robot"), "MotionCommand").value()).has_value();
        };
        QTRY_VERIFY(sent() && commands.load() > 0);
    }

    void theConsoleSaysThatARobotCannotBeMoved()
    {
        TestSystem system({reference::cockpit, reference::robot}, {"cockpit robot"});
        console::ConsoleModels models;
        NoPictures sink;
        QString error;
        const auto link = console::SystemLink::create(linkSettings(system, withoutSequence(system)), models, sink, &error);
        QVERIFY2(link, qPrintable(error));
        link->start();
        QTRY_VERIFY(says(models, QStringLiteral("cannot be moved from here")));
        QVERIFY(says(models, QStringLiteral("has no field sequence")));
        QVERIFY(models.sessions.linkTo(system.idOf("robot").value())->commandsDiffer); // it cannot be armed either
    }

    void aConsoleSaysNothingOfARobotThatItKnows()
    {
        TestSystem system({reference::cockpit, reference::robot}, {"cockpit robot"});
        console::ConsoleModels models;
        NoPictures sink;
        QString error;
        const auto sets = system.registry();
        const auto link = console::SystemLink::create(linkSettings(system, sets), models, sink, &error);
        QVERIFY2(link, qPrintable(error));
        link->start();
        const auto robot = system.idOf("robot").value();
        QTRY_VERIFY(models.sessions.linkTo(robot) != nullptr &&
                    models.sessions.linkTo(robot)->carried.has_value()); // its set was looked at
        QVERIFY(!says(models, QStringLiteral("cannot be moved from here")));
        QVERIFY(!models.sessions.linkTo(robot)->commandsDiffer);
    }

    void motionForARobotThatDoesNotFitIsRefused()
    {
        TestSystem system({reference::cockpit, reference::robot}, {"cockpit robot"});
        auto settings = system.settingsOf("cockpit");
        settings.registry = {withoutSequence(system)};
        const auto own = DistributedSystem::create(settings);
        QVERIFY2(own, own ? "" : own.error().what.c_str());
        console::MotionStreamer streamer(*own.value(), system.idOf("robot"));
        streamer.publish(neutral());
        streamer.run();
        streamer.run();
        QCOMPARE(streamer.refused(), quint64{2});
        QCOMPARE(streamer.sent(), quint64{0});
    }

    /// A robot that was updated is moved without a restart of the console.
    void motionFollowsTheSetThatARobotHasNow()
    {
        TestSystem system({reference::cockpit, reference::robot}, {"cockpit robot"});
        const auto robotId = system.idOf("robot");
        const auto cockpitId = system.idOf("cockpit");
        std::unique_ptr<console::MotionStreamer> streamer; // outlives the cockpit's run
        TestDevice cockpit(system.settingsOf("cockpit"), [&](DistributedSystem& own) {
            streamer = std::make_unique<console::MotionStreamer>(own, robotId);
            streamer->publish(neutral());
            own.every(console::MotionStreamer::period, [&] { streamer->run(); });
        });
        const auto hears = [&](TestDevice& robot) {
            return cockpit->openChannel(robotId) && QTest::qWaitFor([&] { return !robot.messages("MotionCommand").empty(); }, 20000);
        };
        {
            TestDevice robot(system.settingsOf("robot"));
            QVERIFY2(hears(robot), cockpit.story().c_str());
            QVERIFY(cockpit->closeChannel(robotId, "for an update"));
            QTRY_VERIFY2(cockpit.state(robotId) == SessionState::Closed && robot.state(cockpitId) == SessionState::Closed,
                         cockpit.story().c_str());
        }
        auto settings = system.settingsOf("robot");
        settings.registry = {registry(system, "vendor=\"Medsight\"", "vendor=\"Other\"")};
        const auto updated = MessageSet::load(settings.registry.front() / "vascular-robot.xml").value();
        QVERIFY(acceptSet(system.settingsOf("cockpit").store, *updated));
        TestDevice robot(settings);
        QVERIFY2(hears(robot), cockpit.story().c_str());
    }
};

QTEST_GUILESS_MAIN(RobotSetTest)
#include "robot_set_test.moc"
