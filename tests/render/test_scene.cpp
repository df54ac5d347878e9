// Tests of the three-dimensional scene: drawn off-screen by EGL, without a display server.
#include "imaging/scene.hpp"

#include <QProcess>
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
    void tipIsFoundFromFarAway();
    void drawsWireOnlyInsideVessels();
    void drawsCArmOnlyWithKnownGeometry();
    void putsPictureOnTheDetectorUnmirrored();
    void dimsPictureThatIsNotLive();
    void usesNoAlarmColour();
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

void TestScene::tipIsFoundFromFarAway()
{
    SceneState state;
    state.tip = tipAt({0, 0, 0});
    m_scene->show(state);
    OrbitCamera camera = fromTheFront();
    camera.fit(1000);
    const QImage image = m_scene->render(camera, pane);
    QRect tip;
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x)
            if (isTipGreen(image.pixel(x, y)))
                tip |= QRect(x, y, 1, 1);
    QVERIFY2(tip.width() >= 6, qPrintable(QString::number(tip.width())));
    QVERIFY2((tip.center() - QPoint(pane.width() / 2, pane.height() / 2)).manhattanLength() < 2 * tip.height(), "it stays where it is");
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
