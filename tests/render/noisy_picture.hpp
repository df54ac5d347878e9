// Pictures with noise of a known strength, the same in every run.
#pragma once

#include <opencv2/core.hpp>

#include <cmath>
#include <functional>
#include <random>

namespace console::samples {

/// CV_32FC1; `value(x, y)` and on it normal noise of variance `variance(value)`.
inline cv::Mat noisyPicture(int edge, unsigned seed, const std::function<double(int, int)>& value,
                            const std::function<double(double)>& variance)
{
    std::mt19937 random(seed);
    std::normal_distribution<double> normal(0, 1);
    cv::Mat picture(edge, edge, CV_32FC1);
    for (int y = 0; y < edge; ++y)
        for (int x = 0; x < edge; ++x)
            picture.at<float>(y, x) = static_cast<float>(value(x, y) + std::sqrt(variance(value(x, y))) * normal(random));
    return picture;
}

/// Of the values within the columns.
inline double varianceOf(const cv::Mat& picture, int firstColumn, int endColumn)
{
    double sum = 0;
    double squares = 0;
    int count = 0;
    for (int y = 0; y < picture.rows; ++y)
        for (int x = firstColumn; x < endColumn; ++x, ++count) {
            const double value = picture.at<float>(y, x);
            sum += value;
            squares += value * value;
        }
    return squares / count - (sum / count) * (sum / count);
}

} // namespace console::samples
