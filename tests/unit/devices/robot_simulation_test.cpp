// The robot's simulated body: it goes where the drives go, and feels as a wire in a vessel does.
#include "robot_simulation.hpp"

#include <QTest>

using namespace liena::devices;
using namespace std::chrono_literals;

namespace {

DriveStep stepOf(const AxisValues& velocities, double seconds)
{
    DriveStep step;
    step.velocities = velocities;
    for (std::size_t axis = 0; axis < axisCount; ++axis)
        step.displacements[axis] = velocities[axis] * seconds;
    return step;
}

RobotSimulation body(double start, std::uint64_t seed = 1) { return {VesselWay(VesselTree::cerebral()), start, seed}; }

double largestForce(RobotSimulation& robot, double velocity, int steps)
{
    double most = 0;
    for (int count = 0; count < steps; ++count) {
        robot.move(stepOf({velocity, 0, 0, 0}, 0.002), 2ms);
        most = std::max(most, std::abs(robot.force()));
    }
    return most;
}

} // namespace

class RobotSimulationTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void movesByWhatTheDrivesMoved()
    {
        auto robot = body(300);
        robot.move(stepOf({10, 90, -5, 45}, 0.1), 100ms);
        QCOMPARE(robot.feedback().positions, (AxisValues{301, 9, 259.5, 4.5}));
        robot.move(stepOf({}, 1), 1s);
        QCOMPARE(robot.feedback().positions, (AxisValues{301, 9, 259.5, 4.5}));
    }

    void openGripperSlides()
    {
        auto robot = body(300);
        robot.setGripper(Gripper::Guidewire, false);
        robot.move(stepOf({10, 90, 10, 0}, 0.1), 100ms);
        QCOMPARE(robot.feedback().positions[0], 300.0);
        QCOMPARE(robot.feedback().positions[2], 261.0);
        QCOMPARE(robot.velocities()[0], 0.0);
    }

    void forceGrowsWithTheBendTaken()
    {
        auto straight = body(60);
        auto bent = body(460);
        QVERIFY(largestForce(bent, 4, 250) > largestForce(straight, 4, 250) + 0.1);
    }

    void forceOpposesTheMotion()
    {
        auto robot = body(300);
        largestForce(robot, 10, 200);
        QVERIFY(robot.force() > 0);
        largestForce(robot, -10, 200);
        QVERIFY(robot.force() < 0);
    }

    void forceLetsGoWhenTheWireStands()
    {
        auto robot = body(460);
        largestForce(robot, 10, 200);
        const double pushed = robot.force();
        robot.move(stepOf({}, 3), 3s);
        QVERIFY(robot.force() < pushed / 4);
    }

    void turningTheWireFreesItAtABranch()
    {
        const VesselWay way(VesselTree::cerebral());
        const double branch = way.branches().at(way.branches().size() - 3);
        double least = 9;
        double most = 0;
        for (double angle = 0; angle < 360; angle += 30) {
            auto robot = body(branch - 1);
            robot.move(stepOf({0, angle, 0, 0}, 1), 1s);
            const double force = largestForce(robot, 10, 100);
            least = std::min(least, force);
            most = std::max(most, force);
        }
        QVERIFY(most > least + 0.6);
        QVERIFY(most < 5);
    }

    void wholeWayStaysWithinWhatTheReportsHold()
    {
        auto robot = body(0);
        while (robot.feedback().positions[0] < robot.way().length() - 6) {
            robot.move(stepOf({40, 720, 0, 0}, 0.01), 10ms);
            QVERIFY(std::abs(robot.force()) <= 5 && std::abs(robot.torque()) <= 50);
            QVERIFY(robot.drive(Axis::GuidewireAdvance).current < 10);
        }
        QVERIFY(robot.drivesHealthy());
    }

    void tipIsOnTheCentreLineButForTheTrackersNoise()
    {
        auto robot = body(400);
        const WayPoint place = robot.way().at(400);
        Vector sum;
        double square = 0;
        constexpr int count = 2000;
        for (int reading = 0; reading < count; ++reading) {
            const TipReading tip = robot.tip();
            const Vector off = tip.position - place.position;
            sum = sum + off;
            square += dot(off, off);
            const auto& q = tip.quaternion;
            QVERIFY(std::abs(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3] - 1) < 1e-9);
        }
        QVERIFY(length(sum * (1.0 / count)) < 0.05);
        const double error = robot.tip().error;
        QVERIFY(std::abs(std::sqrt(square / count) - error) < 0.1 * error);
    }

    void sameSeedGivesTheSameNoise()
    {
        auto first = body(400, 7);
        auto second = body(400, 7);
        auto other = body(400, 8);
        QCOMPARE(first.tip().position, second.tip().position);
        QVERIFY(!(first.tip().position == other.tip().position));
    }

    void quaternionTurnsUpToTheDirection_data()
    {
        QTest::addColumn<double>("x");
        QTest::addColumn<double>("y");
        QTest::addColumn<double>("z");
        QTest::newRow("up") << 0.0 << 0.0 << 1.0;
        QTest::newRow("down") << 0.0 << 0.0 << -1.0;
        QTest::newRow("aside") << 1.0 << 0.0 << 0.0;
        QTest::newRow("any") << 0.3 << -2.0 << -0.7;
    }

    void quaternionTurnsUpToTheDirection()
    {
        QFETCH(double, x);
        QFETCH(double, y);
        QFETCH(double, z);
        const auto q = quaternionTo({x, y, z});
        const Vector turned{2 * (q[1] * q[3] + q[0] * q[2]), 2 * (q[2] * q[3] - q[0] * q[1]), 1 - 2 * (q[1] * q[1] + q[2] * q[2])};
        QVERIFY(length(turned - normalised({x, y, z})) < 1e-6);
    }
};

QTEST_GUILESS_MAIN(RobotSimulationTest)
#include "robot_simulation_test.moc"
