// `liena check` as a person runs it.
#include <QFile>
#include <QProcess>
#include <QTemporaryDir>
#include <QTest>

class CheckCommandTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void passesTheReferenceFiles();
    void printsFindingsInEditorForm();
    void passesWithWarnings();
    void failsOnMissingFile();
    void refusesWrongUse_data();
    void refusesWrongUse();
    void teaches();
    void saysItsVersion();

private:
    struct Outcome {
        int exitCode = -1;
        QString output;
        QString errors;
    };

    static Outcome run(const QStringList& arguments);
    static QString source(const char* relative) { return QStringLiteral(LIENA_SOURCE_DIR "/") + QLatin1String(relative); }
};

CheckCommandTest::Outcome CheckCommandTest::run(const QStringList& arguments)
{
    QProcess process;
    process.start(QStringLiteral(LIENA_PROGRAM_DIR "/liena"), arguments);
    if (!process.waitForFinished() || process.exitStatus() != QProcess::NormalExit)
        return {};
    return {process.exitCode(), QString::fromUtf8(process.readAllStandardOutput()), QString::fromUtf8(process.readAllStandardError())};
}

void CheckCommandTest::passesTheReferenceFiles()
{
    const auto outcome = run({QStringLiteral("check"), source("topologies/cerebrovascular.xml"),
                              source("resources/devices/vascular-robot.xml"), source("resources/devices/siat-cockpit.xml"),
                              source("resources/devices/arm-grasper.xml"), source("resources/devices/cbct-xray.xml")});
    QCOMPARE(outcome.exitCode, 0);
    QCOMPARE(outcome.output, QStringLiteral("5 files checked: 0 errors, 0 warnings\n"));
    QCOMPARE(outcome.errors, QString());
}

void CheckCommandTest::printsFindingsInEditorForm()
{
    const QTemporaryDir folder;
    QFile file(folder.filePath(QStringLiteral("bad.xml")));
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write("<topology xmlns=\"urn:liena:topology:1\" name=\"t\" version=\"1\">\n<devise/>\n</topology>\n");
    file.close();
    const auto outcome = run({QStringLiteral("check"), file.fileName()});
    QCOMPARE(outcome.exitCode, 1);
    QCOMPARE(outcome.output, QStringLiteral("1 file checked: 2 errors, 0 warnings\n"));
    QVERIFY2(outcome.errors.contains(file.fileName() +
                                     QStringLiteral(":2:1: error: <topology> knows no element 'devise'; did you mean 'device'?\n")),
             qPrintable(outcome.errors));
}

void CheckCommandTest::passesWithWarnings()
{
    const auto outcome =
        run({QStringLiteral("check"), source("topologies/loopback_pair.xml"), source("resources/devices/vascular-robot.xml")});
    QCOMPARE(outcome.exitCode, 0);
    QCOMPARE(outcome.output, QStringLiteral("2 files checked: 0 errors, 1 warning\n"));
    QVERIFY2(outcome.errors.contains(QStringLiteral("warning: no message set among the files describes 0x40018208")),
             qPrintable(outcome.errors));
}

void CheckCommandTest::failsOnMissingFile()
{
    const auto outcome = run({QStringLiteral("check"), QStringLiteral("/nonexistent.xml")});
    QCOMPARE(outcome.exitCode, 1);
    QVERIFY(outcome.errors.contains(QStringLiteral("/nonexistent.xml")));
}

void CheckCommandTest::refusesWrongUse_data()
{
    QTest::addColumn<QStringList>("arguments");
    QTest::newRow("nothing") << QStringList();
    QTest::newRow("unknown command") << QStringList{QStringLiteral("chek")};
    QTest::newRow("no file") << QStringList{QStringLiteral("check")};
    QTest::newRow("unknown option") << QStringList{QStringLiteral("check"), QStringLiteral("--fast"), QStringLiteral("x.xml")};
}

void CheckCommandTest::refusesWrongUse()
{
    QFETCH(QStringList, arguments);
    const auto outcome = run(arguments);
    QCOMPARE(outcome.exitCode, 2);
    QVERIFY(outcome.errors.contains(QStringLiteral("--help")));
}

void CheckCommandTest::teaches()
{
    const auto overview = run({QStringLiteral("--help")});
    QCOMPARE(overview.exitCode, 0);
    QVERIFY(overview.output.contains(QStringLiteral("check")));
    QVERIFY(overview.output.contains(QStringLiteral("Exit codes")));
    const auto command = run({QStringLiteral("check"), QStringLiteral("--help")});
    QCOMPARE(command.exitCode, 0);
    QVERIFY(command.output.contains(QStringLiteral("liena check topologies/cerebrovascular.xml")));
    QVERIFY(command.output.contains(QStringLiteral("Exit codes")));
}

void CheckCommandTest::saysItsVersion()
{
    const auto outcome = run({QStringLiteral("--version")});
    QCOMPARE(outcome.exitCode, 0);
    QVERIFY2(outcome.output.startsWith(QStringLiteral("liena ")), qPrintable(outcome.output));
}

QTEST_GUILESS_MAIN(CheckCommandTest)
#include "check_command_test.moc"
