// From axes and triggers to a hand's motion: dead zone, scale, what is no number, and the gate that a hand passes once it was let go.
#include "input/hand_mapping.hpp"
#include "input/rest_gate.hpp"

#include <QTest>

#include <cmath>
#include <limits>

using namespace console;

namespace {

constexpr double noNumber = std::numeric_limits<double>::quiet_NaN();
constexpr double endless = std::numeric_limits<double>::infinity();
constexpr AxisShape shape{200, 0.1};

HandControls pushed()
{
    HandControls controls;
    controls.motion.guidewireVelocity = 10;
    controls.axesAtRest = false;
    return controls;
}

} // namespace

class TestHandMapping : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void deflectionGrowsFromTheEdgeOfTheDeadZone_data()
    {
        QTest::addColumn<double>("raw");
        QTest::addColumn<double>("part");
        QTest::newRow("zero") << 0.0 << 0.0;
        QTest::newRow("in the dead zone") << 19.0 << 0.0;
        QTest::newRow("at its edge") << -20.0 << 0.0;
        QTest::newRow("half way") << 110.0 << 0.5;
        QTest::newRow("half way back") << -110.0 << -0.5;
        QTest::newRow("full") << 200.0 << 1.0;
        QTest::newRow("beyond") << 1e300 << 1.0;
        QTest::newRow("beyond, back") << -32768.0 << -1.0;
    }

    void deflectionGrowsFromTheEdgeOfTheDeadZone()
    {
        QFETCH(double, raw);
        QFETCH(double, part);
        const auto value = deflection(raw, shape);
        QVERIFY(value.has_value());
        QVERIFY2(std::abs(*value - part) < 1e-12, qPrintable(QString::number(*value)));
    }

    void whatIsNoNumberMovesNothing_data()
    {
        QTest::addColumn<int>("axis");
        QTest::addColumn<double>("value");
        for (int axis = 0; axis < 4; ++axis)
            for (const double value : {noNumber, endless, -endless})
                QTest::addRow("axis %d is %g", axis, value) << axis << value;
    }

    void whatIsNoNumberMovesNothing()
    {
        QFETCH(int, axis);
        QFETCH(double, value);
        HandAxes axes{200, 200, 200, 200};
        (axis == 0 ? axes.guidewireAdvance : axis == 1 ? axes.guidewireTurn : axis == 2 ? axes.catheterAdvance : axes.catheterTurn) = value;
        const auto result = mapped(axes, shape, {}, Coupling::Both);
        QVERIFY(result.motion.isZero());
        QVERIFY(!result.atRest); // nobody knows where the axis is
    }

    void aShapeThatIsNoneMovesNothing_data()
    {
        QTest::addColumn<double>("fullScale");
        QTest::addColumn<double>("deadZone");
        QTest::newRow("no scale") << 0.0 << 0.1;
        QTest::newRow("negative scale") << -1.0 << 0.1;
        QTest::newRow("scale is no number") << noNumber << 0.1;
        QTest::newRow("all dead") << 1.0 << 1.0;
        QTest::newRow("dead zone is no number") << 1.0 << noNumber;
    }

    void aShapeThatIsNoneMovesNothing()
    {
        QFETCH(double, fullScale);
        QFETCH(double, deadZone);
        QVERIFY(!deflection(1, {fullScale, deadZone}));
    }

    void fullDeflectionIsTheSpeedOfAKey()
    {
        const HandSpeeds speeds;
        const auto result = mapped({200, -200, 200, -200}, shape, speeds, Coupling::Both);
        QCOMPARE(result.motion,
                 (HandMotion{speeds.guidewireVelocity, -speeds.guidewireRotation, speeds.catheterVelocity, -speeds.catheterRotation}));
        QVERIFY(!result.atRest);
        QVERIFY(mapped({15, -15, 3, 0}, shape, speeds, Coupling::Both).atRest);
    }

    void oneInstrumentAtATimeMoves()
    {
        const auto guidewire = mapped({200, 150, 190, 20}, shape, {}, Coupling::Larger).motion;
        QVERIFY(guidewire.guidewireVelocity > 0 && guidewire.guidewireRotation > 0);
        QVERIFY(guidewire.catheterVelocity == 0 && guidewire.catheterRotation == 0);
        const auto catheter = mapped({100, 0, 0, -180}, shape, {}, Coupling::Larger).motion;
        QVERIFY(catheter.guidewireVelocity == 0 && catheter.guidewireRotation == 0);
        QVERIFY(catheter.catheterRotation < 0);
    }

    void triggerDoesNotChatter()
    {
        TriggerButton trigger;
        QVERIFY(!trigger.update(0.55));
        QVERIFY(trigger.update(0.65));
        QVERIFY(trigger.update(0.45)); // between the two: as it was
        QVERIFY(!trigger.update(0.35));
        QVERIFY(!trigger.update(0.55));
        QVERIFY(trigger.update(1.0));
        QVERIFY(!trigger.update(noNumber));
    }

    void nothingCountsBeforeItWasLetGo_data()
    {
        QTest::addColumn<QString>("held");
        for (const auto* held : {"dead-man", "arm", "axis"})
            QTest::newRow(held) << QString::fromLatin1(held);
    }

    void nothingCountsBeforeItWasLetGo()
    {
        QFETCH(QString, held);
        HandControls controls;
        controls.deadMan = held == QLatin1String("dead-man");
        controls.arm = held == QLatin1String("arm");
        controls.axesAtRest = held != QLatin1String("axis");
        controls.motion.guidewireVelocity = controls.axesAtRest ? 0 : 10;
        RestGate gate;
        for (int i = 0; i < 3; ++i) {
            const auto counted = gate.pass(controls);
            QVERIFY(!gate.open() && !counted.deadMan && !counted.arm && counted.motion.isZero());
        }
        gate.pass({});
        QVERIFY(gate.open());
        const auto counted = gate.pass(controls);
        QVERIFY(counted.deadMan == controls.deadMan && counted.arm == controls.arm);
        QCOMPARE(counted.motion, controls.motion);
        gate.close();
        QVERIFY(!gate.open() && !gate.pass(controls).deadMan);
    }

    void aDeflectionAtTheEngageDoesNotMove()
    {
        RestGate gate;
        gate.pass({});
        QVERIFY(!gate.pass(pushed()).motion.isZero());
        gate.stillMotion();
        QVERIFY(gate.open());
        QVERIFY(gate.pass(pushed()).motion.isZero());
        gate.pass({});
        QVERIFY(!gate.pass(pushed()).motion.isZero());
    }
};

QTEST_GUILESS_MAIN(TestHandMapping)
#include "test_hand_mapping.moc"
