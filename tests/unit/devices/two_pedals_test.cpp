// Two cockpits' pedals at one X-ray system: what becomes of a press that was refused because the other's pedal was down.
#include "xray_machine.hpp"

#include <QTest>

#include <map>

using namespace liena;
using namespace liena::devices;
using namespace std::chrono_literals;

namespace {

const DeviceId cockpit(0x40018208);
const DeviceId otherCockpit(0x40018209);

struct Rig {
    XrayMachine machine;
    SteadyTime now{1h};

    Rig()
    {
        pedal(cockpit, 0, false);
        pedal(otherCockpit, 0, false);
    }

    bool pedal(DeviceId origin, std::uint32_t press, bool down = true, AcquisitionMode mode = AcquisitionMode::Fluoroscopy,
               double rate = 15)
    {
        return machine.command({origin, mode, rate, down, press}, now);
    }

    void wait(int milliseconds)
    {
        for (int passed = 0; passed < milliseconds; passed += 10) {
            now += 10ms;
            machine.tick(now);
        }
    }

    void spinToItsEnd()
    {
        for (int count = 0; count < 300 && machine.beamOn(); ++count) {
            wait(50);
            pedal(cockpit, 1, true, AcquisitionMode::Spin);
        }
    }
};

using Happening = void (*)(Rig&);

const std::map<QByteArray, Happening> ends{
    {"stand-by", [](Rig& rig) { rig.machine.setStandBy(true, rig.now); }},
    {"stop or stall", [](Rig& rig) { rig.machine.interrupt("stop at the patient's side", rig.now); }},
    {"session of the other lost", [](Rig& rig) { rig.machine.sessionLost(cockpit); }},
    {"silence of the other", [](Rig& rig) { rig.wait(300); }},
    {"spin complete", [](Rig& rig) { rig.spinToItsEnd(); }},
    {"stand-by after the release",
     [](Rig& rig) {
         rig.pedal(cockpit, 1, false);
         rig.machine.setStandBy(true, rig.now);
     }},
};

} // namespace

class TwoPedalsTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void refusedPressBeginsByNothingButTheOthersRelease_data()
    {
        QTest::addColumn<QByteArray>("end");
        for (const auto& [name, happening] : ends)
            QTest::newRow(name.constData()) << name;
    }

    void refusedPressBeginsByNothingButTheOthersRelease()
    {
        QFETCH(QByteArray, end);
        Rig rig;
        rig.machine.tick(rig.now);
        QVERIFY(rig.pedal(cockpit, 1, true, end == "spin complete" ? AcquisitionMode::Spin : AcquisitionMode::Fluoroscopy));
        QVERIFY(!rig.pedal(otherCockpit, 5));
        ends.at(end)(rig);
        QVERIFY(!rig.machine.beamOn());
        QVERIFY(!rig.pedal(otherCockpit, 5));
        QVERIFY(!rig.machine.beamOn());
        rig.machine.setStandBy(false, rig.now);
        QVERIFY(!rig.pedal(otherCockpit, 5)); // the pedal is still down
        QVERIFY(!rig.machine.beamOn());
        rig.wait(300); // until an up counts again
        rig.pedal(otherCockpit, 5, false);
        QVERIFY(rig.pedal(otherCockpit, 6));
        QVERIFY(rig.machine.beamOn());
    }

    void pressRefusedForItsRateIsSpentByTheStandBy()
    {
        Rig rig;
        QVERIFY(!rig.pedal(otherCockpit, 5, true, AcquisitionMode::Fluoroscopy, 31));
        rig.machine.setStandBy(true, rig.now);
        QVERIFY(!rig.pedal(otherCockpit, 5));
        QVERIFY(!rig.machine.beamOn());
    }

    void newerPressIsTheOneThatIsSpent()
    {
        Rig rig;
        QVERIFY(rig.pedal(cockpit, 1));
        QVERIFY(!rig.pedal(otherCockpit, 5));
        rig.pedal(otherCockpit, 5, false);
        QVERIFY(!rig.pedal(otherCockpit, 6));
        rig.wait(300); // the other falls silent
        QVERIFY(!rig.pedal(otherCockpit, 6));
        QVERIFY(!rig.machine.beamOn());
    }

    void endedSessionTakesItsRefusedPressAlong()
    {
        Rig rig;
        QVERIFY(rig.pedal(cockpit, 1));
        QVERIFY(!rig.pedal(otherCockpit, 5));
        rig.machine.sessionLost(otherCockpit);
        rig.wait(300); // the other falls silent, which is no word of a pedal that was heard up
        QVERIFY(!rig.pedal(otherCockpit, 6));
        QVERIFY(!rig.machine.beamOn());
    }
};

QTEST_GUILESS_MAIN(TwoPedalsTest)
#include "two_pedals_test.moc"
