// Paints the picture panes with their controls in their main states, from an invented picture, into PNG files: `picture_gallery <folder>`.
#include "imaging/display_chain.hpp"
#include "imaging/live_image_view.hpp"
#include "imaging/reference_image_view.hpp"
#include "sample_frames.hpp"
#include "widgets/picture_controls.hpp"
#include "widgets/picture_pane.hpp"
#include "widgets/review_controls.hpp"
#include "widgets/theme.hpp"

#include <QApplication>
#include <QDir>
#include <QTest>

#include <cmath>
#include <cstdio>
#include <random>

using namespace console;

namespace {

constexpr QSize size(1024, 1024);

// Soft tissue, a vessel-like wave, a wire, and the noise of few quanta.
std::shared_ptr<XrayFrame> inventedFrame(quint32 number)
{
    std::mt19937 random(number);
    std::normal_distribution<double> noise(0, 90);
    std::vector<std::uint16_t> values;
    for (int y = 0; y < size.height(); ++y)
        for (int x = 0; x < size.width(); ++x) {
            const double tissue = 2200 + 900 * std::cos(std::hypot(x - 512, y - 512) / 260);
            const double vessel = 500 * std::exp(-std::pow((x - 512 - 120 * std::sin(y / 140.0)) / 26, 2));
            const double wire = 800 * std::exp(-std::pow((x - 512 - 110 * std::sin(y / 140.0)) / 2.5, 2));
            values.push_back(static_cast<std::uint16_t>(std::clamp(tissue - vessel - wire + noise(random), 0.0, 4095.0)));
        }
    auto frame = samples::frame(number, size, 12, PixelEncoding::Raw);
    frame->rate = 15;
    frame->ageUncertainty = std::chrono::microseconds(1800);
    return samples::withBytes(*frame, samples::encode(values, size, 12, PixelEncoding::Raw, 0));
}

DisplayPicture pictureWith(const DisplaySettings& settings, PictureRole role)
{
    DisplayChain chain;
    DisplayPicture picture;
    for (quint32 number = 1; number <= 6; ++number) {
        const auto frame = inventedFrame(number);
        chain.process(*frame, settings, std::chrono::milliseconds(110), picture);
    }
    picture.role = role;
    picture.about.arrival = std::chrono::steady_clock::now();
    return picture;
}

bool save(QWidget& pane, QSize extent, double scale, const QString& file)
{
    theme::applyScale(&pane, scale);
    pane.resize(extent);
    pane.show();
    return QTest::qWaitForWindowExposed(&pane) && pane.grab().save(file);
}

bool paintLive(const QDir& folder, const char* name, const DisplaySettings& settings, double zoom, bool measures, bool frozen, double scale)
{
    Instant now = std::chrono::steady_clock::now();
    PictureState state;
    state.setLinkUp(true);
    state.expect(15, now - std::chrono::seconds(3));
    DisplayState display;
    auto* view = new LiveImageView(state);
    theme::setTextRole(view, theme::TextRole::Caption);
    view->setClock([&now] { return now; });
    auto* controls = new PictureControls(display);
    PicturePane pane(view, controls);
    view->setDisplay(&display);
    display.set(settings);
    const DisplayPicture picture = pictureWith(settings, PictureRole::Live);
    now = picture.about.arrival + std::chrono::milliseconds(12);
    view->showPicture(picture);
    const int edge = static_cast<int>(1136 * scale);
    pane.resize(edge, edge);
    view->zoomBy(zoom);
    controls->showZoom(zoom);
    if (measures) {
        display.nextMeasureMode();
        for (const QPoint& at : {QPoint(edge / 3, edge / 3), QPoint(edge / 2, edge / 2)})
            QTest::mouseClick(view, Qt::LeftButton, {}, at);
    }
    pane.grab();
    if (frozen)
        now += std::chrono::milliseconds(2300);
    return save(pane, {edge, edge}, scale, folder.filePath(QStringLiteral("live_%1_%2.png").arg(QLatin1String(name)).arg(edge)));
}

bool paintReference(const QDir& folder, PictureRole role, double scale)
{
    auto* view = new ReferenceImageView;
    theme::setTextRole(view, theme::TextRole::Caption);
    auto* controls = new ReviewControls;
    PicturePane pane(view, controls);
    view->showPicture(pictureWith({}, role));
    if (role == PictureRole::Review) {
        view->setPlace(QStringLiteral("12 of 180, 11.2 s before the newest"));
        controls->showReview(true, false);
    }
    const int edge = static_cast<int>(562 * scale);
    return save(pane, {edge, edge}, scale, folder.filePath(QStringLiteral("%1_%2.png").arg(word(role)).arg(edge)));
}

} // namespace

int main(int argc, char* argv[])
{
    QApplication application(argc, argv);
    theme::apply(application);
    const QDir folder(argc > 1 ? QString::fromLocal8Bit(argv[1]) : QDir::currentPath());
    DisplaySettings all;
    all.window = WindowChoice::Automatic;
    all.function = VoiFunction::Sigmoid;
    all.inverted = true;
    all.noiseReduction = 80;
    all.edge = 60;
    all.shutter = ShutterShape::Circle;
    bool good = true;
    for (const double scale : {1.0, 0.75, 0.5333}) {
        good = paintLive(folder, "plain", {}, 1, false, false, scale) && good;
        good = paintLive(folder, "all", all, 1, false, false, scale) && good;
        good = paintLive(folder, "zoomed", {}, 2, true, false, scale) && good;
        good = paintLive(folder, "frozen", {}, 1, false, true, scale) && good;
        good = paintReference(folder, PictureRole::Hold, scale) && good;
        good = paintReference(folder, PictureRole::Review, scale) && good;
    }
    if (!good)
        std::fprintf(stderr, "The pictures cannot be painted into %s\n", qPrintable(folder.path()));
    return good ? 0 : 1;
}
