// Tests that what is written on a picture can be read over the brightest one: contrast 4.5 to 1, as WCAG 2.2 asks for.
#include "imaging/live_image_view.hpp"
#include "imaging/pane_colours.hpp"
#include "imaging/reference_image_view.hpp"
#include "imaging/scene_view.hpp"
#include "sample_frames.hpp"
#include "widgets/theme.hpp"

#include <QHash>
#include <QtTest>

using namespace console;

namespace {

constexpr QSize size(512, 512);
constexpr double least = 4.5;

DisplayPicture whitePicture(PictureRole role)
{
    DisplayPicture picture;
    picture.about = *samples::frame(1, size, 8, PixelEncoding::Raw);
    picture.about.arrival = std::chrono::steady_clock::now();
    picture.about.imagerPixelSpacing = 9; // in the scene nothing but the picture is seen behind the words
    picture.role = role;
    picture.window = {128, 256};
    picture.image = QImage(size, QImage::Format_RGB32);
    picture.image.fill(Qt::white);
    return picture;
}

QHash<QRgb, int> coloursOf(const QImage& image, const QRegion& region)
{
    QHash<QRgb, int> colours;
    for (const QRect& part : region)
        for (int y = std::max(part.top(), 0); y <= std::min(part.bottom(), image.height() - 1); ++y)
            for (int x = std::max(part.left(), 0); x <= std::min(part.right(), image.width() - 1); ++x)
                ++colours[image.pixel(x, y)];
    return colours;
}

QColor mostOften(const QHash<QRgb, int>& colours)
{
    QRgb most = 0;
    for (auto colour = colours.begin(); colour != colours.end(); ++colour)
        most = colour.value() > colours.value(most) ? colour.key() : most;
    return QColor(most);
}

// `inks`: of the texts that must be there. No other ink stands on the plates, and nothing of the white shines through.
void checkPlates(QWidget& view, const std::function<QRegion()>& region, const QList<QColor>& inks)
{
    const QImage image = view.grab().toImage().convertToFormat(QImage::Format_RGB32);
    const auto colours = coloursOf(image, region());
    const QColor plate = mostOften(colours);
    QVERIFY(plate.lightness() < 80);
    for (const QColor& ink : inks) {
        QVERIFY2(colours.value(ink.rgb()) > 0, qPrintable(ink.name()));
        QVERIFY2(theme::contrast(plate, ink) >= least,
                 qPrintable(QStringLiteral("%1 on %2: %3").arg(ink.name(), plate.name()).arg(theme::contrast(plate, ink))));
    }
    QCOMPARE(colours.value(pane_colours::stale.rgb()), 0);
    QCOMPARE(colours.value(qRgb(255, 255, 255)), 0);
}

} // namespace

class TestPaintedContrast : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void initTestCase() { theme::apply(*qApp); }

    void onTheLivePicture()
    {
        PictureState state;
        state.setLinkUp(true);
        state.expect(15, std::chrono::steady_clock::now());
        LiveImageView view(state);
        view.resize(700, 700);
        view.showPicture(whitePicture(PictureRole::Live));
        view.tell(QStringLiteral("picture saved: /somewhere/liena.png"));
        checkPlates(view, [&view] { return view.overlayRegion() - view.livenessRect(); }, {pane_colours::text});
    }

    void onTheReferencePicture()
    {
        ReferenceImageView view;
        view.resize(562, 520);
        view.showPicture(whitePicture(PictureRole::Hold));
        checkPlates(view, [&view] { return view.overlayRegion(); }, {pane_colours::text});
    }

    void onTheScene()
    {
        SceneView view;
        view.resize(562, 562);
        view.show();
        TipPose tip;
        tip.valid = true;
        tip.quaternion = {1, 0, 0, 0};
        view.showTip(tip, true);
        tip.position = {40, 0, 0};
        view.showTipBefore(tip);
        view.showCondition(PictureCondition::Live);
        view.showCArm(whitePicture(PictureRole::Live).about.geometry);
        view.showPicture(whitePicture(PictureRole::Live));
        QTRY_VERIFY(view.drawings() > 0 && qGray(view.drawing().pixel(10, 10)) > 240); // the picture is behind everything
        // The letters of the sides that are turned away are the secondary grey.
        checkPlates(view, [&view] { return view.overlayRegion(); }, {pane_colours::text, pane_colours::secondary});
    }
};

QTEST_MAIN(TestPaintedContrast)
#include "test_painted_contrast.moc"
