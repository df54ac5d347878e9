// The stop at the patient's side: it leaves whatever its words are, and goes on being sent while the robot does not name it and could. And
// what the robot notes of it.
#include "patient_side.hpp"
#include "robot_device.hpp"
#include "test_system.hpp"

#include <QFile>
#include <QTest>

#include <atomic>
#include <filesystem>
#include <memory>
#include <mutex>

using namespace liena;
using namespace liena::test;
using Kind = SessionEvent::Kind;

namespace {

/// Lines of a device.
class Lines {
public:
    LogSink sink()
    {
        return [this](LogLevel, std::string_view line) {
            const std::lock_guard lock(m_mutex);
            m_text += QByteArray(line.data(), static_cast<qsizetype>(line.size())) + '\n';
        };
    }
    QByteArray text() const
    {
        const std::lock_guard lock(m_mutex);
        return m_text;
    }

private:
    mutable std::mutex m_mutex;
    QByteArray m_text;
};

/// The arm with a person beside it, and a robot that says nothing of what it hears.
struct Bedside {
    explicit Bedside(const std::string& link = "robot arm") : system({reference::robot, reference::arm}, {link}) {}

    TestSystem system;
    TestDevice robot{system.settingsOf("robot")};
    Lines log;                                  ///< the arm's
    std::unique_ptr<devices::PatientSide> side; ///< outlives the arm's run
    std::atomic<int> turns{0};                  ///< in which it could have repeated a stop
    TestDevice arm{system.settingsOf("arm"), [this](DistributedSystem& device) {
                       side = std::make_unique<devices::PatientSide>(device, log.sink(), std::vector<DeviceId>(),
                                                                     [this](std::string_view reason) { side->stopRobots(reason); });
                       device.every(std::chrono::milliseconds(100), [this] { ++turns; });
                   }};

    bool open()
    {
        return arm->openChannel(system.idOf("robot")) &&
               QTest::qWaitFor([this] { return robot.heard(Kind::Opened) && arm.heard(Kind::Opened); }, 20000);
    }
    std::vector<Message> stops() { return robot.messages("EmergencyStop"); }
    std::string story() const { return arm.story() + robot.story(); }
};

QByteArray contentOf(const std::filesystem::path& path)
{
    QFile file(QString::fromStdString(path.string()));
    return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

} // namespace

class PatientStopTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    /// It is sent once to a robot that heard it; one that says nothing may never have got it.
    void isSentAgainWhileTheRobotDoesNotNameIt()
    {
        Bedside bedside;
        QVERIFY2(bedside.open(), bedside.story().c_str());
        bedside.side->obey("stop smoke");
        QTRY_VERIFY2(bedside.stops().size() >= 3, bedside.story().c_str());
        const auto heard = bedside.stops();
        const auto token = heard.front().get<std::uint64_t>("token");
        QVERIFY(token != 0);
        for (const auto& stop : heard) {
            QCOMPARE(stop.get<std::uint64_t>("token"), token);
            QCOMPARE(std::string(stop.get<std::string_view>("reason")), std::string("smoke"));
        }
    }

    /// It may be heard hours later, by a robot that works again.
    void statusTellsOfAStopThatIsNotNamed()
    {
        Bedside bedside;
        bedside.side->obey("status");
        QTRY_VERIFY(bedside.log.text().contains("robot: closed"));
        QVERIFY(!bedside.log.text().contains("has not named"));
        bedside.side->obey("stop smoke");
        bedside.side->obey("status");
        QTRY_VERIFY2(bedside.log.text().contains("robot has not named the stop that was said here (smoke)"),
                     bedside.log.text().constData());
    }

