// The console's measuring program of alarm and prompt, in its shortest run: one robot that is killed and one that is stopped. No figure is
// judged, and none can be: of so few rounds it tells that it cannot be told.
#include "child_process.hpp"
#include "limits.hpp"

#include <QTest>

using liena::test::ChildProcess;

namespace {

constexpr int patiences = 4; ///< of 30 s each, for one run

int endOf(ChildProcess& program)
{
    int end = program.waitForEnd();
    for (int i = 1; i < patiences && program.isRunning(); ++i)
        end = program.waitForEnd();
    return end;
}

} // namespace

class PromptBenchTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void aKilledAndAStoppedRobotAreMeasured()
    {
        ChildProcess rounds(QStringLiteral("prompt_bench"), {QStringLiteral("2")});
        const int end = endOf(rounds);
        const QString output = rounds.output();
        QVERIFY2(end == endNotKept, qPrintable(QStringLiteral("it ended with %1:\n").arg(end) + output));
        for (const auto* expected : {"process killed, its sockets closed:", "process stopped, silence:", "not told  "})
            QVERIFY2(output.contains(QLatin1String(expected)), qPrintable(output));
        for (const auto* strange : {"not measured", "NOT KEPT"})
            QVERIFY2(!output.contains(QLatin1String(strange)), qPrintable(output));
    }
};

QTEST_GUILESS_MAIN(PromptBenchTest)
#include "prompt_bench_test.moc"
