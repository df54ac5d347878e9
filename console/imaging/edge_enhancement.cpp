// Edge enhancement: an unsharp mask that is limited by the local noise.
#include "imaging/edge_enhancement.hpp"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace console {

namespace {

constexpr double noiseLimit = 2; ///< σ within which a difference is taken for noise
constexpr int kernelSize = 13;   ///< ± 4 σ

} // namespace

void EdgeEnhancement::apply(cv::Mat& picture, int percent, const NoiseModel& noise)
{
    const auto gain = static_cast<float>(strongest * std::clamp(percent, 0, 100) / 100);
    if (gain <= 0 || picture.empty())
        return;
    cv::GaussianBlur(picture, m_smooth, cv::Size(kernelSize, kernelSize), sigma, sigma, cv::BORDER_REPLICATE);
    const auto slope = static_cast<float>(noiseLimit * noiseLimit * noise.slope);
    const auto offset = static_cast<float>(noiseLimit * noiseLimit * noise.offset);
    for (int row = 0; row < picture.rows; ++row) {
        auto* value = picture.ptr<float>(row);
        const auto* smooth = m_smooth.ptr<float>(row);
        for (int column = 0; column < picture.cols; ++column) {
            const float detail = value[column] - smooth[column];
            const float limit = std::sqrt(std::max(slope * smooth[column] + offset, 0.0F));
            const float kept = std::max(std::abs(detail) - limit, 0.0F);
            value[column] += gain * std::copysign(kept, detail);
        }
    }
}

} // namespace console
