// The measuring of meshes counts what it must: no figure is judged, every count is.
#include "scale/scale_table.hpp"

#include <QTest>

#include <csignal>

using namespace liena::bench;

class ScaleTest : public QObject {
    Q_OBJECT

private:
    static ScaleOptions shortRun()
    {
        ScaleOptions options;
        options.heartbeat = std::chrono::milliseconds(50);
        options.seconds = 0.5;
        options.rounds = 1;
        options.rate = 100;
        options.program = std::filesystem::path(LIENA_PROGRAM_DIR) / "scale_bench";
        return options;
    }

private Q_SLOTS:
    void initTestCase() { std::signal(SIGPIPE, SIG_IGN); } // one of the meshes loses a device

    void everyPairHasASessionAndEveryQuestionAnAnswer_data()
    {
        QTest::addColumn<int>("devices");
        QTest::newRow("two") << 2;
        QTest::newRow("four") << 4;
    }

    void everyPairHasASessionAndEveryQuestionAnAnswer()
    {
        QFETCH(int, devices);
        const auto row = measureScale(static_cast<std::size_t>(devices), shortRun());
        QCOMPARE(QString::fromStdString(row.faults.empty() ? std::string() : row.faults.front()), QString());
        QCOMPARE(row.sessionEnds, static_cast<std::size_t>(devices * (devices - 1)));
        for (const auto* loads : {&row.loads, &row.plain}) {
            QVERIFY(loads->heartbeatsPerSecond > 0);
            QVERIFY(loads->messagesPerSecond > 0);
        }
        QVERIFY(row.descriptors >= 2 * (devices - 1));
        QVERIFY(scaleTable({row}, shortRun()).find(QString("| %1 | %2 |").arg(devices).arg(devices * (devices - 1) / 2).toStdString()) !=
                std::string::npos);
    }

    void whatIsLostInTheNoiseIsNoFigure()
    {
        ScaleRow row;
        row.devices = row.sessionEnds = 2;
        row.loads.closed = 0.05;
        row.loads.idle = {0.09, 0.11};
        row.loads.asking = {0.105, 0.105}; // half of what the idle load varies by
        row.loads.heartbeatsPerSecond = row.loads.messagesPerSecond = 100;
        row.plain = row.loads;
        row.plain.closed = 0.08;
        row.plain.asking = {0.12};
        const auto table = QString::fromStdString(scaleTable({row}, shortRun()));
        QVERIFY2(table.contains(QStringLiteral("| 500.0 / 200.0 = 2.50 | – / 200.0 |")), qPrintable(table));
    }

    void aSessionThatIsMissingIsAFault()
    {
        MeshPlan plan{2, timingFor(std::chrono::milliseconds(50)), 100, shortRun().program};
        Mesh mesh(plan);
        QCOMPARE(mesh.counts().sessionEnds, std::uint64_t{0});
        mesh.open();
        QCOMPARE(mesh.counts().sessionEnds, std::uint64_t{2});
        mesh.end(1);
        QVERIFY_THROWS_EXCEPTION(std::runtime_error, mesh.counts());
    }

    void saysWhatTheLimitsDoNotAllow()
    {
        QCOMPARE(meshRefusal(64, 1024), std::string());
        const auto refusal = QString::fromStdString(meshRefusal(64, 128));
        QVERIFY2(refusal.contains("64 devices need 192 open files") && refusal.contains("ulimit -n 192"), qPrintable(refusal));
    }
};

QTEST_GUILESS_MAIN(ScaleTest)
#include "scale_test.moc"
