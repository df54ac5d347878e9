// What the lab refuses before it begins: it needs no rights for that.
#include "system/liena_program.hpp"

#include <QTest>

using namespace liena::test;

namespace {

ToolOutcome runLab(const QStringList& arguments)
{
    QProcess process;
    process.start(QStringLiteral(LIENA_PROGRAM_DIR "/lab"), arguments);
    return outcomeOf(process);
}

} // namespace

class LabOptionsTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void anUnknownFaultIsNoRunOfNone()
    {
        const auto unknown =
            runLab({QStringLiteral("--fault"), QStringLiteral("cut"), QStringLiteral("--fault"), QStringLiteral("kill-robots")});
        QCOMPARE(unknown.status, 2);
        QVERIFY2(unknown.errors.contains(QStringLiteral("no fault is called kill-robots; there are ")), qPrintable(unknown.errors));
        QVERIFY2(unknown.errors.contains(QStringLiteral(", kill-robot,")), qPrintable(unknown.errors));
        QCOMPARE(runLab({QStringLiteral("--fault"), QStringLiteral("kill-robot"), QStringLiteral("--list")}).status, 0);
    }

    void aFileThatCannotBeWrittenIsSaidBeforeTheRun()
    {
        const auto nowhere = runLab(
            {QStringLiteral("--fault"), QStringLiteral("cut"), QStringLiteral("--json"), QStringLiteral("/no/such/place/rows.json")});
        QCOMPARE(nowhere.status, 2);
        QVERIFY2(nowhere.errors.contains(QStringLiteral("/no/such/place/rows.json cannot be written: No such file")),
                 qPrintable(nowhere.errors));
    }
};

QTEST_GUILESS_MAIN(LabOptionsTest)
#include "options_test.moc"
