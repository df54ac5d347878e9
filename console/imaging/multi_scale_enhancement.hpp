// Enhancement of weak detail of every size.
#pragma once

#include "imaging/noise_model.hpp"

#include <opencv2/core.hpp>

#include <array>

namespace console {

/// Multi-scale contrast amplification (Vuylsteke and Schoeters, SPIE 2167 (1994) 551-560): the picture is taken apart into the bands of a
/// Laplacian pyramid (Burt and Adelson, IEEE Transactions on Communications 31 (1983) 532-540), each band's contrast passes a non-linear
/// gain, and the picture is put together again.
///
/// The gain is 1 within twice the band's noise, 1 + g for weak contrast above it, and comes back to 1 where the contrast is a quarter of
/// what lies around: strong edges get no halo. Strength as Display Filter Percentage (0028,9411): 0 = none, 100 = g of 2.
/// One thread at a time.
class MultiScaleEnhancement {
public:
    static constexpr std::size_t bands = 4; ///< of details of some 1, 2, 4 and 8 pixels
    static constexpr double strongest = 2;
    static constexpr double strongContrast = 0.25; ///< of the mean around it

    /// In place, on CV_32FC1.
    void apply(cv::Mat& picture, int percent, const NoiseModel& noise);

private:
    std::array<cv::Mat, bands + 1> m_levels; ///< smoother and smaller, then the bands
    std::array<cv::Mat, bands> m_means;      ///< what lies around, of each band
    cv::Mat m_coarser;
};

} // namespace console
