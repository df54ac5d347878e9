// The drive gate: no command stream makes it leave its envelope or move without a lease.
#include "drive_gate.hpp"

#include <QTest>

#include <cmath>
#include <random>

using namespace liena::devices;
using namespace std::chrono_literals;

namespace {

const SteadyTime start{1h};

// The gate with drives that do what it says, run by a loop of 1 ms.
struct Rig {
    DriveGate gate{DriveLimits::forWay(600)};
    DriveFeedback feedback;
    SteadyTime now = start;
    std::optional<StopCause> stopped;

    Rig()
    {
        feedback.positions = {300, 0, 260, 0};
        gate.step(now, feedback);
    }

    DriveStep run(std::chrono::nanoseconds duration = 1ms)
    {
        now += duration;
        const DriveStep step = gate.step(now, feedback);
        for (std::size_t axis = 0; axis < axisCount; ++axis)
            feedback.positions[axis] += step.displacements[axis];
        if (step.stop)
            stopped = step.stop;
        return step;
    }

    void driveFor(const AxisValues& velocities, int milliseconds)
    {
        for (int passed = 0; passed < milliseconds; ++passed) {
            gate.drive(velocities, now, now);
            run();
        }
    }
};

} // namespace

class DriveGateTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void movesOnlyWhenEnabledAndDriven()
    {
        Rig rig;
        QVERIFY(!rig.gate.drive({10, 0, 0, 0}, rig.now, rig.now));
        QVERIFY(rig.run(20ms).still);
        QVERIFY(rig.gate.enable());
        QVERIFY(rig.run(20ms).still);
        QCOMPARE(rig.feedback.positions[0], 300.0);
        rig.driveFor({10, 0, 0, 0}, 100);
        QCOMPARE(rig.gate.velocities()[0], 10.0);
        QVERIFY(rig.feedback.positions[0] > 300.5);
    }

    void stopsWithinThirtyMillisecondsOfTheLeasesEnd()
    {
        Rig rig;
        rig.gate.enable();
        rig.driveFor({40, 720, -40, -360}, 200);
        QCOMPARE(rig.gate.velocities()[0], 40.0);
        const SteadyTime last = rig.now - 1ms; // of the last command
        while (!rig.run().still)
            QVERIFY(rig.now - last <= 85ms);
        QVERIFY(rig.now - last <= 81ms);
        QVERIFY(rig.stopped == StopCause::LeaseOver);
        QVERIFY(!rig.gate.enabled());
        QVERIFY(!rig.gate.drive({1, 0, 0, 0}, rig.now, rig.now));
    }

    void endsTheLeaseInTimeHoweverLateTheLoopRuns()
    {
        Rig rig;
        rig.gate.enable();
        rig.driveFor({40, 0, 0, 0}, 200);
        const double before = rig.feedback.positions[0];
        rig.run(55ms);
        QVERIFY(rig.stopped == StopCause::LeaseOver);
        // 49 ms of lease are left at 40 mm/s, then the drive slows down.
        QVERIFY(rig.feedback.positions[0] - before < 40 * 0.055);
        QVERIFY(rig.gate.velocities()[0] < 40);
    }

    void watchdogStopsAtOnce()
    {
        Rig rig;
        rig.gate.enable();
        rig.driveFor({40, 0, 0, 0}, 200);
        const double before = rig.feedback.positions[0];
        const DriveStep step = rig.run(5s);
        QVERIFY(step.stop.has_value());
        QVERIFY(step.still);
        QVERIFY(rig.feedback.positions[0] - before < 40 * 0.06);
        QVERIFY(!rig.gate.enabled());
    }

    void watchdogLocksAnEnabledGateThatStands()
    {
        Rig rig;
        rig.gate.enable();
        rig.run(1s);
        QVERIFY(rig.stopped == StopCause::Watchdog);
        QVERIFY(!rig.gate.drive({1, 0, 0, 0}, rig.now, rig.now));
    }

    void refusesWhatIsOutsideTheEnvelope_data()
    {
        QTest::addColumn<int>("axis");
        QTest::addColumn<double>("velocity");
        QTest::newRow("too fast forward") << 0 << 40.001;
        QTest::newRow("too fast back") << 0 << -40.001;
        QTest::newRow("turn") << 1 << 721.0;
        QTest::newRow("catheter") << 2 << -41.0;
        QTest::newRow("catheter turn") << 3 << 361.0;
        QTest::newRow("no number") << 1 << std::nan("");
        QTest::newRow("infinite") << 2 << HUGE_VAL;
    }

    void refusesWhatIsOutsideTheEnvelope()
    {
        QFETCH(int, axis);
        QFETCH(double, velocity);
        Rig rig;
        rig.gate.enable();
        AxisValues wanted{};
        wanted[static_cast<std::size_t>(axis)] = velocity;
        QVERIFY(!rig.gate.drive(wanted, rig.now, rig.now));
        QVERIFY(rig.run(20ms).still);
    }

    void refusedCommandDoesNotRenewTheLease()
    {
        Rig rig;
        rig.gate.enable();
        rig.driveFor({10, 0, 0, 0}, 50);
        for (int passed = 0; passed < 60; ++passed) {
            rig.gate.drive({50, 0, 0, 0}, rig.now, rig.now);
            rig.run();
        }
        QVERIFY(rig.stopped == StopCause::LeaseOver);
    }

    void oldCommandGivesNoNewLease()
    {
        Rig rig;
        rig.gate.enable();
        rig.run(50ms);
        QVERIFY(!rig.gate.drive({10, 0, 0, 0}, rig.now - 50ms, rig.now));
        QVERIFY(rig.gate.drive({10, 0, 0, 0}, rig.now - 49ms, rig.now));
    }

    // The process was frozen between the arrival and the call, so that the last step is as old as the command.
    void commandThatGrewOldBeforeTheCallGivesNoLease()
    {
        Rig rig;
        rig.gate.enable();
        rig.run(50ms);
        QVERIFY(!rig.gate.drive({10, 0, 0, 0}, rig.now, rig.now + 50ms));
        QVERIFY(rig.run(20ms).still);
        QVERIFY(rig.gate.drive({10, 0, 0, 0}, rig.now, rig.now + 49ms));
    }

    void releaseSlowsDownAndStaysEnabled()
    {
        Rig rig;
        rig.gate.enable();
        rig.driveFor({40, 0, 0, 0}, 200);
        rig.gate.release();
        rig.run(21ms);
        QVERIFY(rig.gate.still());
        QVERIFY(rig.gate.enabled());
        QVERIFY(!rig.stopped);
    }

    void stopLocksUntilEnabledWhileStanding()
    {
        Rig rig;
        rig.gate.enable();
        rig.driveFor({40, 0, 0, 0}, 200);
        rig.gate.stop();
        QVERIFY(!rig.gate.enable());
        QVERIFY(!rig.gate.drive({40, 0, 0, 0}, rig.now, rig.now));
        rig.run(30ms);
        QVERIFY(rig.gate.still());
        QVERIFY(rig.gate.enable());
    }

    void cutStandsAtOnce()
    {
        Rig rig;
        rig.gate.enable();
        rig.driveFor({40, 720, 40, 360}, 200);
        rig.gate.cut();
        const AxisValues before = rig.feedback.positions;
        QVERIFY(rig.run(10ms).still);
        QCOMPARE(rig.feedback.positions, before);
    }

    void comesToRestAtTheSoftLimit_data()
    {
        QTest::addColumn<double>("from");
        QTest::addColumn<double>("velocity");
        QTest::addColumn<double>("limit");
        QTest::newRow("high") << 590.0 << 40.0 << 595.0;
        QTest::newRow("low") << 6.0 << -40.0 << 0.0;
        QTest::newRow("slow") << 594.9 << 1.0 << 595.0;
    }

    void comesToRestAtTheSoftLimit()
    {
        QFETCH(double, from);
        QFETCH(double, velocity);
        QFETCH(double, limit);
        Rig rig;
        rig.feedback.positions[0] = from;
        rig.gate.enable();
        rig.driveFor({velocity, 0, 0, 0}, 1000);
        QVERIFY(rig.stopped == StopCause::SoftLimit);
        QVERIFY(std::abs(rig.feedback.positions[0] - limit) < 1e-6);
        QVERIFY(rig.gate.still());
        rig.gate.enable();
        rig.driveFor({-velocity, 0, 0, 0}, 100);
        QVERIFY(std::abs(rig.feedback.positions[0] - limit) > 0.05); // the way back is open
    }

    void hardLimitCutsAndOpensOnlyTheWayBack()
    {
        Rig rig;
        rig.gate.enable();
        rig.driveFor({40, 0, 0, 0}, 100);
        rig.feedback.positions[0] = 600.5; // slipped
        rig.run();
        QVERIFY(rig.stopped == StopCause::HardLimit);
        QVERIFY(rig.gate.still());
        rig.gate.enable();
        rig.driveFor({5, 0, 0, 0}, 10);
        QCOMPARE(rig.feedback.positions[0], 600.5);
        rig.gate.enable();
        rig.driveFor({-5, 0, 0, 0}, 100);
        QVERIFY(rig.feedback.positions[0] < 600.5);
    }

    void forceStopsWhatPushesAndAllowsWhatRelieves()
    {
        Rig rig;
        rig.gate.enable();
        rig.driveFor({10, 0, 0, 0}, 50);
        rig.feedback.guidewireForce = 2.0;
        rig.run();
        QVERIFY(rig.stopped == StopCause::ForceStop);
        rig.run(30ms);
        QVERIFY(rig.gate.still());
        rig.gate.enable();
        rig.driveFor({-10, 0, 0, 0}, 50);
        QVERIFY(rig.gate.velocities()[0] < 0);
        rig.driveFor({0, 90, 0, 0}, 30);
        rig.run(30ms);
        QVERIFY(rig.gate.still()); // no turning under that force
    }

    void neverLeavesTheEnvelope_data()
    {
        QTest::addColumn<unsigned>("seed");
        for (unsigned seed = 1; seed <= 20; ++seed)
            QTest::newRow(qPrintable(QString::number(seed))) << seed;
    }

    // Whatever is commanded, however the loop stutters: bounded speed, no step past a soft limit, no motion beyond lease and ramp.
    void neverLeavesTheEnvelope()
    {
        QFETCH(unsigned, seed);
        std::mt19937 random(seed);
        const auto between = [&](double low, double high) { return low + (high - low) * static_cast<double>(random()) / 4294967295.0; };
        Rig rig;
        rig.feedback.positions = {between(0, 595), 0, between(0, 595), 0};
        const DriveLimits limits = rig.gate.limits();
        SteadyTime leaseEnd = start;
        bool enabled = false;
        for (int round = 0; round < 20'000; ++round) {
            const double dice = between(0, 1);
            if (dice < 0.02)
                enabled = rig.gate.enable() || enabled;
            else if (dice < 0.03)
                rig.gate.stop();
            else if (dice < 0.035)
                rig.gate.cut();
            else if (dice < 0.06)
                rig.gate.release();
            else if (dice < 0.8) {
                const AxisValues wanted{between(-45, 45), between(-800, 800), between(-45, 45), between(-400, 400)};
                const SteadyTime commanded = rig.now - std::chrono::microseconds(random() % 60'000);
                if (rig.gate.drive(wanted, commanded, rig.now)) {
                    QVERIFY(rig.gate.enabled());
                    leaseEnd = std::max(leaseEnd, commanded + limits.lease);
                }
            }
            const auto duration = std::chrono::microseconds(dice < 0.005 ? random() % 200'000 : random() % 4'000);
            const SteadyTime before = rig.now;
            const AxisValues from = rig.feedback.positions;
            const DriveStep step = rig.run(duration);
            const double seconds = std::chrono::duration<double>(duration).count();
            for (std::size_t axis = 0; axis < axisCount; ++axis) {
                const auto& envelope = limits.axes[axis];
                QVERIFY(std::abs(step.velocities[axis]) <= envelope.maxVelocity);
                QVERIFY(std::abs(step.displacements[axis]) <= envelope.maxVelocity * std::min(seconds, 0.06) + 1e-9);
                if (envelope.soft) {
                    QVERIFY(rig.feedback.positions[axis] <= std::max(envelope.soft->high, from[axis]) + 1e-6);
                    QVERIFY(rig.feedback.positions[axis] >= std::min(envelope.soft->low, from[axis]) - 1e-6);
                }
            }
            if (before > leaseEnd + 22ms)
                QCOMPARE(rig.feedback.positions, from); // ramp of 20 ms and the 1 ms parts
        }
        QVERIFY(enabled);
    }
};

QTEST_GUILESS_MAIN(DriveGateTest)
#include "drive_gate_test.moc"
