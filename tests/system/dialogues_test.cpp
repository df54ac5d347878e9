// The dialogues between two and three devices in one process: open, exchange, close, refuse, learn.
#include "test_system.hpp"

#include "liena/known_sets.hpp"

#include <QTest>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <semaphore>

#include <fcntl.h>

using namespace liena;
using namespace liena::test;
using Kind = SessionEvent::Kind;

namespace {

Message motion(DistributedSystem& system, DeviceId robot, std::uint32_t sequence)
{
    auto message = system.command(robot, "MotionCommand").value();
    message.set("sequence", sequence).set("engaged", true).set("guidewire_velocity", 2.5);
    return message;
}

} // namespace

class DialoguesTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void opensWithinASecondAndCarriesMessagesBothWays_data()
    {
        QTest::addColumn<QString>("mode");
        QTest::newRow("tls") << "tls";
        QTest::newRow("none") << "none";
    }
    void opensWithinASecondAndCarriesMessagesBothWays()
    {
        QFETCH(QString, mode);
        TestSystem system({reference::cockpit, reference::robot}, {"cockpit robot"}, {mode.toStdString()});
        const auto robotId = system.idOf("robot");
        const auto cockpitId = system.idOf("cockpit");
        TestDevice robot(system.settingsOf("robot"));
        TestDevice cockpit(system.settingsOf("cockpit"));
        QVERIFY(cockpit->openChannel(robotId));
        QTRY_VERIFY2(cockpit.heard(Kind::Opened, robotId), cockpit.story().c_str());
        QTRY_VERIFY2(robot.heard(Kind::Opened, cockpitId), robot.story().c_str());
        QCOMPARE(words(cockpit.state(robotId)), words(SessionState::Open));

        // A stream, as a hand's is: one command alone may be too old when a busy computer comes to it.
        std::vector<Message> received;
        const auto arrives = [&] {
            return !(received = robot.messages("MotionCommand")).empty() ||
                   ((void)cockpit->send(robotId, motion(*cockpit, robotId, 7)), false);
        };
        QTRY_VERIFY2(arrives(), (cockpit.story() + robot.story()).c_str());
        QCOMPARE(received[0].get<std::uint32_t>("sequence"), 7U);
        QCOMPARE(received[0].get<float>("guidewire_velocity"), 2.5F);
        QCOMPARE(received[0].origin(), cockpitId);

        auto status = robot->report("RobotStatus").value();
        status.set("state", "Ready").set("permit", 3U);
        QCOMPARE(robot->publish(status), std::size_t{1});
        QTRY_VERIFY(!(received = cockpit.messages("RobotStatus")).empty());
        QCOMPARE(received[0].get<std::string>("state"), std::string("Ready"));
    }

    /// A program that the application starts must not hold its port and its connections beyond its end.
    void programsThatTheApplicationStartsGetNoSocket()
    {
        TestSystem system({reference::cockpit, reference::robot}, {"cockpit robot"});
        auto settings = system.settingsOf("cockpit");
        settings.status = system.folder();
        TestDevice robot(system.settingsOf("robot"));
        TestDevice cockpit(settings);
        QVERIFY(cockpit->openChannel(system.idOf("robot")));
        QTRY_VERIFY2(cockpit.heard(Kind::Opened), cockpit.story().c_str());
        int sockets = 0;
        for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) {
            std::error_code gone;
            const auto what = std::filesystem::read_symlink(entry.path(), gone).string();
            if (gone || what.rfind("socket:", 0) != 0)
                continue;
            ++sockets;
            const int flags = ::fcntl(std::stoi(entry.path().filename().string()), F_GETFD);
            QVERIFY2((flags & FD_CLOEXEC) != 0, what.c_str());
        }
        QVERIFY2(sockets >= 9, qPrintable(QString::number(sockets))); // each: listening, UDP, two connections; and the status
    }

    void carriesImagesOnTheirOwnLane()
    {
        TestSystem system({reference::cockpit, reference::xray}, {"cockpit xray"});
        TestDevice xray(system.settingsOf("xray"));
        TestDevice cockpit(system.settingsOf("cockpit"));
        const auto xrayId = system.idOf("xray");
        QVERIFY(cockpit->openChannel(xrayId));
        QTRY_VERIFY2(xray.heard(Kind::Opened), xray.story().c_str());
        std::vector<std::byte> pixels(1024 * 1024 * 2);
        for (std::size_t i = 0; i < pixels.size(); ++i)
            pixels[i] = static_cast<std::byte>(i * 31 >> 3U);
        auto frame = xray->report("XrayFrame").value();
        frame.set("frame", 1U)
            .set("rows", 1024U)
            .set("columns", 1024U)
            .set("bits_stored", 16U)
            .set("pixels", std::span<const std::byte>(pixels));
        QVERIFY(xray->send(system.idOf("cockpit"), frame));
        std::vector<Message> received;
        QTRY_VERIFY2(!(received = cockpit.messages("XrayFrame")).empty(), (cockpit.story() + xray.story()).c_str());
        const auto arrived = received[0].get<std::span<const std::byte>>("pixels");
        QVERIFY(std::equal(arrived.begin(), arrived.end(), pixels.begin(), pixels.end()));
    }

    /// The handler runs while the queue from which the picture fell has work in hand.
    void aHandlerMaySendWhenItHearsThatSomethingDidNotLeave()
    {
        TestSystem system({reference::cockpit, reference::xray}, {"cockpit xray"},
                          {"tls", R"(heartbeat="20ms" suspect="2s" lost="3s" reconnect="3500ms")"});
        const auto cockpitId = system.idOf("cockpit");
        std::atomic<std::uint32_t> again{0};
        const auto pixels = std::make_shared<const std::vector<std::byte>>(std::size_t{4} << 20U);
        const auto picture = [&pixels](DistributedSystem& from, std::uint32_t number) {
            auto frame = from.report("XrayFrame").value();
            frame.set("frame", number).set("rows", 2048U).set("columns", 2048U).set("bits_stored", 8U);
            frame.lend("pixels", pixels, *pixels);
            return frame;
        };
        constexpr std::uint32_t repeats = 1000; // number of the first that a handler sent
        TestDevice xray(system.settingsOf("xray"), [&](DistributedSystem& self) {
            self.subscribe([&](const SessionEvent& event) {
                if (event.kind == Kind::SendFailed && again < 20)
                    (void)self.send(cockpitId, picture(self, repeats + again++));
            });
        });
        TestDevice cockpit(system.settingsOf("cockpit"));
        QVERIFY(cockpit->openChannel(system.idOf("xray")));
        QTRY_VERIFY2(xray.heard(Kind::Opened), xray.story().c_str());
        // The reader stands for longer than a picture's lifespan of half a second: what does not fit on the way expires.
        std::binary_semaphore goOn{0};
        cockpit->post([&goOn] { (void)goOn.try_acquire_for(std::chrono::seconds(1)); });
        for (std::uint32_t i = 0; i < 8; ++i)
            QVERIFY(xray->send(cockpitId, picture(*xray, i)));
        QTRY_VERIFY2(again > 0, xray.story().c_str());
        goOn.release();
        const auto arrived = [&] {
            for (const auto& frame : cockpit.messages("XrayFrame"))
                if (frame.get<std::uint32_t>("frame") >= repeats)
                    return true;
            return false;
        };
        QTRY_VERIFY2(arrived(), (cockpit.story() + xray.story()).c_str());
        QVERIFY2(!xray.heard(Kind::Lost), xray.story().c_str());
    }

    void bothMayOpenAtOnce()
    {
        TestSystem system({reference::cockpit, reference::robot}, {"cockpit robot"});
        TestDevice robot(system.settingsOf("robot"));
        TestDevice cockpit(system.settingsOf("cockpit"));
        QVERIFY(cockpit->openChannel(system.idOf("robot")));
        QVERIFY(robot->openChannel(system.idOf("cockpit")));
        QTRY_COMPARE(words(cockpit.state(system.idOf("robot"))), words(SessionState::Open));
        QTRY_COMPARE(words(robot.state(system.idOf("cockpit"))), words(SessionState::Open));
        QVERIFY2(cockpit.events(Kind::Opened).size() == 1, cockpit.story().c_str());
        QVERIFY2(robot.events(Kind::Opened).size() == 1, robot.story().c_str());
    }

    void closesInOrderWithoutAnIncident()
    {
        TestSystem system({reference::cockpit, reference::robot}, {"cockpit robot"});
        TestDevice robot(system.settingsOf("robot"));
        TestDevice cockpit(system.settingsOf("cockpit"));
        QVERIFY(cockpit->openChannel(system.idOf("robot")));
        QTRY_VERIFY(robot.heard(Kind::Opened));
        QVERIFY(cockpit->closeChannel(system.idOf("robot"), "done for today"));
        QTRY_VERIFY2(cockpit.heard(Kind::Closed), cockpit.story().c_str());
        QTRY_VERIFY2(robot.heard(Kind::Closed), robot.story().c_str());
        QVERIFY(robot.events(Kind::Closed)[0].detail.find("done for today") != std::string::npos);
        QVERIFY(cockpit->incidents().empty());
        QVERIFY(robot->incidents().empty());
        QVERIFY(cockpit->openChannel(system.idOf("robot")));
        QTRY_COMPARE(cockpit.events(Kind::Opened).size(), std::size_t{2});
    }

    void stoppingADeviceClosesItsSessions()
    {
        TestSystem system({reference::cockpit, reference::robot}, {"cockpit robot"});
        TestDevice cockpit(system.settingsOf("cockpit"));
        {
            TestDevice robot(system.settingsOf("robot"));
            QVERIFY(cockpit->openChannel(system.idOf("robot")));
            QTRY_VERIFY(robot.heard(Kind::Opened));
        }
        QTRY_VERIFY2(cockpit.heard(Kind::Closed), cockpit.story().c_str());
        QVERIFY(cockpit->incidents().empty());
    }

    void saysWhyNobodyAnswers()
    {
        TestSystem system({reference::cockpit, reference::robot}, {"cockpit robot"});
        TestDevice cockpit(system.settingsOf("cockpit"));
        QVERIFY(cockpit->openChannel(system.idOf("robot")));
        QTRY_VERIFY(cockpit.heard(Kind::OpenFailed));
        QCOMPARE(words(cockpit.events(Kind::OpenFailed)[0].diagnosis.probe), words(ProbeResult::ConnectionRefused));
        QCOMPARE(words(cockpit.state(system.idOf("robot"))), words(SessionState::Closed));
    }

    void refusesAnotherTopology()
    {
        TestSystem system({reference::cockpit, reference::robot}, {"cockpit robot"});
        auto settings = system.settingsOf("robot");
        const auto other = system.folder() / "other.xml";
        std::filesystem::copy_file(system.topology(), other);
        {
            std::ofstream file(other, std::ios::app);
            file << "<!-- another copy -->\n";
        }
        settings.topology = other;
        TestDevice robot(settings);
        TestDevice cockpit(system.settingsOf("cockpit"));
        QVERIFY(cockpit->openChannel(system.idOf("robot")));
        QTRY_VERIFY2(cockpit.heard(Kind::OpenFailed), cockpit.story().c_str());
        QCOMPARE(words(cockpit.events(Kind::OpenFailed)[0].reason), words(RejectReason::TopologyMismatch));
    }

    void saysThatItsTopologyHasNoLink()
    {
        TestSystem system({reference::cockpit, reference::robot, reference::arm}, {"cockpit robot", "cockpit arm"});
        std::ifstream whole(system.topology());
        std::string xml{std::istreambuf_iterator<char>(whole), {}};
        const std::string link = "<link between=\"cockpit robot\"/>";
        xml.erase(xml.find(link), link.size());
        auto settings = system.settingsOf("robot");
        settings.topology = system.folder() / "without.xml";
        std::ofstream(settings.topology) << xml;
        TestDevice robot(settings);
        TestDevice cockpit(system.settingsOf("cockpit"));
        QVERIFY(cockpit->openChannel(system.idOf("robot")));
        QTRY_VERIFY2(cockpit.heard(Kind::OpenFailed), cockpit.story().c_str());
        QCOMPARE(words(cockpit.events(Kind::OpenFailed)[0].reason), words(RejectReason::NoLink));
        QTRY_VERIFY(robot.heard(Kind::IdentityRefused));
    }

    void refusesADeviceWithAnothersCertificate()
    {
        TestSystem system({reference::cockpit, reference::robot, reference::arm}, {"cockpit robot", "cockpit arm"});
        auto settings = system.settingsOf("robot");
        system.identityOf("arm").applyTo(settings);
        const auto created = DistributedSystem::create(settings);
        QVERIFY(!created);
        QCOMPARE(words(created.error().code), words(Errc::CertificateInvalid));
        QVERIFY2(created.error().what.find("0x00008208") != std::string::npos, created.error().what.c_str());
    }

    void refusesADeviceOfAnotherSite()
    {
        TestSystem system({reference::cockpit, reference::robot}, {"cockpit robot"});
        TestAuthority stranger;
        auto settings = system.settingsOf("robot");
        stranger.identityOf(system.idOf("robot"), "robot").applyTo(settings);
        TestDevice robot(settings);
        TestDevice cockpit(system.settingsOf("cockpit"));
        QVERIFY(cockpit->openChannel(system.idOf("robot")));
        QTRY_VERIFY2(cockpit.heard(Kind::OpenFailed), cockpit.story().c_str());
        QCOMPARE(words(cockpit.events(Kind::OpenFailed)[0].diagnosis.probe), words(ProbeResult::TlsFailure));
    }

    void learnsSetsItDoesNotHaveAndPinsThem()
    {
        TestSystem system({reference::cockpit, reference::robot}, {"cockpit robot"});
        const auto registryOf = [&](const std::string& set) {
            const auto folder = system.folder() / ("registry-" + set);
            std::filesystem::create_directories(folder);
            std::filesystem::copy_file(std::filesystem::path(LIENA_SOURCE_DIR) / "resources/devices" / (set + ".xml"),
                                       folder / (set + ".xml"));
            return folder;
        };
        auto robotSettings = system.settingsOf("robot");
        robotSettings.registry = {registryOf("vascular-robot")};
        auto cockpitSettings = system.settingsOf("cockpit");
        cockpitSettings.registry = {registryOf("siat-cockpit")};
        TestDevice robot(robotSettings);
        TestDevice cockpit(cockpitSettings);
        const auto robotId = system.idOf("robot");
        QVERIFY(!cockpit->command(robotId, "MotionCommand"));
        QVERIFY(cockpit->openChannel(robotId));
        QTRY_VERIFY2(cockpit.heard(Kind::Opened), cockpit.story().c_str());
        QTRY_VERIFY2(robot.heard(Kind::Opened), robot.story().c_str());
        QVERIFY(cockpit->command(robotId, "MotionCommand"));
        QVERIFY(robot->messageSet(system.idOf("cockpit")) != nullptr);
        const auto hash = cockpit->messageSet(robotId)->hash().toHex();
        QVERIFY(std::filesystem::exists(system.folder() / "store-cockpit" / (hash + ".xml")));
    }

    void takesAChangedSetOnlyAfterAPersonAcceptedIt()
    {
        TestSystem system({reference::cockpit, reference::robot}, {"cockpit robot"});
        auto xml = MessageSet::load(std::filesystem::path(LIENA_SOURCE_DIR) / "resources/devices/vascular-robot.xml").value()->xml();
        const std::string bound = "max=\"40\"";
        QVERIFY(xml.find(bound) != std::string::npos);
        xml.replace(xml.find(bound), bound.size(), "max=\"50\"");
        const auto changed = MessageSet::parse(xml, "changed.xml").value();
        auto settings = system.settingsOf("robot");
        settings.registry = {system.folder() / "changed"};
        std::filesystem::create_directories(settings.registry.front());
        std::ofstream(settings.registry.front() / "vascular-robot.xml") << xml;
        std::filesystem::copy_file(std::filesystem::path(LIENA_SOURCE_DIR) / "resources/devices/siat-cockpit.xml",
                                   settings.registry.front() / "siat-cockpit.xml");
        TestDevice robot(settings);
        TestDevice cockpit(system.settingsOf("cockpit"));
        const auto robotId = system.idOf("robot");
        QVERIFY(cockpit->openChannel(robotId));
        QTRY_VERIFY2(cockpit.heard(Kind::OpenFailed), cockpit.story().c_str());
        QCOMPARE(words(cockpit.events(Kind::OpenFailed)[0].reason), words(RejectReason::MessageSetChanged));

        QVERIFY(acceptSet(system.settingsOf("cockpit").store, *changed));
        QTRY_COMPARE(words(cockpit.state(robotId)), words(SessionState::Closed));
        QTRY_COMPARE(words(robot.state(system.idOf("cockpit"))), words(SessionState::Closed));
        QVERIFY(cockpit->openChannel(robotId));
        QTRY_VERIFY2(cockpit.heard(Kind::Opened), cockpit.story().c_str());
        QVERIFY(cockpit->messageSet(robotId)->hash() == changed->hash());
        QVERIFY(!motion(*cockpit, robotId, 1).set("guidewire_velocity", 45.0).fault());
    }

    void sendRefusesWhatCannotBe()
    {
        TestSystem system({reference::cockpit, reference::robot, reference::arm}, {"cockpit robot"});
        TestDevice cockpit(system.settingsOf("cockpit"));
        const auto robotId = system.idOf("robot");
        const auto sent = cockpit->send(robotId, motion(*cockpit, robotId, 1));
        QVERIFY(!sent);
        QCOMPARE(words(sent.error().code), words(Errc::NotOpen));
        QCOMPARE(words(cockpit->openChannel(system.idOf("arm")).error().code), words(Errc::NoLink));
        QCOMPARE(words(cockpit->openChannel(DeviceId(0x20010208)).error().code), words(Errc::UnknownDevice));
        QCOMPARE(words(cockpit->reopenChannel(robotId).error().code), words(Errc::NoIncident));
        auto fast = motion(*cockpit, robotId, 1);
        fast.set("guidewire_velocity", 41.0);
        const auto refused = cockpit->send(robotId, fast);
        QCOMPARE(words(refused.error().code), words(Errc::ValueRefused));
        for (const auto* part : {"MotionCommand", "guidewire_velocity", "41", "-40", "40"})
            QVERIFY2(refused.error().what.find(part) != std::string::npos, refused.error().what.c_str());
    }

    void clockOffsetOnOneComputerIsNearZero()
    {
        TestSystem system({reference::cockpit, reference::robot}, {"cockpit robot"});
        TestDevice robot(system.settingsOf("robot"));
        TestDevice cockpit(system.settingsOf("cockpit"));
        QVERIFY(cockpit->openChannel(system.idOf("robot")));
        QTRY_VERIFY(cockpit->links()[0].clockOffset.has_value());
        const auto link = cockpit->links()[0];
        QVERIFY(std::chrono::abs(*link.clockOffset) <= link.clockUncertainty + std::chrono::milliseconds(1));
    }

    void portInUseIsSaidWithItsPlace()
    {
        TestSystem system({reference::cockpit, reference::robot}, {"cockpit robot"});
        TestDevice robot(system.settingsOf("robot"));
        const auto second = DistributedSystem::create(system.settingsOf("robot"));
        QVERIFY(!second);
        QCOMPARE(words(second.error().code), words(Errc::AddressUnavailable));
        QVERIFY2(second.error().what.find("127.0.0.1:" + std::to_string(system.portOf("robot"))) != std::string::npos,
                 second.error().what.c_str());
    }
};

QTEST_GUILESS_MAIN(DialoguesTest)
#include "dialogues_test.moc"
