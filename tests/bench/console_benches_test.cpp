// The console's measuring programs in the shortest run that each has. No figure is judged, and none can be: of so short a run they tell
// that it cannot be told.
#include "child_process.hpp"
#include "limits.hpp"

#include <QTest>

using liena::test::ChildProcess;

namespace {

/// What is wrong with how it ended; empty when it measured, said so and kept no limit.
QString troubleOf(ChildProcess& bench, const QString& measured)
{
    const int end = bench.waitForEnd();
    const QString output = bench.output();
    if (end != endNotKept)
        return QStringLiteral("it ended with %1:\n").arg(end) + output;
    for (const auto* sanitizer : {"Sanitizer", "runtime error"})
        if (output.contains(QLatin1String(sanitizer)))
            return output;
    const bool told = output.contains(measured) && output.contains(QStringLiteral("not told  "));
    return told ? QString() : QStringLiteral("it does not say what it measured:\n") + output;
}

} // namespace

class ConsoleBenchesTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void flapsArePaintedAndCounted()
    {
        ChildProcess flaps(QStringLiteral("flap_bench"), {QStringLiteral("5"), QStringLiteral("1")});
        const QString trouble = troubleOf(flaps, QStringLiteral("5 flaps in "));
        QVERIFY2(trouble.isEmpty(), qPrintable(trouble));
        QVERIFY2(!flaps.output().contains(QStringLiteral("not measured")),
                 qPrintable(flaps.output())); // pictures and the window were painted
    }

    /// Side by side, since most of their time they wait for the alarms' self-test before they can arm.
    void theWholeConsoleIsMeasured()
    {
        ChildProcess prompts(QStringLiteral("prompt_bench"), {QStringLiteral("1")});
        ChildProcess endurance(QStringLiteral("endurance_bench"), {QStringLiteral("1"), QStringLiteral("256"), QStringLiteral("15")});
        const QString ofPrompts = troubleOf(prompts, QStringLiteral("(1)"));            // values in each row
        const QString ofEndurance = troubleOf(endurance, QStringLiteral("\n     1  ")); // the row of its first minute
        QVERIFY2(ofPrompts.isEmpty(), qPrintable(ofPrompts));
        QVERIFY2(ofEndurance.isEmpty(), qPrintable(ofEndurance));
    }
};

QTEST_GUILESS_MAIN(ConsoleBenchesTest)
#include "console_benches_test.moc"
