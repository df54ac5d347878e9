// Which master and which language liena-console is told to begin with.
#include "app/command_line.hpp"

#include <QTest>

using namespace console;

namespace {

CommandLine read(const QString& options)
{
    auto arguments = options.split(QLatin1Char(' '), Qt::SkipEmptyParts);
    return readCommandLine(QStringList{QStringLiteral("liena-console"), QStringLiteral("--topology"), QStringLiteral("t.xml")} + arguments);
}

} // namespace

class TestCommandLine : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void takesAMaster_data()
    {
        QTest::addColumn<QString>("options");
        QTest::addColumn<MasterKind>("master");
        QTest::newRow("none named") << QString() << MasterKind::Keyboard;
        QTest::newRow("keyboard") << QStringLiteral("--master keyboard") << MasterKind::Keyboard;
        QTest::newRow("spacemouse") << QStringLiteral("--master spacemouse") << MasterKind::SpaceMouse;
        QTest::newRow("gamepad") << QStringLiteral("--master gamepad") << MasterKind::GamePad;
        QTest::newRow("haptic") << QStringLiteral("--master haptic-simulated") << MasterKind::HapticSimulated;
        QTest::newRow("recorded") << QStringLiteral("--master recorded --recording a.csv") << MasterKind::Recorded;
        QTest::newRow("a recording alone") << QStringLiteral("--recording a.csv") << MasterKind::Recorded;
        QTest::newRow("a recording kept aside") << QStringLiteral("--recording a.csv --master keyboard") << MasterKind::Keyboard;
        QTest::newRow("unattended") << QStringLiteral("--unattended 5") << MasterKind::Recorded;
    }

    void takesAMaster()
    {
        QFETCH(QString, options);
        QFETCH(MasterKind, master);
        const auto line = read(options);
        QVERIFY2(line.outcome == CommandLine::Outcome::Run, qPrintable(line.text));
        QCOMPARE(line.options.master, master);
    }

    void takesALanguage()
    {
        QCOMPARE(read({}).options.language, QString());
        QCOMPARE(read(QStringLiteral("--language zh_CN")).options.language, QStringLiteral("zh_CN"));
        QCOMPARE(read(QStringLiteral("--language en")).options.language, QStringLiteral("en"));
    }

    void refusesALanguageItDoesNotSpeak()
    {
        for (const char* name : {"klingon", "zh", "en_GB", "../en"}) {
            const auto line = read(QStringLiteral("--language %1").arg(QString::fromLatin1(name)));
            QCOMPARE(line.outcome, CommandLine::Outcome::Mistake);
            QVERIFY2(line.text.startsWith(QStringLiteral("--language '%1': choose en or zh_CN").arg(QString::fromLatin1(name))),
                     qPrintable(line.text));
        }
    }

    void knowsWhoMayDoWhatAndWhoThePatientIs()
    {
        const auto plain = read(QString());
        QCOMPARE(plain.options.role, OperatorRole::Operator);
        QVERIFY(plain.options.patient.isEmpty());
        const auto told = read(QStringLiteral("--role observer --patient Wang --patient-id A-1234"));
        QCOMPARE(told.outcome, CommandLine::Outcome::Run);
        QCOMPARE(told.options.role, OperatorRole::Observer);
        QCOMPARE(told.options.patient, QStringLiteral("Wang"));
        QCOMPARE(told.options.patientId, QStringLiteral("A-1234"));
    }

    void refusesPeople_data()
    {
        QTest::addColumn<QString>("options");
        QTest::addColumn<QString>("reason");
        QTest::newRow("role") << QStringLiteral("--role surgeon") << QStringLiteral("--role 'surgeon': choose operator or observer");
        QTest::newRow("observer that arms") << QStringLiteral("--role observer --unattended 5")
                                            << QStringLiteral("--role observer: an unattended run arms");
        QTest::newRow("no number") << QStringLiteral("--patient Wang") << QStringLiteral("named by two identifiers");
        QTest::newRow("number too long") << QStringLiteral("--patient Wang --patient-id A-12345678901234567890123456789012")
                                         << QStringLiteral("--patient-id: 34 characters, at most 32");
        QTest::newRow("no name") << QStringLiteral("--patient-id A-1234") << QStringLiteral("named by two identifiers");
    }

    void refusesPeople()
    {
        QFETCH(QString, options);
        QFETCH(QString, reason);
        const auto line = read(options);
        QCOMPARE(line.outcome, CommandLine::Outcome::Mistake);
        QVERIFY2(line.text.contains(reason), qPrintable(line.text));
    }

    void takesWhatTheNetworkThreadAsksFor()
    {
        const auto plain = read(QString()).options.network;
        QVERIFY(plain.realTimePriority == 0 && plain.processors.isEmpty() && !plain.lockMemory && plain.busyPollUs == 0);
        QVERIFY(plain.commandMark == 46 && plain.imageMark == 34);
        const auto line = read(QStringLiteral("--realtime-priority 50 --processors 2,3 --lock-memory --card-poll 40 --mark-commands 0 "
                                              "--mark-images 10"));
        QVERIFY2(line.outcome == CommandLine::Outcome::Run, qPrintable(line.text));
        const auto& told = line.options.network;
        QCOMPARE(told.processors, (QList<int>{2, 3}));
        QVERIFY(told.realTimePriority == 50 && told.lockMemory && told.cardPollUs == 40 && told.commandMark == 0 && told.imageMark == 10);
        QCOMPARE(read(QStringLiteral("--busy-poll 50")).options.network.busyPollUs, 50);
    }

    void refusesWhatTheNetworkThreadCannotHave_data()
    {
        QTest::addColumn<QString>("options");
        QTest::addColumn<QString>("reason");
        QTest::newRow("priority") << QStringLiteral("--realtime-priority 100") << QStringLiteral("'100': give 1 to 99");
        QTest::newRow("no priority") << QStringLiteral("--realtime-priority high") << QStringLiteral("'high': give 1 to 99");
        QTest::newRow("processors") << QStringLiteral("--processors 1,x") << QStringLiteral("--processors '1,x': give their numbers");
        QTest::newRow("poll") << QStringLiteral("--busy-poll 2000000") << QStringLiteral("'2000000': give 0 to 1000000");
        QTest::newRow("mark") << QStringLiteral("--mark-commands 64") << QStringLiteral("--mark-commands '64': give 0 to 63");
        QTest::newRow("mark of images") << QStringLiteral("--mark-images -1") << QStringLiteral("--mark-images '-1': give 0 to 63");
    }

    void refusesWhatTheNetworkThreadCannotHave()
    {
        QFETCH(QString, options);
        QFETCH(QString, reason);
        const auto line = read(options);
        QCOMPARE(line.outcome, CommandLine::Outcome::Mistake);
        QVERIFY2(line.text.contains(reason), qPrintable(line.text));
    }

    void refusesAMaster_data()
    {
        QTest::addColumn<QString>("options");
        QTest::addColumn<QString>("reason");
        QTest::newRow("unknown") << QStringLiteral("--master mouse") << QStringLiteral("--master 'mouse': choose keyboard");
        QTest::newRow("recorded without a recording") << QStringLiteral("--master recorded") << QStringLiteral("--recording FILE");
        QTest::newRow("unattended by a pad") << QStringLiteral("--master gamepad --unattended 5")
                                             << QStringLiteral("with --unattended only a recorded hand moves");
    }

    void refusesAMaster()
    {
        QFETCH(QString, options);
        QFETCH(QString, reason);
        const auto line = read(options);
        QCOMPARE(line.outcome, CommandLine::Outcome::Mistake);
        QVERIFY2(line.text.contains(reason), qPrintable(line.text));
    }
};

QTEST_GUILESS_MAIN(TestCommandLine)
#include "test_command_line.moc"
