// The lines a person types at the patient's side.
#include "person_commands.hpp"

#include <QTest>

using namespace liena::devices;

Q_DECLARE_METATYPE(liena::devices::PersonAction)

class PersonCommandsTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void readsWhatIsTyped_data()
    {
        QTest::addColumn<QByteArray>("line");
        QTest::addColumn<PersonAction>("action");
        QTest::addColumn<QByteArray>("device");
        QTest::addColumn<QByteArray>("reason");
        QTest::newRow("open") << QByteArray("open robot") << PersonAction::Open << QByteArray("robot") << QByteArray();
        QTest::newRow("reopen") << QByteArray("  reopen\trobot \r\n") << PersonAction::ReOpen << QByteArray("robot") << QByteArray();
        QTest::newRow("close") << QByteArray("close cockpit") << PersonAction::Close << QByteArray("cockpit") << QByteArray();
        QTest::newRow("dismiss") << QByteArray("dismiss") << PersonAction::Dismiss << QByteArray() << QByteArray();
        QTest::newRow("dismiss why") << QByteArray("dismiss arm it is broken") << PersonAction::Dismiss << QByteArray("arm")
                                     << QByteArray("it is broken");
        QTest::newRow("stop") << QByteArray("stop") << PersonAction::EmergencyStop << QByteArray() << QByteArray();
        QTest::newRow("stop why") << QByteArray("stop patient moves") << PersonAction::EmergencyStop << QByteArray()
                                  << QByteArray("patient moves");
        QTest::newRow("clear") << QByteArray("clear") << PersonAction::ClearToArm << QByteArray() << QByteArray();
        QTest::newRow("wait") << QByteArray(" wait ") << PersonAction::Wait << QByteArray() << QByteArray();
        QTest::newRow("status") << QByteArray("status") << PersonAction::Status << QByteArray() << QByteArray();
    }

    void readsWhatIsTyped()
    {
        QFETCH(QByteArray, line);
        QFETCH(PersonAction, action);
        QFETCH(QByteArray, device);
        QFETCH(QByteArray, reason);
        const auto command = parsePersonCommand(line.toStdString());
        QVERIFY(command);
        QCOMPARE(command->action, action);
        QCOMPARE(QByteArray::fromStdString(command->device), device);
        QCOMPARE(QByteArray::fromStdString(command->reason), reason);
    }

    void refusesTheRest_data()
    {
        QTest::addColumn<QByteArray>("line");
        for (const char* line : {"", "   ", "open", "reopen", "open robot now", "OPEN robot", "status now", "opened robot", "exit",
                                 "clear robot", "Clear", "wait 5"})
            QTest::newRow(line) << QByteArray(line);
    }

    void refusesTheRest()
    {
        QFETCH(QByteArray, line);
        QVERIFY(!parsePersonCommand(line.toStdString()));
    }
};

QTEST_GUILESS_MAIN(PersonCommandsTest)
#include "person_commands_test.moc"
