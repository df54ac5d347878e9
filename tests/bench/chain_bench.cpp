// Measures each stage of the display chain on 1024 x 1024 pixels of 16 bits, and the whole chain as the decoding thread runs it.
#include "imaging/display_chain.hpp"
#include "imaging/shutter.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <random>
#include <vector>

using namespace console;

namespace {

constexpr int edge = 1024;

// Smooth tissue with the noise of few quanta; two of them, so that the temporal filter has something to mix.
cv::Mat tissue(unsigned seed)
{
    std::mt19937 random(seed);
    std::normal_distribution<double> noise(0, 300);
    cv::Mat picture(edge, edge, CV_16UC1);
    for (int y = 0; y < edge; ++y)
        for (int x = 0; x < edge; ++x) {
            const double value = 32768 + 18000 * std::sin(x / 90.0) * std::cos(y / 70.0) + noise(random);
            picture.at<std::uint16_t>(y, x) = static_cast<std::uint16_t>(std::clamp(value, 0.0, 65535.0));
        }
    return picture;
}

cv::Mat floating(const cv::Mat& stored)
{
    cv::Mat picture;
    stored.convertTo(picture, CV_32F);
    return picture;
}

XrayFrame frameOf(const cv::Mat& stored, quint32 number)
{
    const auto* first = reinterpret_cast<const std::byte*>(stored.data);
    const auto bytes = std::make_shared<const std::vector<std::byte>>(first, first + stored.total() * 2);
    XrayFrame frame;
    frame.frame = number;
    frame.rows = frame.columns = edge;
    frame.bitsStored = 16;
    frame.rate = 30;
    frame.windowCentre = 32768;
    frame.windowWidth = 60000;
    frame.captureNs = number * 33'333'333ULL;
    frame.owner = bytes;
    frame.pixels = *bytes;
    return frame;
}

void toFloatingPoint(benchmark::State& state)
{
    const cv::Mat stored = tissue(1);
    cv::Mat picture;
    for (auto _ : state) {
        stored.convertTo(picture, CV_32F);
        benchmark::DoNotOptimize(picture.data);
    }
}
BENCHMARK(toFloatingPoint)->Unit(benchmark::kMillisecond);

void noiseOfOnePicture(benchmark::State& state)
{
    const cv::Mat picture = floating(tissue(1));
    for (auto _ : state)
        benchmark::DoNotOptimize(estimateNoise(picture));
}
BENCHMARK(noiseOfOnePicture)->Unit(benchmark::kMillisecond);

void temporalFilter(benchmark::State& state)
{
    const std::vector<cv::Mat> pictures{floating(tissue(1)), floating(tissue(2))};
    const NoiseModel noise = estimateNoise(pictures.front());
    TemporalFilter filter;
    cv::Mat picture;
    std::size_t turn = 0;
    for (auto _ : state) {
        pictures[++turn % 2].copyTo(picture);
        filter.apply(picture, 0.35, noise);
        benchmark::DoNotOptimize(picture.data);
    }
}
BENCHMARK(temporalFilter)->Unit(benchmark::kMillisecond);

template <typename Enhancement>
void enhancement(benchmark::State& state)
{
    const cv::Mat sent = floating(tissue(1));
    const NoiseModel noise = estimateNoise(sent);
    Enhancement enhancement;
    cv::Mat picture;
    for (auto _ : state) {
        sent.copyTo(picture);
        enhancement.apply(picture, 50, noise);
        benchmark::DoNotOptimize(picture.data);
    }
}
BENCHMARK(enhancement<EdgeEnhancement>)->Name("edgeEnhancement")->Unit(benchmark::kMillisecond);
BENCHMARK(enhancement<MultiScaleEnhancement>)->Name("multiScaleEnhancement")->Unit(benchmark::kMillisecond);

// A window that changes with every picture, as AUTO's does: the table is computed anew.
void windowTable(benchmark::State& state)
{
    WindowLevelTable table;
    const auto function = static_cast<VoiFunction>(state.range(0));
    double centre = 30000;
    for (auto _ : state)
        table.prepare({{centre += 1, 40000}, function});
}
BENCHMARK(windowTable)->DenseRange(0, 2)->Unit(benchmark::kMillisecond);

void windowOfPicture(benchmark::State& state)
{
    const cv::Mat stored = tissue(1);
    WindowLevelTable table;
    table.prepare({{32768, 60000}});
    QImage image;
    for (auto _ : state)
        benchmark::DoNotOptimize(table.apply(stored, image));
}
BENCHMARK(windowOfPicture)->Unit(benchmark::kMillisecond);

void percentiles(benchmark::State& state)
{
    const cv::Mat stored = tissue(1);
    const Shutter round(ShutterShape::Circle, {edge, edge});
    for (auto _ : state)
        benchmark::DoNotOptimize(percentileWindow(stored, round));
}
BENCHMARK(percentiles)->Unit(benchmark::kMillisecond);

void shutter(benchmark::State& state)
{
    QImage image(edge, edge, QImage::Format_RGB32);
    image.fill(qRgb(90, 90, 90));
    for (auto _ : state)
        applyShutter(image, Shutter(ShutterShape::Circle, image.size()));
}
BENCHMARK(shutter)->Unit(benchmark::kMillisecond);

// Raw frames through everything: argument 0 with no filter, 1 with all of them.
void wholeChain(benchmark::State& state)
{
    const std::vector<cv::Mat> pictures{tissue(1), tissue(2)};
    DisplaySettings settings;
    if (state.range(0) == 1) {
        settings.window = WindowChoice::Automatic;
        settings.noiseReduction = 70;
        settings.edge = 50;
        settings.shutter = ShutterShape::Circle;
    }
    DisplayChain chain;
    DisplayPicture picture;
    std::vector<XrayFrame> frames{frameOf(pictures[0], 1), frameOf(pictures[1], 2)};
    quint32 number = 0;
    for (auto _ : state) {
        XrayFrame& frame = frames[++number % 2];
        frame.frame = number;
        frame.captureNs = number * 33'333'333ULL;
        if (const QString refusal = chain.process(frame, settings, std::chrono::seconds(1), picture); !refusal.isEmpty())
            state.SkipWithError(qPrintable(refusal));
    }
}
BENCHMARK(wholeChain)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

} // namespace

BENCHMARK_MAIN();
