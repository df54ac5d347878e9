// Tests of the three-dimensional pane: what it says of what it shows, and whose keys are whose.
#include "imaging/c_arm_pose.hpp"
#include "imaging/pane_colours.hpp"
#include "imaging/scene_view.hpp"
#include "sample_frames.hpp"

#include <QSignalSpy>
#include <QTemporaryDir>
#include <QWheelEvent>
#include <QtTest>

using namespace console;

namespace {

constexpr QSize pane(320, 320);
constexpr QRgb background = qRgb(0x0E, 0x11, 0x14);

int pixelsThat(const QImage& image, const std::function<bool(QRgb)>& hold)
{
    int count = 0;
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x)
            count += hold(image.pixel(x, y)) ? 1 : 0;
    return count;
}

int drawnPixels(const QImage& image)
{
    return pixelsThat(image, [](QRgb pixel) { return (pixel | 0xFF000000U) != background; });
}

bool isTipGreen(QRgb pixel) { return qGreen(pixel) > qRed(pixel) + 20 && qGreen(pixel) > qBlue(pixel) + 20; }

DisplayPicture pictureFrom(PictureSource source, quint32 number = 1)
{
    constexpr QSize size(64, 64);
    DisplayPicture picture;
    picture.about = *samples::frame(number, size, 8, PixelEncoding::Raw);
    picture.about.source = source;
    picture.about.imagerPixelSpacing = 4;
    picture.image = QImage(size, QImage::Format_RGB32);
    picture.image.fill(Qt::gray);
    return picture;
}

XrayGeometry knownGeometry()
{
    XrayGeometry geometry;
    geometry.sourceDetectorDistance = 1100;
    geometry.sourceObjectDistance = 750;
    return geometry;
}

/// A straight vessel that reaches this far up and down from the middle, mm.
QString treeIn(const QTemporaryDir& folder, int reach)
{
    const QString path = folder.filePath(QStringLiteral("tree.swc"));
    QFile file(path);
    if (file.open(QIODevice::WriteOnly))
        file.write(QStringLiteral("1 2 0 0 -%1 4 -1\n2 2 0 0 0 4 1\n3 2 0 0 %1 3 2\n").arg(reach).toUtf8());
    return path;
}

/// Counts the keys that the pane leaves to its window.
class Hand : public QWidget {
public:
    QList<int> keys;

protected:
    void keyPressEvent(QKeyEvent* event) override { keys << event->key(); }
};

} // namespace

class TestSceneView : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void aPictureThatIsDrawnAnewStaysWhereItWas();
    void showsWhatTheSceneDraws();
    void saysWhatThePictureIs_data();
    void saysWhatThePictureIs();
    void saysItInTheDrawing();
    void saysNothingOfAPictureThatIsNotDrawn();
    void turnsByMouseAndKeyboard();
    void leavesTheHandsKeysToTheHand();
    void showsTheWholeCArm_data();
    void showsTheWholeCArm();
    void beginsWithVesselsAndDetector_data();
    void beginsWithVesselsAndDetector();
    void beginsWithSmallVesselsAlone();
    void drawsNothingWhileHidden();
    void saysThatVesselsAreMissing();
    void endsWhileDrawing();
};

void TestSceneView::saysWhatThePictureIs_data()
{
    QTest::addColumn<int>("source");
    QTest::addColumn<int>("condition");
    QTest::addColumn<QString>("words");
    const auto row = [](const char* name, PictureSource source, PictureCondition condition, const char* words) {
        QTest::newRow(name) << static_cast<int>(source) << static_cast<int>(condition) << QString::fromLatin1(words);
    };
    row("live", PictureSource::Live, PictureCondition::Live, "");
    row("simulated", PictureSource::Simulated, PictureCondition::Live, "picture: SIMULATED");
    row("recorded", PictureSource::Recorded, PictureCondition::Live, "picture: RECORDED");
    row("frozen", PictureSource::Live, PictureCondition::Frozen, "picture: FROZEN");
    row("held", PictureSource::Live, PictureCondition::Held, "picture: LAST IMAGE HOLD");
    row("of unknown age", PictureSource::Live, PictureCondition::Unknown, "picture: AGE UNKNOWN");
    row("not judged yet", PictureSource::Live, PictureCondition::None, "picture: AGE UNKNOWN");
    row("recorded, held", PictureSource::Recorded, PictureCondition::Held, "picture: RECORDED  LAST IMAGE HOLD");
    row("simulated, frozen", PictureSource::Simulated, PictureCondition::Frozen, "picture: SIMULATED  FROZEN");
}

