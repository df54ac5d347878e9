// Multi-scale enhancement: a Laplacian pyramid with a gain in each band that is limited by the noise and by the contrast itself.
#include "imaging/multi_scale_enhancement.hpp"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace console {

namespace {

constexpr double noiseLimit = 2; ///< σ within which contrast is taken for noise
constexpr int leastSide = 16;    ///< pixels of a level that is still taken apart

/// Standard deviation that white noise of 1 has in each band, with the kernel of pyrDown() and pyrUp(); render.multi_scale measures them.
constexpr std::array<double, MultiScaleEnhancement::bands> noiseShare{0.943, 0.230, 0.101, 0.049};

/// `band` becomes what it contributes to the enhanced picture.
void amplify(cv::Mat& band, const cv::Mat& means, float gain, float slope, float offset)
{
    constexpr auto strong = static_cast<float>(MultiScaleEnhancement::strongContrast);
    for (int row = 0; row < band.rows; ++row) {
        auto* value = band.ptr<float>(row);
        const auto* mean = means.ptr<float>(row);
        for (int column = 0; column < band.cols; ++column) {
            const float size = std::abs(value[column]);
            const float noise = std::sqrt(std::max(slope * mean[column] + offset, 0.0F));
            const float most = std::max(strong * mean[column], 1e-3F);
            const float excess = std::clamp(size - noise, 0.0F, most);
            // excess · (1 + g) / (1 + g · excess / most): steep at nothing, and itself again at `most`.
            const float raised = excess * (1 + gain) / (1 + gain * excess / most);
            value[column] += std::copysign(raised - excess, value[column]);
        }
    }
}

} // namespace

void MultiScaleEnhancement::apply(cv::Mat& picture, int percent, const NoiseModel& noise)
{
    const auto gain = static_cast<float>(strongest * std::clamp(percent, 0, 100) / 100);
    if (gain <= 0 || picture.empty())
        return;
    m_levels[0] = picture;
    std::size_t depth = 0;
    for (; depth < bands && std::min(m_levels[depth].rows, m_levels[depth].cols) >= leastSide; ++depth) {
        cv::pyrDown(m_levels[depth], m_levels[depth + 1]);
        cv::pyrUp(m_levels[depth + 1], m_means[depth], m_levels[depth].size());
        m_levels[depth] -= m_means[depth];
    }
    for (std::size_t band = depth; band-- > 0;) {
        const double limit = noiseLimit * noiseShare.at(band);
        amplify(m_levels[band], m_means[band], gain, static_cast<float>(limit * limit * noise.slope),
                static_cast<float>(limit * limit * noise.offset));
        cv::pyrUp(m_levels[band + 1], m_coarser, m_levels[band].size());
        m_levels[band] += m_coarser;
    }
    m_levels[0].release(); // the caller's
}

} // namespace console
