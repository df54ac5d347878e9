// How noisy a picture is at each brightness.
#include "imaging/noise_model.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace console {

namespace {

constexpr int classCount = 12;
constexpr std::size_t fewest = 64; ///< samples without which a class says nothing
// Of a normal distribution: median |e| = 0.6745 σ. The second difference x₋₁ − 2x₀ + x₊₁ of white noise has the variance 6 σ².
constexpr double medianOfNormal = 0.6745;
constexpr double secondDifferenceVariance = 6;

struct Sample {
    float value;
    float difference;
};

std::vector<Sample> samplesOf(const cv::Mat& picture)
{
    const int rowStep = picture.rows >= 128 ? 8 : 1;
    const int columnStep = picture.cols >= 128 ? 4 : 1;
    std::vector<Sample> samples;
    for (int row = 0; row < picture.rows; row += rowStep) {
        const auto* line = picture.ptr<float>(row);
        for (int column = 1; column + 1 < picture.cols; column += columnStep) {
            // The mean of the three is the brightness: unlike the middle one it is not correlated with their second difference.
            samples.push_back({(line[column - 1] + line[column] + line[column + 1]) / 3,
                               std::abs(line[column - 1] - 2 * line[column] + line[column + 1])});
        }
    }
    return samples;
}

double medianDifference(std::vector<float>& differences)
{
    const auto middle = differences.begin() + static_cast<std::ptrdiff_t>(differences.size() / 2);
    std::nth_element(differences.begin(), middle, differences.end());
    return *middle;
}

/// A weighted straight line; only a level when the brightness does not vary.
class Line {
public:
    void add(double x, double y, double weight)
    {
        m_weight += weight;
        m_x += weight * x;
        m_y += weight * y;
        m_xx += weight * x * x;
        m_xy += weight * x * y;
    }

    NoiseModel fitted() const
    {
        if (m_weight <= 0)
            return {};
        const double spread = m_xx - m_x * m_x / m_weight;
        const double slope = spread > 1e-9 * m_xx ? (m_xy - m_x * m_y / m_weight) / spread : 0;
        return {slope, (m_y - slope * m_x) / m_weight};
    }

private:
    double m_weight = 0;
    double m_x = 0;
    double m_y = 0;
    double m_xx = 0;
    double m_xy = 0;
};

} // namespace

double NoiseModel::variance(double value) const { return std::max(slope * value + offset, 0.0); }

NoiseModel estimateNoise(const cv::Mat& picture)
{
    if (picture.type() != CV_32FC1 || picture.cols < 3)
        return {};
    const std::vector<Sample> samples = samplesOf(picture);
    const auto [low, high] =
        std::minmax_element(samples.begin(), samples.end(), [](const Sample& a, const Sample& b) { return a.value < b.value; });
    if (samples.size() < fewest)
        return {};
    const double first = low->value;
    const double step = (static_cast<double>(high->value) - first) / classCount;
    std::array<std::vector<float>, classCount> classes;
    for (const Sample& sample : samples) {
        const int place = step > 0 ? static_cast<int>((sample.value - first) / step) : 0;
        classes.at(static_cast<std::size_t>(std::clamp(place, 0, classCount - 1))).push_back(sample.difference);
    }
    Line line;
    for (int place = 0; place < classCount; ++place) {
        auto& differences = classes.at(static_cast<std::size_t>(place));
        if (differences.size() < fewest)
            continue;
        const double sigma = medianDifference(differences) / medianOfNormal;
        line.add(first + (place + 0.5) * step, sigma * sigma / secondDifferenceVariance, static_cast<double>(differences.size()));
    }
    return line.fitted();
}

} // namespace console