void TestSceneView::saysWhatThePictureIs()
{
    QFETCH(int, source);
    QFETCH(int, condition);
    QFETCH(QString, words);
    SceneView view;
    view.resize(pane);
    view.show();
    QTRY_VERIFY(view.drawings() > 0);
    QCOMPARE(view.pictureWords(), QStringLiteral("no picture"));
    view.showCondition(static_cast<PictureCondition>(condition));
    view.showCArm(knownGeometry());
    view.showPicture(pictureFrom(static_cast<PictureSource>(source)));
    QTRY_COMPARE(view.pictureWords(), words);
    QVERIFY(view.accessibleDescription().endsWith(words));
    QCOMPARE(view.accessibleDescription().contains(QStringLiteral("picture:")), !words.isEmpty());
}

void TestSceneView::saysItInTheDrawing()
{
    QList<QImage> seen;
    for (const PictureSource source : {PictureSource::Live, PictureSource::Simulated, PictureSource::Recorded}) {
        SceneView view;
        view.resize(pane);
        view.show();
        view.showCondition(PictureCondition::Live);
        view.showCArm(knownGeometry());
        view.showPicture(pictureFrom(source));
        QTRY_VERIFY(view.pictureWords() != QStringLiteral("no picture"));
        seen << view.grab().toImage().copy(0, 0, pane.width(), 90);
        QVERIFY(view.overlayRegion().contains(QPoint(20, 20)));
    }
    QVERIFY(seen[0] != seen[1]);
    QVERIFY(seen[1] != seen[2]);
    QVERIFY(seen[0] != seen[2]);
}

void TestSceneView::saysNothingOfAPictureThatIsNotDrawn()
{
    SceneView view;
    view.resize(pane);
    view.show();
    view.showCondition(PictureCondition::Live);
    DisplayPicture picture = pictureFrom(PictureSource::Live);
    picture.about.geometry = {};
    view.showPicture(picture);
    QCOMPARE(view.pictureWords(), QStringLiteral("picture's place unknown"));
    QTRY_VERIFY(view.drawings() > 0);
    QCOMPARE(view.pictureWords(), QStringLiteral("picture's place unknown"));
}

void TestSceneView::leavesTheHandsKeysToTheHand()
{
    Hand hand;
    hand.resize(pane);
    auto* view = new SceneView(&hand);
    view->resize(pane);
    hand.show();
    QVERIFY(QTest::qWaitForWindowActive(&hand));
    hand.setFocus();
    QTest::mouseClick(view, Qt::LeftButton, {}, {100, 100});
    QVERIFY(!view->hasFocus());
    const OrbitCamera camera = view->camera();
    const QList<int> keys{Qt::Key_Up, Qt::Key_Down, Qt::Key_Left, Qt::Key_Right, Qt::Key_I, Qt::Key_K, Qt::Key_J,
                          Qt::Key_L,  Qt::Key_D,    Qt::Key_F,    Qt::Key_C,     Qt::Key_R, Qt::Key_G, Qt::Key_U};
    view->setFocus(Qt::TabFocusReason); // even then
    QVERIFY(view->hasFocus());
    for (const int key : keys)
        QTest::keyClick(view, static_cast<Qt::Key>(key));
    QCOMPARE(hand.keys, keys);
    QCOMPARE(view->camera(), camera);
    QTest::mouseClick(view, Qt::LeftButton, {}, {100, 100}); // gives them back
    QVERIFY(!view->hasFocus());
}

void TestSceneView::showsTheWholeCArm_data()
{
    QTest::addColumn<QSize>("size");
    QTest::newRow("square") << QSize(300, 300);
    QTest::newRow("wide") << QSize(500, 300);
    QTest::newRow("high") << QSize(250, 400);
}

void TestSceneView::showsTheWholeCArm()
{
    QFETCH(QSize, size);
    SceneView view;
    view.resize(size);
    view.show();
    view.showPicture(pictureFrom(PictureSource::Live)); // which says how large the detector is
    for (const double angle : {-90.0, -40.0, 0.0, 40.0, 90.0}) {
        XrayGeometry geometry = knownGeometry();
        geometry.primaryAngle = angle;
        view.showCArm(geometry);
        QTest::keyClick(&view, Qt::Key_End);
        const auto pose = poseOf({angle, 0, 1100, 750, QSizeF(256, 256), {}});
        QVERIFY(pose);
        for (const QVector3D& part : {pose->source, pose->corner(-1, -1), pose->corner(1, -1), pose->corner(1, 1), pose->corner(-1, 1)}) {
            const auto place = view.camera().project(part, size);
            QVERIFY2(place && QRectF(QPointF(), QSizeF(size)).contains(*place), qPrintable(QString::number(angle)));
        }
    }
}

