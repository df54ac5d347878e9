// Tests of the three-dimensional scene: drawn off-screen by EGL, without a display server.
#include "imaging/frame_pipeline.hpp"
#include "imaging/scene.hpp"
#include "imaging/scene_view.hpp"
#include "sample_frames.hpp"

#include <QProcess>
#include <QTemporaryDir>
#include <QWheelEvent>
#include <QtTest>

using namespace console;

namespace {

constexpr QSize pane(320, 320);
constexpr QRgb background = qRgb(0x0E, 0x11, 0x14);

std::shared_ptr<const VesselTree> forkedTree()
{
    auto tree = std::make_shared<VesselTree>();
    tree->points = {{{0, 0, -60}, 4, -1}, {{0, 0, -20}, 4, 0}, {{0, 0, 20}, 3, 1}, {{40, 0, 60}, 2, 2}, {{-40, 0, 60}, 2, 2}};
    return tree;
}

TrackedTip tipAt(const QVector3D& position, bool isStale = false) { return {position, {0, 0, 1}, 0.5F, isStale}; }

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

bool isAlarmHue(QRgb pixel)
{
    const QColor colour(pixel);
    const int hue = colour.hsvHue();
    const bool red = hue < 15 || hue > 345;
    const bool yellow = hue > 45 && hue < 65;
    const bool cyan = hue > 175 && hue < 195;
    return colour.hsvSaturation() > 128 && colour.value() > 128 && (red || yellow || cyan);
}

OrbitCamera fromTheFront()
{
    OrbitCamera camera;
    camera.rotate(-camera.azimuth(), -camera.elevation());
    camera.zoom(2);
    return camera;
}

} // namespace

class TestScene : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void initTestCase();
    void drawsNothingWhenThereIsNothing();
    void drawsVessels();
    void tipMovesInThePicture();
    void patientsRightIsOnTheLeftFromTheFront();
    void staleTipIsHollowAndGrey();
    void drawsWireOnlyInsideVessels();
    void drawsCArmOnlyWithKnownGeometry();
    void putsPictureOnTheDetectorUnmirrored();
    void dimsPictureThatIsNotLive();
    void usesNoAlarmColour();
    void viewShowsWhatTheSceneDraws();
    void viewTurnsByMouseAndKeyboard();
    void viewDrawsNothingWhileHidden();
    void viewSaysThatVesselsAreMissing();
    void viewEndsWhileDrawing();
    void loadsNoOtherQt();

private:
    std::unique_ptr<OffscreenScene> m_scene;
};

void TestScene::initTestCase()
{
    QString error;
    m_scene = OffscreenScene::create(error);
    QVERIFY2(m_scene, qPrintable(error));
}

void TestScene::drawsNothingWhenThereIsNothing()
{
    m_scene->show({});
    const QImage image = m_scene->render(fromTheFront(), pane);
    QCOMPARE(image.size(), pane);
    QCOMPARE(image.format(), QImage::Format_RGB32);
    QCOMPARE(drawnPixels(image), 0);
    QVERIFY(m_scene->render(fromTheFront(), {}).isNull());
}

void TestScene::drawsVessels()
{
    SceneState state;
    state.vessels = forkedTree();
    m_scene->show(state);
    const QImage image = m_scene->render(fromTheFront(), pane);
    QVERIFY(drawnPixels(image) > 500);
    QVERIFY((image.pixel(160, 180) | 0xFF000000U) != background); // the stem, in the middle
    QCOMPARE(image.pixel(20, 160) | 0xFF000000U, background);
}

