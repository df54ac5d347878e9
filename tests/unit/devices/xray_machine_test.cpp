// The X-ray system: beam only while a pedal is held, and never again by itself.
#include "xray_machine.hpp"

#include <QTest>

using namespace liena;
using namespace liena::devices;
using namespace std::chrono_literals;

namespace {

const DeviceId cockpit(0x40018208);
const DeviceId otherCockpit(0x40018209);
const DeviceId robot(0x00008208);
const SteadyTime start{1h};

struct Rig {
    XrayMachine machine;
    SteadyTime now = start;
    AcquisitionMode mode = AcquisitionMode::Fluoroscopy;

    Rig()
    {
        pedal(0, false);
        pedal(0, false, otherCockpit);
    }

    bool pedal(std::uint32_t press, bool down = true, DeviceId origin = cockpit)
    {
        return machine.command({origin, mode, 15, down, press}, now);
    }
    void wait(std::chrono::milliseconds duration)
    {
        now += duration;
        machine.tick(now);
    }
    // What makes the next press count after a stand-by or a stop.
    void comeUp()
    {
        wait(XrayMachine::lateUps);
        pedal(0, false);
    }
};

} // namespace

class XrayMachineTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void beamLastsWhileThePedalIsRepeated()
    {
        Rig rig;
        QVERIFY(rig.pedal(1));
        for (int count = 0; count < 20; ++count) {
            rig.wait(200ms);
            QVERIFY(rig.machine.beamOn());
            QVERIFY(rig.pedal(1));
        }
        QCOMPARE(rig.machine.acquisition(), 1U);
        QVERIFY(rig.pedal(1, false));
        QVERIFY(!rig.machine.beamOn());
    }

    void pulsesThatAreLeftOutGiveNoDose()
    {
        Rig rig;
        QVERIFY(rig.pedal(1));
        rig.wait(10ms);
        const double rate = rig.machine.dose().airKermaRate;
        rig.machine.thinPulses(2);
        rig.wait(10ms);
        QCOMPARE(rig.machine.pulseRate(), 7.5);
        QCOMPARE(rig.machine.askedPulseRate(), 15.0);
        QCOMPARE(rig.machine.dose().airKermaRate, rate / 2);
    }

    void beamEndsWithoutRepetition()
    {
        Rig rig;
        rig.pedal(1);
        rig.wait(250ms);
        QVERIFY(rig.machine.beamOn());
        rig.wait(1ms);
        QVERIFY(!rig.machine.beamOn());
        QCOMPARE(rig.machine.mode(), AcquisitionMode::Stop);
    }

    void endedPressIsSpent_data()
    {
        QTest::addColumn<QString>("end");
        for (const char* end : {"silence", "released", "stand-by", "stall"})
            QTest::newRow(end) << QString(end);
    }

    void endedPressIsSpent()
    {
        QFETCH(QString, end);
        Rig rig;
        rig.pedal(1);
        if (end == "silence")
            rig.wait(300ms);
        if (end == "released")
            rig.pedal(1, false);
        if (end == "stand-by")
            rig.machine.setStandBy(true, rig.now);
        if (end == "stall")
            rig.machine.interrupt("stall", rig.now);
        QVERIFY(!rig.machine.beamOn());
        QVERIFY(!rig.pedal(1));
        QVERIFY(!rig.machine.beamOn());
        if (end == "stand-by" || end == "stall")
            rig.comeUp();
        QVERIFY(rig.pedal(2)); // also in stand-by: a press that began after it
        QVERIFY(rig.machine.beamOn());
        QCOMPARE(rig.machine.acquisition(), 2U);
    }

    void pressIsHeardFromItsBeginningInItsSession_data()
    {
        QTest::addColumn<QString>("before");
        for (const char* before : {"opened with the pedal down", "beam was on", "pedal was up"})
            QTest::newRow(before) << QString(before);
    }

    void pressIsHeardFromItsBeginningInItsSession()
    {
        QFETCH(QString, before);
        Rig rig;
        if (before == "opened with the pedal down")
            rig.machine = XrayMachine();
        if (before == "beam was on")
            QVERIFY(rig.pedal(6));
        rig.machine.sessionLost(cockpit);
        QVERIFY(!rig.machine.beamOn());
        for (const std::uint32_t press : {6U, 7U, 7U}) {
            QVERIFY(!rig.pedal(press));
            QVERIFY(!rig.machine.beamOn());
        }
        rig.mode = AcquisitionMode::Stop;
        QVERIFY(rig.pedal(8)); // no release: the foot is still there
        rig.mode = AcquisitionMode::Fluoroscopy;
        QVERIFY(!rig.pedal(9));
        QVERIFY(rig.pedal(9, false, otherCockpit));
        QVERIFY(!rig.pedal(9)); // another's foot came up
        QVERIFY(rig.pedal(9, false));
        QVERIFY(!rig.pedal(9));
        QVERIFY(!rig.machine.beamOn());
        QVERIFY(rig.pedal(10));
        QVERIFY(rig.machine.beamOn());
    }

    void spinRefusedInStandByIsNoRelease()
    {
        Rig rig;
        rig.machine = XrayMachine();
        rig.machine.setStandBy(true, rig.now);
        rig.mode = AcquisitionMode::Spin;
        QVERIFY(!rig.pedal(1));
        rig.mode = AcquisitionMode::Fluoroscopy;
        QVERIFY(!rig.pedal(2));
        QVERIFY(!rig.machine.beamOn());
    }

    void cockpitThatWasStartedAnewCountsFromTheBeginning()
    {
        Rig rig;
        QVERIFY(rig.pedal(1));
        rig.machine.sessionLost(cockpit);
        QVERIFY(rig.pedal(0, false));
        QVERIFY(rig.pedal(1));
        QVERIFY(rig.machine.beamOn());
    }

    void anothersSessionDoesNotEndTheBeam()
    {
        Rig rig;
        rig.pedal(1);
        rig.machine.sessionLost(robot);
        QVERIFY(rig.machine.beamOn());
    }

    void oneCockpitAtATime()
    {
        Rig rig;
        rig.pedal(1);
        QVERIFY(!rig.pedal(1, true, otherCockpit));
        QVERIFY(rig.pedal(1, false, otherCockpit)); // its release ends nothing of ours
        QVERIFY(rig.machine.beamOn());
        QVERIFY(!rig.pedal(9, true, robot));
    }

    void refusedPressOfAnotherMayBeUsedLater()
    {
        Rig rig;
        rig.pedal(1);
        rig.pedal(5, true, otherCockpit);
        rig.pedal(1, false);
        QVERIFY(rig.pedal(5, true, otherCockpit));
    }

    void doseFollowsThePulses()
    {
        Rig rig;
        rig.pedal(1);
        rig.machine.pulsed();
        const double one = rig.machine.dose().airKerma;
        QVERIFY(one > 0.005 && one < 0.2);
        rig.machine.pulsed();
        QVERIFY(std::abs(rig.machine.dose().airKerma - 2 * one) < 1e-12);
        QVERIFY(rig.machine.dose().areaProduct > 0);
        rig.wait(100ms);
        QVERIFY(rig.machine.dose().airKermaRate > 1);
        QVERIFY(std::abs(rig.machine.dose().fluoroscopyTime - 0.0) < 0.2);
        rig.pedal(1, false);
        QCOMPARE(rig.machine.dose().airKermaRate, 0.0);
        QCOMPARE(rig.machine.tube().voltage, 0.0);
    }

    void acquisitionCostsMoreThanFluoroscopy()
    {
        Rig fluoroscopy;
        fluoroscopy.pedal(1);
        fluoroscopy.machine.pulsed();
        Rig acquisition;
        acquisition.mode = AcquisitionMode::Acquisition;
        acquisition.pedal(1);
        acquisition.machine.pulsed();
        QVERIFY(acquisition.machine.dose().airKerma > 5 * fluoroscopy.machine.dose().airKerma);
    }

    void beamTimeIsCounted()
    {
        Rig rig;
        rig.machine.tick(rig.now);
        rig.pedal(1);
        for (int count = 0; count < 100; ++count) {
            rig.wait(10ms);
            rig.pedal(1);
        }
        QVERIFY(std::abs(rig.machine.dose().fluoroscopyTime - 1.0) < 0.02);
    }

    void gantryGoesWhereItIsSentAndStopsInStandBy()
    {
        Rig rig;
        CArmGeometry target;
        target.primaryAngle = 30;
        target.fieldOfView = 200;
        QVERIFY(rig.machine.moveTo(cockpit, target));
        rig.machine.tick(rig.now);
        rig.wait(100ms);
        const double moved = rig.machine.geometry().primaryAngle;
        QVERIFY(moved > 1 && moved < 5);
        rig.machine.setStandBy(true, rig.now);
        rig.wait(100ms);
        rig.wait(100ms);
        QCOMPARE(rig.machine.geometry().primaryAngle, moved);
        QVERIFY(!rig.machine.moveTo(cockpit, target));
        rig.machine.setStandBy(false, rig.now);
        rig.wait(100ms);
        QCOMPARE(rig.machine.geometry().primaryAngle, moved); // not by itself
        QVERIFY(!rig.machine.moveTo(robot, target));
        QVERIFY(rig.machine.moveTo(cockpit, target));
        for (int count = 0; count < 30; ++count)
            rig.wait(100ms);
        QCOMPARE(rig.machine.geometry(), target);
    }

    void holdsWhileNothingRadiatesOrMoves()
    {
        Rig rig;
        QVERIFY(rig.machine.holds());
        QVERIFY(rig.pedal(1));
        QVERIFY(!rig.machine.holds());
        rig.machine.setStandBy(true, rig.now);
        QVERIFY(rig.machine.holds());
        rig.comeUp();
        QVERIFY(rig.pedal(2));
        QVERIFY(!rig.machine.holds());
        rig.machine.interrupt("a test", rig.now);
        QVERIFY(rig.machine.holds());
        rig.machine.setStandBy(false, rig.now);
        CArmGeometry target;
        target.primaryAngle = 0.3;
        QVERIFY(rig.machine.moveTo(cockpit, target));
        QVERIFY(!rig.machine.holds());
        for (int count = 0; count < 10; ++count)
            rig.wait(10ms);
        QVERIFY(rig.machine.holds()); // it is there
    }

    void spinTurnsTheArmAndEndsItself()
    {
        Rig rig;
        rig.mode = AcquisitionMode::Spin;
        rig.machine.tick(rig.now);
        rig.pedal(1);
        for (int count = 0; count < 300 && rig.machine.beamOn(); ++count) {
            rig.wait(50ms);
            rig.pedal(1);
        }
        QVERIFY(!rig.machine.beamOn());
        QCOMPARE(rig.machine.geometry().primaryAngle, 100.0);
    }

    void spinFromBeyondItsReachTurnsInward_data()
    {
        QTest::addColumn<double>("from");
        QTest::newRow("left") << 150.0;
        QTest::newRow("right") << -150.0;
        QTest::newRow("at its reach") << 100.0;
    }

    void spinFromBeyondItsReachTurnsInward()
    {
        QFETCH(double, from);
        Rig rig;
        CArmGeometry target;
        target.primaryAngle = from;
        QVERIFY(rig.machine.moveTo(cockpit, target));
        rig.machine.tick(rig.now);
        for (int count = 0; count < 100; ++count)
            rig.wait(100ms);
        QCOMPARE(rig.machine.geometry().primaryAngle, from);
        rig.mode = AcquisitionMode::Spin;
        QVERIFY(rig.pedal(1));
        for (int count = 0; count < 10; ++count)
            rig.wait(10ms);
        QVERIFY(rig.machine.beamOn());
        QVERIFY(std::abs(std::abs(from) - std::abs(rig.machine.geometry().primaryAngle) - 2) < 0.01);
        for (int count = 0; count < 300 && rig.machine.beamOn(); ++count) {
            rig.wait(50ms);
            rig.pedal(1);
        }
        QCOMPARE(rig.machine.geometry().primaryAngle, std::copysign(100.0, -from));
    }

    void doesNotSpinInStandBy()
    {
        Rig rig;
        rig.machine.tick(rig.now);
        rig.machine.setStandBy(true, rig.now);
        rig.comeUp();
        rig.mode = AcquisitionMode::Spin;
        QVERIFY(!rig.pedal(2));
        rig.wait(100ms);
        QVERIFY(!rig.machine.beamOn());
        QCOMPARE(rig.machine.geometry(), CArmGeometry());
        rig.machine.setStandBy(false, rig.now);
        QVERIFY(!rig.pedal(2)); // the pedal is still down: not by itself
        rig.machine.setStandBy(true, rig.now);
        rig.comeUp();
        rig.mode = AcquisitionMode::Fluoroscopy;
        QVERIFY(rig.pedal(3));
        QVERIFY(rig.machine.beamOn());
    }

    void fluoroscopyInStandByDoesNotBecomeASpin()
    {
        Rig rig;
        rig.machine.tick(rig.now);
        rig.machine.setStandBy(true, rig.now);
        rig.comeUp();
        QVERIFY(rig.pedal(1));
        rig.mode = AcquisitionMode::Spin;
        QVERIFY(!rig.pedal(1));
        QVERIFY(!rig.machine.beamOn());
        rig.machine.setStandBy(false, rig.now);
        QVERIFY(!rig.pedal(1));
        rig.wait(100ms);
        QCOMPARE(rig.machine.geometry(), CArmGeometry());
    }

    void recordedRunFixesThePulseRate()
    {
        Rig rig;
        rig.machine.fixPulseRate(7.5);
        rig.pedal(1);
        QCOMPARE(rig.machine.pulseRate(), 7.5);
    }

    void refusesImpossibleRates_data()
    {
        QTest::addColumn<double>("rate");
        QTest::newRow("zero") << 0.0;
        QTest::newRow("too many") << 31.0;
        QTest::newRow("no number") << std::nan("");
    }

    void refusesImpossibleRates()
    {
        QFETCH(double, rate);
        Rig rig;
        QVERIFY(!rig.machine.command({cockpit, AcquisitionMode::Fluoroscopy, rate, true, 1}, start));
        QVERIFY(!rig.machine.beamOn());
    }
};

QTEST_GUILESS_MAIN(XrayMachineTest)
#include "xray_machine_test.moc"
