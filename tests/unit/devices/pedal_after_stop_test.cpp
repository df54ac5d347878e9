// The pedal around a stand-by and a stop at the X-ray system: what began before them turns no beam on.
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

    bool pedal(std::uint32_t press, bool down = true, DeviceId origin = cockpit)
    {
        return machine.command({origin, AcquisitionMode::Fluoroscopy, 15, down, press}, now);
    }

    void wait(std::chrono::milliseconds duration)
    {
        now += duration;
        machine.tick(now);
    }

    // As the console presses: twice up under the press before, 50 ms apart, then down and down again.
    void say(std::uint32_t press, int order)
    {
        const bool down = order >= 2;
        pedal(down ? press : press - 1, down);
    }
};

using Happening = void (*)(Rig&);

const std::map<QByteArray, Happening> bars{
    {"stand-by", [](Rig& rig) { rig.machine.setStandBy(true, rig.now); }},
    {"stop or stall", [](Rig& rig) { rig.machine.interrupt("stop at the patient's side", rig.now); }},
};

} // namespace

class PedalAfterStopTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void pressThatWasBeginningTurnsNothingOn_data()
    {
        QTest::addColumn<QByteArray>("bar");
        QTest::addColumn<int>("heard");
        for (const auto& [name, happening] : bars) {
            QTest::addRow("%s, after no order of the press", name.constData()) << name << 0; // but the foot is down
            QTest::addRow("%s, after the first up", name.constData()) << name << 1;
            QTest::addRow("%s, after the second up", name.constData()) << name << 2;
        }
    }

    void pressThatWasBeginningTurnsNothingOn()
    {
        QFETCH(QByteArray, bar);
        QFETCH(int, heard);
        Rig rig;
        rig.pedal(6, false); // the release of the press before
        for (int order = 0; order < 20; ++order) {
            if (order == heard)
                bars.at(bar)(rig);
            rig.say(7, order);
            QVERIFY(!rig.machine.beamOn());
            rig.wait(50ms);
        }
        for (int order = 0; order < 3; ++order)
            rig.say(8, order);
        QVERIFY(rig.machine.beamOn());
    }

    void upCountsWhenItCanBeOfNoOlderPress_data()
    {
        QTest::addColumn<QByteArray>("bar");
        for (const auto& [name, happening] : bars)
            QTest::newRow(name.constData()) << name;
    }

    void upCountsWhenItCanBeOfNoOlderPress()
    {
        QFETCH(QByteArray, bar);
        Rig rig;
        rig.pedal(6, false);
        bars.at(bar)(rig);
        rig.wait(XrayMachine::lateUps - 1ms);
        rig.pedal(6, false);
        QVERIFY(!rig.pedal(7));
        rig.wait(1ms);
        QVERIFY(!rig.pedal(7));
        rig.pedal(7, false);
        QVERIFY(rig.pedal(8));
        QVERIFY(rig.machine.beamOn());
    }

    void eachPedalHasToBeHeardUpAgain_data() { upCountsWhenItCanBeOfNoOlderPress_data(); }

    void eachPedalHasToBeHeardUpAgain()
    {
        QFETCH(QByteArray, bar);
        Rig rig;
        rig.pedal(0, false);
        rig.pedal(4, false, otherCockpit);
        QVERIFY(rig.pedal(1));
        bars.at(bar)(rig);
        rig.wait(XrayMachine::lateUps);
        rig.pedal(1, false);
        QVERIFY(!rig.pedal(5, true, otherCockpit)); // another's foot came up
        QVERIFY(!rig.machine.beamOn());
        rig.pedal(5, false, otherCockpit);
        QVERIFY(rig.pedal(6, true, otherCockpit));
        QVERIFY(rig.machine.beamOn());
    }

    void endOfTheStandByIsNoUp()
    {
        Rig rig;
        rig.pedal(6, false);
        rig.machine.setStandBy(true, rig.now);
        rig.wait(1s);
        rig.machine.setStandBy(false, rig.now);
        QVERIFY(!rig.pedal(7));
        QVERIFY(!rig.machine.beamOn());
    }
};

QTEST_GUILESS_MAIN(PedalAfterStopTest)
#include "pedal_after_stop_test.moc"