void TestSceneView::beginsWithVesselsAndDetector_data() { showsTheWholeCArm_data(); }

void TestSceneView::beginsWithVesselsAndDetector()
{
    QFETCH(QSize, size);
    const QTemporaryDir folder;
    SceneView view;
    view.resize(QSize(600, 200));
    view.loadVessels(treeIn(folder, 250));
    const OrbitCamera vessels = view.camera();
    view.showCArm(knownGeometry());
    QCOMPARE(view.camera(), vessels); // how large the detector is comes with a picture
    view.showPicture(pictureFrom(PictureSource::Live));
    view.resize(size); // the pane takes its place later
    view.show();
    const auto pose = poseOf({0, 0, 1100, 750, QSizeF(256, 256), {}});
    QVERIFY(pose);
    for (const QVector3D& part : {pose->corner(-1, -1), pose->corner(1, -1), pose->corner(1, 1), pose->corner(-1, 1)}) {
        const auto place = view.camera().project(part, size);
        QVERIFY(place && QRectF(QPointF(), QSizeF(size)).adjusted(4, 4, -4, -4).contains(*place));
    }
    QVERIFY(500 / view.camera().heightAt({}) > 0.4);
    const OrbitCamera first = view.camera();
    XrayGeometry turned = knownGeometry();
    turned.primaryAngle = 40;
    view.showCArm(turned);
    QCOMPARE(view.camera(), first);
    QTest::keyClick(&view, Qt::Key_Home);
    QCOMPARE(view.camera(), vessels);
    view.resize(size + QSize(40, 40));
    QCOMPARE(view.camera(), vessels); // somebody chose it
}

/// They are what the pane is for.
void TestSceneView::beginsWithSmallVesselsAlone()
{
    const QTemporaryDir folder;
    SceneView view;
    view.resize(pane);
    view.loadVessels(treeIn(folder, 60));
    const OrbitCamera vessels = view.camera();
    view.showCArm(knownGeometry());
    view.showPicture(pictureFrom(PictureSource::Live));
    QCOMPARE(view.camera(), vessels);
}

/// Its window changes, and it stays where it was taken.
void TestSceneView::aPictureThatIsDrawnAnewStaysWhereItWas()
{
    SceneView view;
    view.resize(300, 300);
    view.show();
    XrayGeometry geometry = knownGeometry();
    view.showCArm(geometry);
    auto picture = pictureFrom(PictureSource::Live);
    view.showPicture(picture);
    const auto placed = view.state().pictureGeometry;
    QVERIFY(placed);
    geometry.table[1] += 80;
    view.showCArm(geometry);
    picture.image.invertPixels();
    view.showPicture(picture);
    QCOMPARE(view.state().pictureGeometry, placed);
    picture.about.frame += 1;
    view.showPicture(picture);
    QCOMPARE(view.state().pictureGeometry->table[1], placed->table[1] + 80);
    view.showCArm(std::nullopt);
    picture.about.frame += 1;
    view.showPicture(picture);
    QVERIFY(!view.state().pictureGeometry); // nobody knows where the table is
}

void TestSceneView::showsWhatTheSceneDraws()
{
    QTemporaryDir folder;
    const QString path = folder.filePath(QStringLiteral("tree.swc"));
    QFile file(path);
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write("1 2 0 0 -60 4 -1\n2 2 0 0 0 4 1\n3 2 0 0 60 3 2\n");
    file.close();
    SceneView view;
    view.resize(pane);
    view.loadVessels(path);
    view.show();
    QTRY_VERIFY(view.drawings() > 0);
    QCOMPARE(view.unavailable(), QString());
    QTRY_VERIFY(drawnPixels(view.drawing()) > 200);
    TipPose pose;
    pose.valid = true;
    pose.quaternion = {1, 0, 0, 0};
    view.showTip(pose, false);
    QTRY_VERIFY(pixelsThat(view.drawing(), isTipGreen) > 5);
    pose.valid = false; // alarm 11: the overlay of the tip goes
    view.showTip(pose, false);
    QTRY_COMPARE(pixelsThat(view.drawing(), isTipGreen), 0);
    QVERIFY(view.grab().toImage().size() == pane);
    const auto without = view.grab().toImage();
    view.showTipBefore(pose); // not valid: no place is claimed
    QCOMPARE(view.grab().toImage(), without);
    pose.valid = true;
    pose.position = {0, 0, 30};
    view.showTipBefore(pose);
    const auto with = view.grab().toImage();
    const auto place = view.camera().project(toScene({0, 0, 30}), pane);
    QVERIFY(place);
    const QRectF ring(*place - QPointF(11, 11), QSizeF(22, 22));
    int changed = 0;
    for (int y = 0; y < pane.height(); ++y)
        for (int x = 0; x < pane.width(); ++x)
            changed += ring.contains(x, y) && with.pixel(x, y) != without.pixel(x, y) ? 1 : 0;
    QVERIFY2(changed > 40, qPrintable(QString::number(changed)));
    view.showTipBefore(std::nullopt);
    QCOMPARE(view.grab().toImage(), without);
}

