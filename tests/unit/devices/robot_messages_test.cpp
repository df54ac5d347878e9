// The robot's frequent messages as structures: each member is the field of its name, and a set that does not fit is refused in words.
#include "robot_messages.hpp"

#include <QByteArray>
#include <QTest>

#include <string>

using namespace liena;
using namespace liena::devices;

namespace {

std::shared_ptr<const MessageSet> registered()
{
    return MessageSet::load(LIENA_SOURCE_DIR "/resources/devices/vascular-robot.xml").value();
}

/// The robot's set with `to` wherever `from` stands.
std::shared_ptr<const MessageSet> changed(const QByteArray& from, const QByteArray& to)
{
    auto xml = QByteArray::fromStdString(registered()->xml());
    if (!xml.contains(from))
        qFatal("the robot's set has no %s", from.constData());
    return MessageSet::parse(xml.replace(from, to).toStdString(), "changed.xml").value();
}

Message motionCommand(const std::shared_ptr<const MessageSet>& set)
{
    Message message(set, *set->find("MotionCommand"));
    message.set("permit", 41U).set("sequence", 42U).set("engaged", true);
    message.set("guidewire_velocity", 1.5).set("guidewire_rotation", -2.5).set("catheter_velocity", 3.5).set("catheter_rotation", -4.5);
    return message;
}

void compareMotion(const MotionFields& fields)
{
    QCOMPARE(fields.permit, 41U);
    QCOMPARE(fields.sequence, 42U);
    QVERIFY(fields.engaged);
    QCOMPARE(fields.guidewireVelocity, 1.5F);
    QCOMPARE(fields.guidewireRotation, -2.5F);
    QCOMPARE(fields.catheterVelocity, 3.5F);
    QCOMPARE(fields.catheterRotation, -4.5F);
}

/// No two of a kind are the same, and none is a default.
StatusFields someStatus()
{
    return {.state = RobotState::Engaged,
            .permit = 11,
            .owner = 12,
            .engaged = true,
            .holdConfirmed = false,
            .holdSince = 13,
            .lastSequence = 14,
            .appliedCommands = 15,
            .refusedCommands = 16,
            .guidewirePosition = 17.5F,
            .guidewireAngle = 18.25,
            .catheterPosition = 19.5F,
            .catheterAngle = -20.25,
            .guidewireVelocity = 21.5F,
            .guidewireRotation = -22.5F,
            .catheterVelocity = 23.5F,
            .catheterRotation = -24.5F,
            .guidewireForce = 2.5F,
            .guidewireTorque = -26.5F,
            .guidewireGripperClosed = true,
            .catheterGripperClosed = false,
            .limitSwitches = 0x82,
            .contrastRemaining = 28.5F,
            .emergencyStopToken = 29,
            .fault = RobotFault::Watchdog,
            .clearance = Clearance::Given};
}

} // namespace

class RobotMessagesTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void everyFieldOfTheRegistersSetIsBound();
    void motionCommandIsReadByItsNames();
    void statusIsWrittenByItsNames();
    void truthsOfTheStatusAreWrittenByTheirNames();
    void refusesASetThatDoesNotFit_data();
    void refusesASetThatDoesNotFit();
    void aSetWithMoreFieldsIsBound();
    void messageOfAnotherSetIsNotRead();
};

/// A field that the set gains is to be filled in as well.
void RobotMessagesTest::everyFieldOfTheRegistersSetIsBound()
{
    const auto bindings = RobotBindings::to(registered()).value();
    QCOMPARE(bindings.motion.definition().fields.size(), std::size_t{7});
    QCOMPARE(bindings.status.definition().fields.size(), std::size_t{26});
}

void RobotMessagesTest::motionCommandIsReadByItsNames()
{
    const auto set = registered();
    MotionFields fields;
    QVERIFY(RobotBindings::to(set).value().motion.read(motionCommand(set), fields));
    compareMotion(fields);
}

void RobotMessagesTest::statusIsWrittenByItsNames()
{
    const auto bindings = RobotBindings::to(registered()).value();
    Message m(bindings.status.messageSet(), bindings.status.definition());
    QVERIFY(bindings.status.write(someStatus(), m));
    QCOMPARE(m.get<std::string>("state"), std::string("Engaged"));
    QCOMPARE(m.get<int>("permit"), 11);
    QCOMPARE(m.get<int>("owner"), 12);
    QCOMPARE(m.get<int>("hold_since_ns"), 13);
    QCOMPARE(m.get<int>("last_sequence"), 14);
    QCOMPARE(m.get<int>("applied_commands"), 15);
    QCOMPARE(m.get<int>("refused_commands"), 16);
    QCOMPARE(m.get<double>("guidewire_position"), 17.5);
    QCOMPARE(m.get<double>("guidewire_angle"), 18.25);
    QCOMPARE(m.get<double>("catheter_position"), 19.5);
    QCOMPARE(m.get<double>("catheter_angle"), -20.25);
    QCOMPARE(m.get<double>("guidewire_velocity"), 21.5);
    QCOMPARE(m.get<double>("guidewire_rotation"), -22.5);
    QCOMPARE(m.get<double>("catheter_velocity"), 23.5);
    QCOMPARE(m.get<double>("catheter_rotation"), -24.5);
    QCOMPARE(m.get<double>("guidewire_force"), 2.5);
    QCOMPARE(m.get<double>("guidewire_torque"), -26.5);
    QCOMPARE(m.get<int>("limit_switches"), 0x82);
    QCOMPARE(m.get<double>("contrast_remaining"), 28.5);
    QCOMPARE(m.get<int>("emergency_stop_token"), 29);
    QCOMPARE(m.get<int>("fault_code"), 3);
    QCOMPARE(m.get<std::string>("clear_to_arm"), std::string("Given"));
}