    void leavesWhateverItsWordsAre_data()
    {
        QTest::addColumn<QByteArray>("words");
        QTest::addColumn<QByteArray>("heard");
        QTest::newRow("129 bytes, of which 128 end in a character") << QByteArray("血").repeated(43) << QByteArray("血").repeated(41) + "…";
        QTest::newRow("a terminal in GBK") << QByteArray("\xB3\xF6") << QByteArray("\\xb3\\xf6");
        QTest::newRow("a terminal in Latin-1") << QByteArray("Rauch f\xFCr") << QByteArray("Rauch f\\xfcr");
    }

    void leavesWhateverItsWordsAre()
    {
        QFETCH(QByteArray, words);
        QFETCH(QByteArray, heard);
        Bedside bedside;
        QVERIFY2(bedside.open(), bedside.story().c_str());
        bedside.side->obey("stop " + words.toStdString());
        QTRY_VERIFY2(!bedside.stops().empty(), bedside.story().c_str());
        QCOMPARE(QByteArray::fromStdString(bedside.stops().front().get<std::string>("reason")), heard);
    }

    /// Nothing would end the repetition, and no reset would last.
    void goesOnceInASessionWhereTheRobotsReportsDoNotCome()
    {
        Bedside bedside(R"(robot arm|<flow message="EmergencyStop" from="arm"/>)");
        QVERIFY2(bedside.open(), bedside.story().c_str());
        bedside.side->obey("stop smoke");
        QTRY_VERIFY2(!bedside.stops().empty(), bedside.story().c_str());
        const int turns = bedside.turns;
        QTRY_VERIFY(bedside.turns >= turns + 10);
        bedside.side->obey("stop fire"); // arrives behind all that was sent before it
        QTRY_VERIFY2(bedside.stops().back().get<std::string_view>("reason") == "fire", bedside.story().c_str());
        QCOMPARE(bedside.stops().size(), std::size_t{2});

        const auto robot = bedside.system.idOf("robot");
        QVERIFY(bedside.arm->closeChannel(robot, "for a while"));
        QTRY_VERIFY2(bedside.arm.heard(Kind::Closed) && bedside.robot.heard(Kind::Closed), bedside.story().c_str());
        QVERIFY(bedside.arm->openChannel(robot));
        QTRY_VERIFY2(bedside.stops().size() > 2, bedside.story().c_str()); // it may have gone with the session before
        QCOMPARE(bedside.stops()[2].get<std::uint64_t>("token"), bedside.stops()[1].get<std::uint64_t>("token"));
    }

    void theRobotNotesARepeatedStopOnce()
    {
        TestSystem system({reference::robot, reference::arm}, {"robot arm"});
        auto settings = system.settingsOf("robot");
        settings.audit = system.folder() / "robot.jsonl";
        Lines log;
        std::unique_ptr<devices::RobotDevice> device; // outlives the robot's run
        TestDevice robot(settings, [&](DistributedSystem& own) {
            device = devices::RobotDevice::create(own, devices::VesselTree::cerebral(), {}, log.sink()).value();
        });
        TestDevice arm(system.settingsOf("arm"));
        const auto robotId = system.idOf("robot");
        QVERIFY(arm->openChannel(robotId));
        QTRY_VERIFY2(robot.heard(Kind::Opened) && arm.heard(Kind::Opened), arm.story().c_str());
        const auto stop = [&](std::uint64_t token, std::string_view reason) {
            auto command = arm->command(robotId, "EmergencyStop").value();
            command.set("token", token).set("reason", reason);
            return arm->send(robotId, std::move(command)).has_value();
        };
        for (int i = 0; i < 10; ++i)
            QVERIFY(stop(7, "smoke"));
        QVERIFY(stop(8, "fire"));
        QTRY_VERIFY2(log.text().contains("fire"), log.text().constData());
        QCOMPARE(log.text().count("smoke"), 1);
        QTRY_VERIFY2(contentOf(settings.audit).contains(R"("text":"fire")"), contentOf(settings.audit).constData());
        QCOMPARE(contentOf(settings.audit).count(R"("text":"smoke")"), 1);
    }
};

QTEST_GUILESS_MAIN(PatientStopTest)
#include "patient_stop_test.moc"