void TestScene::tipMovesInThePicture()
{
    SceneState state;
    state.vessels = forkedTree();
    state.tip = tipAt({0, 0, -20});
    m_scene->show(state);
    const QImage before = m_scene->render(fromTheFront(), pane);
    state.tip = tipAt({0, 0, 20});
    m_scene->show(state);
    const QImage after = m_scene->render(fromTheFront(), pane);
    QVERIFY(pixelsThat(before, isTipGreen) > 20);
    QVERIFY(pixelsThat(after, isTipGreen) > 20);
    const auto highest = [](const QImage& image) {
        for (int y = 0; y < image.height(); ++y)
            for (int x = 0; x < image.width(); ++x)
                if (isTipGreen(image.pixel(x, y)))
                    return y;
        return image.height();
    };
    QVERIFY(highest(after) < highest(before) - 10);
}

void TestScene::patientsRightIsOnTheLeftFromTheFront()
{
    SceneState state;
    state.tip = tipAt({40, 0, 0}); // 40 mm to the patient's right
    m_scene->show(state);
    const QImage image = m_scene->render(fromTheFront(), pane);
    QVERIFY(pixelsThat(image.copy(0, 0, 160, 320), isTipGreen) > 20);
    QCOMPARE(pixelsThat(image.copy(160, 0, 160, 320), isTipGreen), 0);
}

void TestScene::staleTipIsHollowAndGrey()
{
    SceneState state;
    OrbitCamera close = fromTheFront();
    close.zoom(4);
    state.tip = tipAt({0, 0, 0});
    m_scene->show(state);
    const QImage fresh = m_scene->render(close, pane);
    state.tip = tipAt({0, 0, 0}, true);
    m_scene->show(state);
    const QImage stale = m_scene->render(close, pane);
    QVERIFY(pixelsThat(fresh, isTipGreen) > 200);
    QCOMPARE(pixelsThat(stale, isTipGreen), 0);
    QVERIFY(drawnPixels(stale) > 50);
    QVERIFY(drawnPixels(stale) < drawnPixels(fresh) * 8 / 10); // one sees through it
}

void TestScene::drawsWireOnlyInsideVessels()
{
    SceneState state;
    state.vessels = forkedTree();
    const auto bright = [](QRgb pixel) { return qRed(pixel) > 150 && qBlue(pixel) > 150; };
    state.tip = tipAt({0, 0, 20});
    m_scene->show(state);
    const int inside = pixelsThat(m_scene->render(fromTheFront(), pane), bright);
    state.tip = tipAt({0, 0, -60});
    m_scene->show(state);
    const int atRoot = pixelsThat(m_scene->render(fromTheFront(), pane), bright);
    state.tip = tipAt({60, 0, 0}); // far from every vessel
    m_scene->show(state);
    const int outside = pixelsThat(m_scene->render(fromTheFront(), pane), bright);
    QVERIFY2(inside > outside + 30, qPrintable(QStringLiteral("%1 %2 %3").arg(inside).arg(atRoot).arg(outside)));
    QVERIFY(inside > atRoot + 20);
}

void TestScene::drawsCArmOnlyWithKnownGeometry()
{
    SceneState state;
    state.cArm = CArmGeometry{20, 10, 1100, 750, {300, 300}, {}};
    m_scene->show(state);
    OrbitCamera far;
    far.zoom(0.5);
    QVERIFY(drawnPixels(m_scene->render(far, pane)) > 100);
    state.cArm->sourceDetectorDistance = 0;
    m_scene->show(state);
    QCOMPARE(drawnPixels(m_scene->render(far, pane)), 0);
}

void TestScene::putsPictureOnTheDetectorUnmirrored()
{
    // White only in the quarter at the picture's top left: from the front that is the patient's right, at the head.
    QImage picture(64, 64, QImage::Format_RGB32);
    picture.fill(qRgb(10, 10, 10));
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 32; ++x)
            picture.setPixel(x, y, qRgb(255, 255, 255));
    SceneState state;
    state.picture = picture;
    state.pictureGeometry = CArmGeometry{0, 0, 1100, 750, {200, 200}, {}};
    state.pictureIsLive = true;
    m_scene->show(state);
    OrbitCamera camera = fromTheFront();
    camera.zoom(0.4);
    const QImage image = m_scene->render(camera, pane);
    QVERIFY(qGray(image.pixel(145, 145)) > 240);
    QVERIFY(qGray(image.pixel(175, 145)) < 40);
    QVERIFY(qGray(image.pixel(145, 175)) < 40);
    QVERIFY(qGray(image.pixel(175, 175)) < 40);
}

