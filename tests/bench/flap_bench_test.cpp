// The console's measuring program that needs no devices beside it, in its shortest run. No figure is judged, and none can be: of so short a
// run it tells that it cannot be told. (Those with the whole system keep their deadlines without sanitizers only.)
#include "child_process.hpp"
#include "limits.hpp"

#include <QTest>

using liena::test::ChildProcess;

class FlapBenchTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void flapsArePaintedAndCounted()
    {
        ChildProcess flaps(QStringLiteral("flap_bench"), {QStringLiteral("5"), QStringLiteral("1")});
        const int end = flaps.waitForEnd();
        const QString output = flaps.output();
        QVERIFY2(end == endNotKept, qPrintable(QStringLiteral("it ended with %1:\n").arg(end) + output));
        for (const auto* expected : {"5 flaps in ", "alarms raised ", "not told  "})
            QVERIFY2(output.contains(QLatin1String(expected)), qPrintable(output));
        for (const auto* strange : {"not measured", "Sanitizer", "runtime error"}) // pictures and the window were painted
            QVERIFY2(!output.contains(QLatin1String(strange)), qPrintable(output));
    }
};

QTEST_GUILESS_MAIN(FlapBenchTest)
#include "flap_bench_test.moc"
