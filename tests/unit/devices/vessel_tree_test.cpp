// The vessel tree, its file, and the wire's way.
#include "vessel_tree.hpp"

#include "shared_data.hpp"

#include <QFile>
#include <QTest>

using namespace liena::devices;

class VesselTreeTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void resourceIsWhatTheGeneratorWrites()
    {
        QFile file(QStringLiteral(LIENA_SOURCE_DIR "/resources/vessels/cerebral.swc"));
        QVERIFY(file.open(QIODevice::ReadOnly));
        QCOMPARE(file.readAll().toStdString(), VesselTree::cerebral().toSwc());
    }

    void comesBackFromItsFile()
    {
        const VesselTree tree = VesselTree::cerebral();
        const VesselTree back = VesselTree::parse(tree.toSwc(), "cerebral").value();
        QCOMPARE(back.points.size(), tree.points.size());
        for (std::size_t index = 0; index < tree.points.size(); ++index) {
            QCOMPARE(back.points[index].position, tree.points[index].position);
            QCOMPARE(back.points[index].radius, tree.points[index].radius);
            QCOMPARE(back.points[index].parent, tree.points[index].parent);
        }
    }

    void builtInTreeIsPlausible()
    {
        const VesselTree tree = VesselTree::cerebral();
        QVERIFY(tree.points.size() > 800 && tree.points.size() < 2000);
        for (const auto& point : tree.points) {
            QVERIFY(point.radius >= 0.25 && point.radius < 16);
            if (point.parent) {
                const double step = length(point.position - tree.points[*point.parent].position);
                QVERIFY(step > 0.3 && step < 6);
            }
        }
        const VesselWay way(tree);
        QVERIFY(way.length() > 500 && way.length() < 900);
        QVERIFY(way.branches().size() >= 6);
        QVERIFY(way.at(0).radius > 8 && way.at(way.length()).radius < 1);
    }

    void wayIsContinuous()
    {
        const VesselWay way(VesselTree::cerebral());
        for (double arc = 0; arc < way.length(); arc += 0.5) {
            QVERIFY(length(way.at(arc + 0.5).position - way.at(arc).position) <= 0.5 + 1e-9);
            QVERIFY(std::abs(length(way.at(arc).direction) - 1) < 1e-9);
            QVERIFY(way.bendUntil(arc + 0.5) >= way.bendUntil(arc));
        }
        QCOMPARE(way.at(-10).position, way.at(0).position);
        QCOMPARE(way.at(1e6).position, way.at(way.length()).position);
    }

    void refusesWithPlaceAndRemedy_data()
    {
        QTest::addColumn<QByteArray>("text");
        QTest::addColumn<QByteArray>("expected");
        QTest::newRow("empty") << QByteArray("# nothing\n") << QByteArray("no vessel");
        QTest::newRow("letters") << QByteArray("1 3 0 0 0 1 -1\n2 3 a 0 0 1 1\n")
                                 << QByteArray("t.swc:2: this point has not seven numbers");
        QTest::newRow("too many") << QByteArray("1 3 0 0 0 1 -1 5\n") << QByteArray("more than seven");
        QTest::newRow("orphan") << QByteArray("1 3 0 0 0 1 -1\n2 3 50 0 0 1 7\n") << QByteArray("t.swc:2: this point names a parent");
        QTest::newRow("two roots") << QByteArray("1 3 0 0 0 1 -1\n2 3 50 0 0 1 -1\n") << QByteArray("second tree");
        QTest::newRow("own parent") << QByteArray("1 3 0 0 0 1 1\n") << QByteArray("names a parent");
        QTest::newRow("same id") << QByteArray("1 3 0 0 0 1 -1\n1 3 50 0 0 1 1\n") << QByteArray("repeats the id");
        QTest::newRow("no radius") << QByteArray("1 3 0 0 0 0 -1\n") << QByteArray("radius");
        QTest::newRow("not a number") << QByteArray("1 3 nan 0 0 1 -1\n") << QByteArray("farther than 5 m");
        QTest::newRow("short") << QByteArray("1 3 0 0 0 1 -1\n2 3 0 0 5 1 1\n") << QByteArray("shorter than 20 mm");
        QTest::newRow("huge id") << QByteArray("1e300 3 0 0 0 1 -1\n") << QByteArray("id");
    }

    void refusesWithPlaceAndRemedy()
    {
        QFETCH(QByteArray, text);
        QFETCH(QByteArray, expected);
        const auto tree = VesselTree::parse(text.toStdString(), "t.swc");
        QVERIFY(!tree);
        QVERIFY2(QByteArray::fromStdString(tree.error().what).contains(expected), tree.error().what.c_str());
    }

    void pointsAtTheSamePlaceAreHarmless()
    {
        const auto tree = VesselTree::parse("1 3 0 0 0 1 -1\n2 3 0 0 0 1 1\n3 3 0 0 30 1 2\n4 3 0 0 30 1 3\n", "t.swc");
        QVERIFY(tree);
        const VesselWay way(tree.value());
        QCOMPARE(way.at(15).position.z, 15.0);
        QVERIFY(std::isfinite(way.bendUntil(30)));
    }

    void readsARealTree()
    {
        const auto file = sharedData("vessels/brava_BG001.swc");
        if (!file)
            QSKIP("the shared data are not here");
        const auto tree = VesselTree::load(*file);
        QVERIFY(tree);
        QCOMPARE(tree.value().points.size(), 2810U);
        QVERIFY(VesselWay(tree.value()).length() > 200);
    }

    void missingFileIsNamed()
    {
        const auto tree = VesselTree::load("/nowhere/tree.swc");
        QVERIFY(!tree);
        QVERIFY(tree.error().what.find("/nowhere/tree.swc") != std::string::npos);
    }
};

QTEST_GUILESS_MAIN(VesselTreeTest)
#include "vessel_tree_test.moc"
