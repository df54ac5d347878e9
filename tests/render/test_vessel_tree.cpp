// Tests of the vessel tree's reader and of the way along it.
#include "imaging/vessel_tree.hpp"

#include <QTemporaryDir>
#include <QtTest>

using namespace console;

class TestVesselTree : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void readsPointsRadiiAndParents();
    void refusesBadFilesNamingTheLine_data();
    void refusesBadFilesNamingTheLine();
    void saysWhichFileIsMissing();
    void findsTheWayFromTheRoot();
    void claimsNoWayToAPointOutsideTheVessels();
    void readsAMeasuredTree();

private:
    QString write(const QByteArray& content);
    QTemporaryDir m_folder;
};

QString TestVesselTree::write(const QByteArray& content)
{
    const QString path = m_folder.filePath(QStringLiteral("tree.swc"));
    QFile file(path);
    if (!file.open(QIODevice::WriteOnly) || file.write(content) != content.size())
        qFatal("the test's file could not be written");
    return path;
}

void TestVesselTree::readsPointsRadiiAndParents()
{
    const auto result = readVesselTree(write("# a comment\n 1 2 0 0 0 2.5 -1\n\n2 2  1.5 -2 3e1 1 1\r\n3 2 4 4 4 0.5 1\n"));
    QVERIFY2(result.tree, qPrintable(result.error));
    const auto& points = result.tree->points;
    QCOMPARE(points.size(), std::size_t(3));
    QCOMPARE(points[0].parent, -1);
    QCOMPARE(points[0].radius, 2.5F);
    QCOMPARE(points[1].position, QVector3D(1.5F, -2, 30));
    QCOMPARE(points[1].parent, 0);
    QCOMPARE(points[2].parent, 0);
}

void TestVesselTree::refusesBadFilesNamingTheLine_data()
{
    QTest::addColumn<QByteArray>("content");
    QTest::addColumn<QString>("says");
    QTest::newRow("empty") << QByteArray("# nothing\n") << QStringLiteral("holds no vessel point");
    QTest::newRow("too few words") << QByteArray("1 2 0 0 0 1 -1\n2 2 0 0\n") << QStringLiteral(".swc:2: seven numbers");
    QTest::newRow("no number") << QByteArray("1 2 0 zero 0 1 -1\n") << QStringLiteral(".swc:1: a number cannot be read");
    QTest::newRow("not finite") << QByteArray("1 2 0 nan 0 1 -1\n") << QStringLiteral(".swc:1: a number cannot be read");
    QTest::newRow("far away") << QByteArray("1 2 0 1e30 0 1 -1\n") << QStringLiteral("out of range");
    QTest::newRow("negative radius") << QByteArray("1 2 0 0 0 -1 -1\n") << QStringLiteral("out of range");
    QTest::newRow("same number twice") << QByteArray("1 2 0 0 0 1 -1\n1 2 0 0 1 1 -1\n") << QStringLiteral(".swc:2: the point number");
    QTest::newRow("unknown parent") << QByteArray("1 2 0 0 0 1 7\n") << QStringLiteral("the parent must stand before");
    QTest::newRow("its own parent") << QByteArray("1 2 0 0 0 1 1\n") << QStringLiteral("the parent must stand before");
    QTest::newRow("binary") << QByteArray("\x7f"
                                          "ELF\x02\x01\x01")
                            << QStringLiteral(".swc:1: seven numbers");
}

void TestVesselTree::refusesBadFilesNamingTheLine()
{
    QFETCH(QByteArray, content);
    QFETCH(QString, says);
    const auto result = readVesselTree(write(content));
    QVERIFY(!result.tree);
    QVERIFY2(result.error.contains(says), qPrintable(result.error));
}

void TestVesselTree::saysWhichFileIsMissing()
{
    const auto result = readVesselTree(QStringLiteral("/nowhere/tree.swc"));
    QVERIFY(!result.tree);
    QVERIFY(result.error.contains(QStringLiteral("/nowhere/tree.swc cannot be read")));
}

void TestVesselTree::findsTheWayFromTheRoot()
{
    // A stem of three points that forks into two.
    const auto tree = readVesselTree(write("1 2 0 0 0 1 -1\n2 2 0 0 10 1 1\n3 2 0 0 20 1 2\n4 2 10 0 30 1 3\n5 2 -10 0 30 1 3\n")).tree;
    QVERIFY(tree);
    const std::vector<QVector3D> expected{{0, 0, 0}, {0, 0, 10}, {0, 0, 20}, {-10, 0, 30}};
    QCOMPARE(tree->wayTo({-9, 1, 29}, 8), expected);
}

void TestVesselTree::claimsNoWayToAPointOutsideTheVessels()
{
    const auto tree = readVesselTree(write("1 2 0 0 0 1 -1\n2 2 0 0 10 1 1\n")).tree;
    QVERIFY(tree);
    QVERIFY(tree->wayTo({0, 30, 10}, 8).empty());
    QVERIFY(VesselTree().wayTo({0, 0, 0}, 8).empty());
}

void TestVesselTree::readsAMeasuredTree()
{
    QString shared = qEnvironmentVariable("LIENA_SHARED_DATA");
    if (shared.isEmpty())
        shared = QStringLiteral(LIENA_SOURCE_DIR "/../../shared/data");
    const QString path = shared + QStringLiteral("/vessels/brava_BG001.swc");
    if (!QFile::exists(path))
        QSKIP("no measured vessel tree here: set LIENA_SHARED_DATA to the folder that holds vessels/brava_BG001.swc");
    const auto result = readVesselTree(path);
    QVERIFY2(result.tree, qPrintable(result.error));
    QCOMPARE(result.tree->points.size(), std::size_t(2810));
}

QTEST_APPLESS_MAIN(TestVesselTree)
#include "test_vessel_tree.moc"
