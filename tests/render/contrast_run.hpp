// A run of X-ray pictures in which contrast fills a vessel.
#pragma once

#include "model/xray_frame.hpp"
#include "noisy_picture.hpp"

#include <opencv2/imgproc.hpp>

#include <cmath>

namespace console::test {

constexpr int edge = 256;
constexpr double absorbed = 0.12; ///< of the logarithm

struct Scene {
    double contrast = 0; ///< 0 to 1, in the vessel
    cv::Point2d patient; ///< pixels
    Photometric photometric = Photometric::Monochrome2;
    IntensityRelationship intensity = IntensityRelationship::Linear;
    double level = 1;   ///< of the whole picture
    bool dense = false; ///< air beside the head saturates the detector, and a quarter of it is all bone
};

inline bool inVessel(int y) { return y >= 120 && y < 128; }

/// Half of it twice as bright as the other, with bones; a vessel across both.
inline cv::Mat picture(unsigned seed, const Scene& scene)
{
    const auto light = [&scene](int x, int y) {
        const double px = x - scene.patient.x;
        const double py = y - scene.patient.y;
        const double bones = 0.2 * std::sin(px * 0.31 + 2 * std::sin(py * 0.11)) * std::cos(py * 0.23 + std::sin(px * 0.07));
        const double beam = !scene.dense ? (px < edge / 2.0 ? 1200 : 2400) : x < edge / 4 ? 9000 : x < edge / 2 ? 200 : 1200;
        const double back = beam * scene.level * (1 + bones);
        return inVessel(y) ? back * std::exp(-absorbed * scene.contrast) : back;
    };
    cv::Mat stored;
    cv::Mat linear = samples::noisyPicture(edge, seed, light, [](double value) { return value / 4; });
    if (scene.intensity == IntensityRelationship::Logarithmic) {
        cv::log(linear, linear);
        linear *= 4095 / std::log(4095.0);
    }
    if (scene.photometric == Photometric::Monochrome1)
        linear = 4095 - linear;
    cv::Mat(cv::min(linear, 4095.0F)).convertTo(stored, CV_16U);
    return stored;
}

inline XrayFrame frame(quint32 number, const Scene& scene, quint32 run = 1)
{
    XrayFrame frame;
    frame.frame = number;
    frame.acquisition = run;
    frame.rows = frame.columns = edge;
    frame.bitsStored = 12;
    frame.photometric = scene.photometric;
    frame.intensity = scene.intensity;
    frame.captureNs = 1'000'000'000ULL + number * 66'000'000ULL;
    return frame;
}

/// Contrast comes after the sixth picture or a later one, passes, and is gone again.
template <typename Taker>
void takeRun(Taker& taker, Scene scene, double contrast, quint32 run = 1, quint32 pictures = 20, quint32 before = 6)
{
    for (quint32 number = 1; number <= pictures; ++number) {
        scene.contrast = number > before && number < before + 10 ? contrast : 0;
        taker.take(picture(run * 1000 + number, scene), frame(run * 100 + number, scene, run));
    }
}

} // namespace console::test