void TestScene::dimsPictureThatIsNotLive()
{
    QImage picture(32, 32, QImage::Format_RGB32);
    picture.fill(qRgb(200, 200, 200));
    SceneState state;
    state.picture = picture;
    state.pictureGeometry = CArmGeometry{0, 0, 1100, 750, {200, 200}, {}};
    OrbitCamera camera = fromTheFront();
    camera.zoom(0.4);
    state.pictureIsLive = true;
    m_scene->show(state);
    const int live = qGray(m_scene->render(camera, pane).pixel(160, 160));
    state.pictureIsLive = false;
    m_scene->show(state);
    const int stale = qGray(m_scene->render(camera, pane).pixel(160, 160));
    QVERIFY(std::abs(live - 200) <= 2);
    QVERIFY(std::abs(stale - 120) <= 2);
}

void TestScene::usesNoAlarmColour()
{
    SceneState state;
    state.vessels = forkedTree();
    state.tip = tipAt({0, 0, 20});
    state.cArm = CArmGeometry{20, 10, 1100, 750, {300, 300}, {}};
    m_scene->show(state);
    QCOMPARE(pixelsThat(m_scene->render(OrbitCamera(), pane), isAlarmHue), 0);
}

void TestScene::viewShowsWhatTheSceneDraws()
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

void TestScene::viewTurnsByMouseAndKeyboard()
{
    SceneView view;
    view.resize(pane);
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
    QTest::keyClick(&view, Qt::Key_Left);
    QVERIFY(view.camera().azimuth() != start.azimuth());
    QTest::keyClick(&view, Qt::Key_Right);
    QCOMPARE(view.camera(), start);
    QTest::keyClick(&view, Qt::Key_Plus);
    QVERIFY(view.camera().distance() < start.distance());
    QTest::keyClick(&view, Qt::Key_Minus);
    QTest::keyClick(&view, Qt::Key_Up);
    QVERIFY(view.camera().elevation() > start.elevation());
    QTest::keyClick(&view, Qt::Key_End);
    QVERIFY(view.camera().distance() > 2 * start.distance());
}

void TestScene::viewDrawsNothingWhileHidden()
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

void TestScene::viewSaysThatVesselsAreMissing()
{
    SceneView view;
    view.resize(pane);
    view.show();
    QVERIFY(view.notice().contains(QStringLiteral("No vessel tree")));
    view.loadVessels(QStringLiteral("/nowhere/cerebral.swc"));
    QVERIFY(view.notice().contains(QStringLiteral("/nowhere/cerebral.swc cannot be read")));
    QCOMPARE(view.accessibleDescription(), view.notice());
    QTRY_VERIFY(view.drawings() > 0); // the rest of the scene works all the same
}

void TestScene::viewEndsWhileDrawing()
{
    for (int round = 0; round < 5; ++round) {
        SceneView view;
        view.resize(pane);
        view.show();
        if (round % 2 == 0)
            QTRY_VERIFY(view.drawings() > 0);
        for (int turn = 0; turn < 10; ++turn)
            QTest::keyClick(&view, Qt::Key_Left);
    }
}

void TestScene::loadsNoOtherQt()
{
    QProcess ldd;
    ldd.start(QStringLiteral("ldd"), {QCoreApplication::applicationFilePath()});
    QVERIFY(ldd.waitForFinished());
    const QByteArray libraries = ldd.readAllStandardOutput();
    QVERIFY(libraries.contains("libQt6Widgets"));
    QVERIFY(libraries.contains("libvtkRenderingOpenGL2"));
    QVERIFY(!libraries.contains("libQt5"));
}

QTEST_MAIN(TestScene)
#include "test_scene.moc"