/// One at a time: they have but two values.
void RobotMessagesTest::truthsOfTheStatusAreWrittenByTheirNames()
{
    const auto bindings = RobotBindings::to(registered()).value();
    const std::pair<const char*, bool StatusFields::*> truths[] = {{"engaged", &StatusFields::engaged},
                                                                   {"hold_confirmed", &StatusFields::holdConfirmed},
                                                                   {"guidewire_gripper_closed", &StatusFields::guidewireGripperClosed},
                                                                   {"catheter_gripper_closed", &StatusFields::catheterGripperClosed}};
    for (const auto& [chosen, member] : truths) {
        StatusFields fields;
        fields.*member = true;
        Message m(bindings.status.messageSet(), bindings.status.definition());
        QVERIFY(bindings.status.write(fields, m));
        for (const auto& [name, other] : truths)
            QCOMPARE(m.get<bool>(name), other == member);
    }
}

void RobotMessagesTest::refusesASetThatDoesNotFit_data()
{
    QTest::addColumn<QByteArray>("from");
    QTest::addColumn<QByteArray>("to");
    QTest::addColumn<QByteArray>("named");
    QTest::addColumn<QByteArray>("why");
    const auto row = [](const char* name, const char* from, const char* to, const char* named, const char* why) {
        QTest::newRow(name) << QByteArray(from) << QByteArray(to) << QByteArray(named) << QByteArray(why);
    };
    row("no such command", "name=\"MotionCommand\"", "name=\"MoveCommand\"", "has no message MotionCommand", "bind one that it has");
    row("field of the command missing", "name=\"sequence\" type", "name=\"number\" type", "MotionCommand of message set vascular-robot",
        "has no field sequence: correct the binding, or the set");
    row("field of the command of another type", "name=\"guidewire_velocity\" type=\"float32\" unit=\"mm/s\" min=\"-40\"",
        "name=\"guidewire_velocity\" type=\"float64\" unit=\"mm/s\" min=\"-40\"", "MotionCommand.guidewire_velocity is float64",
        "make the member double");
    row("field of the status missing", "name=\"clear_to_arm\"", "name=\"clearance\"", "RobotStatus of message set vascular-robot",
        "has no field clear_to_arm: correct the binding, or the set");
    row("field of the status of another type", "name=\"owner\" type=\"uint32\"", "name=\"owner\" type=\"uint64\"",
        "RobotStatus.owner is uint64", "make the member std::uint64_t");
}

void RobotMessagesTest::refusesASetThatDoesNotFit()
{
    QFETCH(const QByteArray, from);
    QFETCH(const QByteArray, to);
    QFETCH(const QByteArray, named);
    QFETCH(const QByteArray, why);
    const auto bindings = RobotBindings::to(changed(from, to));
    QVERIFY(!bindings);
    const auto said = QByteArray::fromStdString(bindings.error().what);
    QVERIFY2(said.contains(named) && said.contains(why), said.constData());
}

/// Wherever they stand: they keep their own values.
void RobotMessagesTest::aSetWithMoreFieldsIsBound()
{
    const auto set =
        changed(R"(<field name="sequence" type)",
                R"(<field name="speed_scale" type="float32" min="0" max="1" default="1" title="Scale"/><field name="sequence" type)");
    MotionFields fields;
    QVERIFY(RobotBindings::to(set).value().motion.read(motionCommand(set), fields));
    compareMotion(fields);
}

/// Not even when it looks the same: another device reports what it likes under the name of a command.
void RobotMessagesTest::messageOfAnotherSetIsNotRead()
{
    const auto bindings = RobotBindings::to(registered()).value();
    MotionFields fields;
    fields.permit = 7;
    QVERIFY(!bindings.motion.read(motionCommand(changed("vendor=\"Medsight\"", "vendor=\"Other\"")), fields));
    QCOMPARE(fields.permit, 7U);
    QVERIFY(!fields.engaged);
}

QTEST_GUILESS_MAIN(RobotMessagesTest)
#include "robot_messages_test.moc"
