// The temporal recursive filter: less noise where nothing moves, and nothing held back where something does.
#pragma once

#include "imaging/noise_model.hpp"
#include "model/instant.hpp"

#include <opencv2/core.hpp>

#include <vector>

namespace console {

/// Y(n) = K · X(n) + (1 − K) · Y(n−1), with K from K₀ where a pixel differs by no more than its noise to 1 where it moves:
/// K = K₀ + (1 − K₀) · (1 − exp(−(X − Y)² / (2 (s σ)²))), σ² from the noise model, s = 3. In still parts the noise's variance becomes
/// K₀ / (2 − K₀) of what it was. Levin et al., AJR 1984;143:447. One thread at a time.
class TemporalFilter {
public:
    TemporalFilter();

    /// The next picture shows itself alone.
    void reset() { m_previous.release(); }

    /// True when the next picture of that size would be mixed with earlier ones.
    bool remembers(cv::Size size) const { return m_previous.size() == size; }

    /// In place, on CV_32FC1. K₀ of 1 remembers the picture and changes nothing.
    void apply(cv::Mat& picture, double k0, const NoiseModel& noise);

private:
    cv::Mat m_previous;
    std::vector<float> m_share; ///< 1 − exp(−u), u in steps
};

/// K₀ for a strength of 0 … 100 %: 1 … 0.25.
double kOfStrength(int percent);
double strengthOfK(double k);

/// How much later a slow movement appears, when in the picture before, a period ago, it was `before` late: (1 − K)(before + period). Where
/// K has stood for long, (1 − K)/K periods.
Duration filterDelay(double k, Duration before, Duration framePeriod);

/// The least K whose delay stays within `room`; 1 when there is none.
double leastK(Duration room, Duration before, Duration framePeriod);

/// What is left of the noise's variance in still parts.
double varianceShare(double k);

} // namespace console
