// Measures the way of a picture to the screen: decoding, window and level, paint, and the whole pipeline at a given rate.
#include "film.hpp"
#include "imaging/cine_ring.hpp"
#include "imaging/frame_decoder.hpp"
#include "imaging/frame_pipeline.hpp"
#include "imaging/live_image_view.hpp"
#include "imaging/scene_view.hpp"
#include "model/picture_state.hpp"

#include <QApplication>
#include <QTimer>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <vector>

using namespace console;
using namespace console::test;

namespace {

struct Kind {
    const char* name;
    Film film;
    bool filtered = false;
    EdgeMethod edges = EdgeMethod::UnsharpMask;
};

constexpr double mostReplaced = 0.01; ///< share of the pictures that a newer one may replace before they are shown

// The median of `rounds` runs, ms.
double median(int rounds, const std::function<void()>& work)
{
    std::vector<double> times;
    for (int round = 0; round < rounds; ++round) {
        const Instant begun = std::chrono::steady_clock::now();
        work();
        times.push_back(milliseconds(std::chrono::steady_clock::now() - begun));
    }
    std::nth_element(times.begin(), times.begin() + rounds / 2, times.end());
    return times[static_cast<std::size_t>(rounds / 2)];
}

void measureStages(const Kind& kind)
{
    const XrayFrame frame = filmFrame(kind.film);
    cv::Mat stored;
    const double decode = median(31, [&] { decodeFrame(frame, stored); });
    WindowLevelTable table;
    table.prepare({{frame.windowCentre, frame.windowWidth}});
    DisplayPicture picture;
    picture.about = frame;
    const double window = median(31, [&] { picture.image = table.apply(stored); });
    PictureState state;
    LiveImageView view(state);
    view.resize(1136, 1136);
    view.show();
    view.showPicture(picture);
    QImage screen(view.size(), QImage::Format_RGB32);
    const double paint = median(31, [&] { view.render(&screen); });
    std::printf("%-26s decode %6.2f ms  window %5.2f ms  paint to 1136 x 1136 %6.2f ms\n", kind.name, decode, window, paint);
}

// Everything that costs something.
DisplaySettings allFilters(EdgeMethod edges)
{
    DisplaySettings settings;
    settings.edgeMethod = edges;
    settings.window = WindowChoice::Automatic;
    settings.noiseReduction = 70;
    settings.edge = 50;
    settings.shutter = ShutterShape::Circle;
    return settings;
}

bool keepsUp(const Kind& kind, double painted, const FrameCounts& counts)
{
    const double replaced = static_cast<double>(counts.replacedBeforeDecoding + counts.replacedBeforeShowing);
    const double share = replaced / std::max(1.0, static_cast<double>(counts.received));
    const bool good = painted >= kind.film.framesPerSecond - mostLate && share <= mostReplaced;
    if (!good)
        std::printf(
            "%-26s TOO SLOW: %.1f of %d pictures a second painted, %.1f %% replaced; at least %.1f and at most %.0f %% are asked for\n",
            kind.name, painted, kind.film.framesPerSecond, 100 * share, kind.film.framesPerSecond - mostLate, 100 * mostReplaced);
    return good;
}

// Frames at their rate from another thread, with the three-dimensional scene beside it, for some seconds.
// False, with a sentence, when too few of them were painted.
bool measureWhole(const Kind& kind, std::chrono::milliseconds span)
{
    PictureState state;
    LiveImageView view(state);
    SceneView scene;
    scene.showCArm(filmGeometry());
    CineRing ring;
    FramePipeline pipeline;
    pipeline.recordInto(ring);
    if (kind.filtered) {
        pipeline.setSettings(allFilters(kind.edges));
        pipeline.setFilterRoom(std::chrono::milliseconds(150));
    }
    QObject::connect(&pipeline, &FramePipeline::pictureReady, &view, &LiveImageView::showPicture);
    QObject::connect(&pipeline, &FramePipeline::pictureReady, &scene, &SceneView::showPicture);
    std::vector<double> ages;
    QObject::connect(&view, &LiveImageView::picturePainted, &view,
                     [&](quint32, std::optional<double> age) { ages.push_back(age.value_or(0)); });
    view.resize(1136, 1136);
    scene.resize(562, 562);
    view.show();
    scene.show();
    {
        const FilmSender sender(kind.film, pipeline, span);
        QTimer::singleShot(span + std::chrono::milliseconds(300), qApp, &QApplication::quit);
        QApplication::exec();
    }
    const FrameCounts counts = pipeline.counts();
    std::sort(ages.begin(), ages.end());
    const double p50 = ages.empty() ? 0 : ages[ages.size() / 2];
    const double p99 = ages.empty() ? 0 : ages[ages.size() * 99 / 100];
    std::printf(
        "%-26s sent %llu at %d/s  painted %zu = %.1f fps  replaced %llu + %llu  arrival to paint p50 %.1f p99 %.1f ms  scene %llu\n",
        kind.name, static_cast<unsigned long long>(counts.received), kind.film.framesPerSecond, ages.size(),
        static_cast<double>(ages.size()) / seconds(span), static_cast<unsigned long long>(counts.replacedBeforeDecoding),
        static_cast<unsigned long long>(counts.replacedBeforeShowing), p50, p99, static_cast<unsigned long long>(scene.drawings()));
    return keepsUp(kind, static_cast<double>(ages.size()) / seconds(span), counts);
}

} // namespace

int main(int argc, char** argv)
{
    const QApplication application(argc, argv);
    const std::vector<Kind> kinds{
        {"512 x 512, 8 bit, raw", {512, 8, PixelEncoding::Raw, 30}},
        {"512 x 512, 8 bit, jpeg-ls", {512, 8, PixelEncoding::JpegLs, 30}},
        {"1024 x 1024, 16 bit, raw", {1024, 16, PixelEncoding::Raw, 15}},
        {"1024 x 1024, 12 bit, jpeg-ls", {1024, 12, PixelEncoding::JpegLs, 15}},
        {"1024 x 1024, 16 bit, jpeg-ls", {1024, 16, PixelEncoding::JpegLs, 15}},
        {"1024, 16 bit, all filters", {1024, 16, PixelEncoding::Raw, 30}, true},
        {"the same, multi-scale", {1024, 16, PixelEncoding::Raw, 30}, true, EdgeMethod::MultiScale},
    };
    for (const Kind& kind : kinds)
        measureStages(kind);
    bool good = true;
    for (const Kind& kind : kinds)
        good = measureWhole(kind, std::chrono::seconds(4)) && good;
    return good ? 0 : 1;
}
