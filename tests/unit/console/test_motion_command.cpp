// The motion command as it leaves: each part of an order goes into the field of its name, and what a robot's set does not allow stays here.
#include "link/motion_command.hpp"

#include <QByteArray>
#include <QTest>

#include <limits>

using namespace console;

namespace {

/// The robot's set with `to` wherever `from` stands.
std::shared_ptr<const liena::MessageSet> robotSet(const QByteArray& from = {}, const QByteArray& to = {})
{
    const auto registered = liena::MessageSet::load(LIENA_SOURCE_DIR "/resources/devices/vascular-robot.xml").value();
    if (from.isEmpty())
        return registered;
    auto xml = QByteArray::fromStdString(registered->xml());
    if (!xml.contains(from))
        qFatal("the robot's set has no %s", from.constData());
    return liena::MessageSet::parse(xml.replace(from, to).toStdString(), "changed.xml").value();
}

MotionOrder someOrder() { return {41, 42, true, {1.5, -2.5, 3.5, -4.5}}; }

liena::Message written(const std::shared_ptr<const liena::MessageSet>& set, const MotionOrder& order)
{
    const auto binding = MotionBinding::to(set, "MotionCommand").value();
    liena::Message message(set, binding.definition());
    binding.write(motionFields(order), message);
    return message;
}

void compareOrder(const liena::Message& m)
{
    QVERIFY(!m.fault());
    QCOMPARE(m.get<quint32>("permit"), 41U);
    QCOMPARE(m.get<quint32>("sequence"), 42U);
    QVERIFY(m.get<bool>("engaged"));
    QCOMPARE(m.get<double>("guidewire_velocity"), 1.5);
    QCOMPARE(m.get<double>("guidewire_rotation"), -2.5);
    QCOMPARE(m.get<double>("catheter_velocity"), 3.5);
    QCOMPARE(m.get<double>("catheter_rotation"), -4.5);
}

} // namespace

class TestMotionCommand : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void isWrittenByItsNames() { compareOrder(written(robotSet(), someOrder())); }

    void fieldsThatTheConsoleDoesNotKnowKeepTheirDefaults()
    {
        const auto m = written(
            robotSet(
                R"(<field name="sequence" type)",
                R"(<field name="speed_scale" type="float32" min="0" max="1" default="0.5" title="Scale"/><field name="sequence" type)"),
            someOrder());
        compareOrder(m);
        QCOMPARE(m.get<double>("speed_scale"), 0.5);
    }

    void whatTheSetDoesNotAllowIsRefusedAsAWhole_data()
    {
        QTest::addColumn<double>("velocity");
        QTest::newRow("too fast") << 40.5;
        QTest::newRow("too fast backwards") << -40.5;
        QTest::newRow("no number") << std::numeric_limits<double>::quiet_NaN();
        QTest::newRow("infinite") << std::numeric_limits<double>::infinity();
    }

    /// The send gives such a message back.
    void whatTheSetDoesNotAllowIsRefusedAsAWhole()
    {
        QFETCH(double, velocity);
        auto order = someOrder();
        order.motion.catheterVelocity = velocity;
        const auto m = written(robotSet(), order);
        QVERIFY(m.fault());
        QVERIFY2(m.fault()->what.find("MotionCommand.catheter_velocity") != std::string::npos, m.fault()->what.c_str());
    }

    void aSetThatDoesNotFitIsRefusedInWords_data()
    {
        QTest::addColumn<QByteArray>("from");
        QTest::addColumn<QByteArray>("to");
        QTest::addColumn<QByteArray>("why");
        QTest::newRow("no such command") << QByteArray("name=\"MotionCommand\"") << QByteArray("name=\"MoveCommand\"")
                                         << QByteArray("has no message MotionCommand");
        QTest::newRow("field missing") << QByteArray("name=\"engaged\" type=\"bool\" title=\"The dead-man")
                                       << QByteArray("name=\"moves\" type=\"bool\" title=\"The dead-man")
                                       << QByteArray("has no field engaged");
        QTest::newRow("field of another type") << QByteArray("name=\"sequence\" type=\"uint32\" min=\"0\" max=\"4294967295\"")
                                               << QByteArray("name=\"sequence\" type=\"uint16\" min=\"0\" max=\"65535\"")
                                               << QByteArray("MotionCommand.sequence is uint16");
    }

    void aSetThatDoesNotFitIsRefusedInWords()
    {
        QFETCH(QByteArray, from);
        QFETCH(QByteArray, to);
        QFETCH(QByteArray, why);
        const auto bound = MotionBinding::to(robotSet(from, to), "MotionCommand");
        QVERIFY(!bound);
        QVERIFY2(QByteArray::fromStdString(bound.error().what).contains(why), bound.error().what.c_str());
    }
};

QTEST_GUILESS_MAIN(TestMotionCommand)
#include "test_motion_command.moc"
