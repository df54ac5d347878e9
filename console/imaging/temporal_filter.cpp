// The temporal recursive filter with motion adaptation.
#include "imaging/temporal_filter.hpp"

#include <algorithm>
#include <cmath>

namespace console {

namespace {

constexpr float motionFactor = 3;      ///< s: how many σ a pixel may differ before it counts as moving
constexpr float largestExponent = 8;   ///< beyond it K is 1 to three digits
constexpr int stepsPerUnit = 128;      ///< of the table of 1 − exp(−u)
constexpr double leastVariance = 1e-6; ///< so that a picture without noise divides by something
constexpr double strongest = 0.75;     ///< 1 − K₀ at 100 %

} // namespace

TemporalFilter::TemporalFilter()
{
    const int size = static_cast<int>(largestExponent) * stepsPerUnit + 1;
    m_share.reserve(static_cast<std::size_t>(size));
    for (int step = 0; step < size; ++step)
        m_share.push_back(static_cast<float>(1 - std::exp(-static_cast<double>(step) / stepsPerUnit)));
    m_share.back() = 1;
}

void TemporalFilter::apply(cv::Mat& picture, double k0, const NoiseModel& noise)
{
    const bool mixes = remembers(picture.size()) && k0 < 1;
    if (mixes) {
        const auto least = static_cast<float>(std::max(k0, 0.01));
        const auto slope = static_cast<float>(2 * motionFactor * motionFactor * noise.slope);
        const auto offset = static_cast<float>(2 * motionFactor * motionFactor * noise.offset);
        constexpr auto floor = static_cast<float>(leastVariance);
        for (int row = 0; row < picture.rows; ++row) {
            auto* value = picture.ptr<float>(row);
            const auto* before = m_previous.ptr<float>(row);
            for (int column = 0; column < picture.cols; ++column) {
                const float difference = value[column] - before[column];
                // The noise belongs to the brightness that stood here, which is known better than the present one.
                const float spread = std::max(slope * before[column] + offset, floor);
                const float exponent = std::min(difference * difference / spread, largestExponent);
                const float share = m_share[static_cast<std::size_t>(exponent * stepsPerUnit)];
                value[column] = before[column] + (least + (1 - least) * share) * difference;
            }
        }
    }
    picture.copyTo(m_previous);
}

double kOfStrength(int percent) { return 1 - strongest * std::clamp(percent, 0, 100) / 100.0; }

double strengthOfK(double k) { return std::clamp((1 - k) / strongest, 0.0, 1.0) * 100; }

Duration filterDelay(double k, Duration before, Duration framePeriod)
{
    const double share = std::clamp(1 - k, 0.0, 1.0);
    return Duration(static_cast<Duration::rep>(share * static_cast<double>((before + framePeriod).count())));
}

double leastK(Duration room, Duration before, Duration framePeriod)
{
    if (room <= Duration::zero() || framePeriod <= Duration::zero())
        return 1;
    return std::max(1 - static_cast<double>(room.count()) / static_cast<double>((before + framePeriod).count()), 0.0);
}

double varianceShare(double k) { return k > 0 && k < 1 ? k / (2 - k) : 1; }

} // namespace console