void TestSceneView::turnsByMouseAndKeyboard()
{
    const QTemporaryDir folder;
    QFile file(folder.filePath(QStringLiteral("tree.swc")));
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write("1 2 0 0 -60 4 -1\n2 2 0 0 0 4 1\n3 2 0 0 60 3 2\n");
    file.close();
    SceneView view;
    view.resize(pane);
    view.loadVessels(file.fileName());
    view.show();
    QTRY_VERIFY(view.drawings() > 0);
    const OrbitCamera start = view.camera();
    const quint64 drawings = view.drawings();
    QTest::mousePress(&view, Qt::LeftButton, {}, {100, 100});
    QTest::mouseMove(&view, {150, 120});
    QTest::mouseRelease(&view, Qt::LeftButton, {}, {150, 120});
    QVERIFY(view.camera() != start);
    QTRY_VERIFY(view.drawings() > drawings);
    QTest::mouseDClick(&view, Qt::LeftButton, {}, {100, 100});
    QCOMPARE(view.camera(), start);
    QWheelEvent wheel({100, 100}, view.mapToGlobal(QPointF(100, 100)), {}, {0, 120}, {}, {}, Qt::NoScrollPhase, false);
    QCoreApplication::sendEvent(&view, &wheel);
    QVERIFY(view.camera().distance() < start.distance());
    QTest::keyClick(&view, Qt::Key_Home);
    QCOMPARE(view.camera(), start);
    QVERIFY(start != OrbitCamera()); // both show the vessels, and not where the camera happened to begin
    QTest::keyClick(&view, Qt::Key_4);
    QVERIFY(view.camera().azimuth() != start.azimuth());
    QTest::keyClick(&view, Qt::Key_6);
    QCOMPARE(view.camera(), start);
    QTest::keyClick(&view, Qt::Key_Plus);
    QVERIFY(view.camera().distance() < start.distance());
    QTest::keyClick(&view, Qt::Key_Minus);
    QTest::keyClick(&view, Qt::Key_8);
    QVERIFY(view.camera().elevation() > start.elevation());
    QTest::keyClick(&view, Qt::Key_End);
    QVERIFY(view.camera().distance() > 2 * start.distance());
}

void TestSceneView::drawsNothingWhileHidden()
{
    SceneView view;
    view.resize(pane);
    TipPose pose;
    pose.valid = true;
    view.showTip(pose, false);
    QCoreApplication::processEvents();
    QCOMPARE(view.drawings(), quint64(0));
    view.show();
    QTRY_VERIFY(view.drawings() > 0);
}

void TestSceneView::saysThatVesselsAreMissing()
{
    SceneView view;
    view.resize(pane);
    view.show();
    QVERIFY(view.notice().contains(QStringLiteral("No vessel tree")));
    view.loadVessels(QStringLiteral("/nowhere/cerebral.swc"));
    QVERIFY(view.notice().contains(QStringLiteral("/nowhere/cerebral.swc cannot be read")));
    QVERIFY(view.accessibleDescription().startsWith(view.notice()));
    QTRY_VERIFY(view.drawings() > 0); // the rest of the scene works all the same
}

void TestSceneView::endsWhileDrawing()
{
    for (int round = 0; round < 5; ++round) {
        SceneView view;
        view.resize(pane);
        view.show();
        if (round % 2 == 0)
            QTRY_VERIFY(view.drawings() > 0);
        for (int turn = 0; turn < 10; ++turn)
            QTest::keyClick(&view, Qt::Key_4);
    }
}

QTEST_MAIN(TestSceneView)
#include "test_scene_view.moc"
