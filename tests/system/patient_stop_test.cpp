// The stop at the patient's side goes on being sent while the robot does not name it.
#include "patient_side.hpp"
#include "test_system.hpp"

#include <QTest>

#include <memory>

using namespace liena;
using namespace liena::test;
using Kind = SessionEvent::Kind;

class PatientStopTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    /// It is sent once to a robot that heard it; one that says nothing may never have got it.
    void isSentAgainWhileTheRobotDoesNotNameIt()
    {
        TestSystem system({reference::robot, reference::arm}, {"robot arm"});
        TestDevice robot(system.settingsOf("robot"));
        std::unique_ptr<devices::PatientSide> side; // outlives the arm's run
        TestDevice arm(system.settingsOf("arm"), [&](DistributedSystem& device) {
            side = std::make_unique<devices::PatientSide>(
                device, [](LogLevel, std::string_view) {}, std::vector<DeviceId>(),
                [&](std::string_view reason) { side->stopRobots(reason); });
        });
        QVERIFY(arm->openChannel(system.idOf("robot")));
        QTRY_VERIFY2(robot.heard(Kind::Opened) && arm.heard(Kind::Opened), arm.story().c_str());
        side->obey("stop smoke");
        QTRY_VERIFY2(robot.messages("EmergencyStop").size() >= 3, robot.story().c_str());
        const auto heard = robot.messages("EmergencyStop");
        const auto token = heard.front().get<std::uint64_t>("token");
        QVERIFY(token != 0);
        for (const auto& stop : heard) {
            QCOMPARE(stop.get<std::uint64_t>("token"), token);
            QCOMPARE(std::string(stop.get<std::string_view>("reason")), std::string("smoke"));
        }
    }
};

QTEST_GUILESS_MAIN(PatientStopTest)
#include "patient_stop_test.moc"
