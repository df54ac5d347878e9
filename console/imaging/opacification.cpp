// From a run's pictures to its vessels.
#include "imaging/opacification.hpp"

#include "imaging/pane_colours.hpp"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

namespace console {

namespace {

constexpr int vesselEdge = 512;     ///< pixels, at most
constexpr int backgroundEdge = 256; ///< pixels, at most
constexpr double newest = 0.5;      ///< share of the newest picture in the mean over time
constexpr int noiseEdge = 31;       ///< pixels around one that tell its noise
constexpr double mostNoise = 4;     ///< of the usual one; what brightened a pixel more was no noise
constexpr double leastNoise = 0.25; ///< of the usual one
constexpr double noiseSeenAt = 0.1; ///< of the usual one; a pixel with less is saturated, or behind lead
constexpr double noiseShown = 3;    ///< of its spread; below that a pixel is no vessel
constexpr double noiseSeen = 8;     ///< of its spread; below that the darkest pixels are none
constexpr double darkestShare = 0.002;
constexpr double leastSignal = 0.05;   ///< of the usual one
constexpr double rangeEnd = 0.01;      ///< of the range of values, at either end of it
constexpr int levelStep = 4;           ///< every so many columns and rows tell how bright a picture is
constexpr double leastUsual = 1e-4;    ///< of a logarithm; pictures without noise have none
constexpr double leastSpread = 0.01;   ///< of the noise around a pixel
constexpr double shadingSigma = 6;     ///< pixels
constexpr double noiseSigma = 2;       ///< pixels
constexpr double leastLikeness = 0.15; ///< response of the correlation below which its peak is one of noise; that of noise is 0.08

/// As small as `edge` by whole steps, so that each pixel is the mean of the same number of others.
cv::Size coarser(cv::Size size, int edge)
{
    const int step = std::max(1, (std::max(size.width, size.height) + edge - 1) / edge);
    return {std::max(1, size.width / step), std::max(1, size.height / step)};
}

bool darkerIsLess(const XrayFrame& frame) { return frame.photometric == Photometric::Monochrome2; }

bool isLinear(const XrayFrame& frame) { return frame.intensity == IntensityRelationship::Linear && darkerIsLess(frame); }

/// What grows with what the beam has passed: the logarithm of its intensity, unless the values are one already.
cv::Mat attenuation(const cv::Mat& values, const XrayFrame& frame)
{
    cv::Mat result;
    if (!isLinear(frame)) {
        const double sign = darkerIsLess(frame) ? -1 : 1;
        values.convertTo(result, CV_32F, sign * std::ldexp(1.0, -frame.bitsStored));
        return result;
    }
    cv::log(cv::max(values, 1.0F), result);
    return -result;
}

/// The value that `share` of all are not above. Of one at least.
float quantile(std::vector<float>& values, double share)
{
    const auto place = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), values.begin() + place, values.end());
    return values[static_cast<std::size_t>(place)];
}

/// What a picture has to be multiplied by, or what has to be added where its values are no intensities, to be as bright as `reference`: the
/// median, since contrast darkens only a part.
double levelOf(const cv::Mat& picture, const cv::Mat& reference, const XrayFrame& frame)
{
    const double full = std::ldexp(1.0, frame.bitsStored);
    std::vector<float> values;
    for (int row = 0; row < picture.rows; row += levelStep)
        for (int column = 0; column < picture.cols; column += levelStep) {
            const float now = picture.at<float>(row, column);
            const float before = reference.at<float>(row, column);
            if (std::min(now, before) > rangeEnd * full && std::max(now, before) < (1 - rangeEnd) * full)
                values.push_back(isLinear(frame) ? before / now : before - now);
        }
    if (values.empty())
        return isLinear(frame) ? 1 : 0;
    return quantile(values, 0.5);
}

/// As bright on the whole as `reference`: an exposure control that settles darkens all of a run's pictures, and that is no contrast. Where
/// a value stands at the bright end of its range, or stays at the dark one, it cannot follow, and tells nothing.
cv::Mat levelled(const cv::Mat& picture, const cv::Mat& reference, const XrayFrame& frame)
{
    const double full = std::ldexp(1.0, frame.bitsStored) - 1;
    const auto low = [full](const cv::Mat& values) { return cv::Mat(values <= rangeEnd * full); };
    const auto high = [full](const cv::Mat& values) { return cv::Mat(values >= (1 - rangeEnd) * full); };
    const double level = levelOf(picture, reference, frame);
    cv::Mat result;
    if (isLinear(frame))
        result = picture * level;
    else
        result = picture + level;
    result = cv::max(cv::min(result, full), 0);
    const cv::Mat silent =
        darkerIsLess(frame) ? high(picture) | (low(picture) & low(reference)) : low(picture) | (high(picture) & high(reference));
    reference.copyTo(result, silent);
    return result;
}

/// Where hardly any beam comes through, behind a blade or beside the field, the logarithm is all noise.
cv::Mat shadows(const cv::Mat& mask, const XrayFrame& frame)
{
    if (!isLinear(frame))
        return cv::Mat::zeros(mask.size(), CV_8U);
    std::vector<float> values(mask.begin<float>(), mask.end<float>());
    return mask < leastSignal * quantile(values, 0.5);
}

/// What noise does to each pixel in this run: as much as it brightens those around it.
class NoiseAround {
public:
    explicit NoiseAround(const cv::Mat& brightened) : m_brightened(brightened)
    {
        std::vector<float> seen;
        std::copy_if(brightened.begin<float>(), brightened.end<float>(), std::back_inserter(seen), [](float value) { return value > 0; });
        m_usual = seen.empty() ? 0 : quantile(seen, 0.5);
        cv::blur(cv::min(brightened, mostNoise * m_usual), m_around, {noiseEdge, noiseEdge}, {-1, -1}, cv::BORDER_REPLICATE);
        m_around = cv::max(m_around, std::max(leastNoise * m_usual, leastUsual));
    }

    const cv::Mat& around() const { return m_around; }

    /// `values` where there is noise to be seen; all of them where there is none at all.
    std::vector<float> whereSeen(const cv::Mat& values) const
    {
        std::vector<float> result;
        auto brightened = m_brightened.begin<float>();
        for (auto value = values.begin<float>(); value != values.end<float>(); ++value, ++brightened)
            if (*brightened >= noiseSeenAt * m_usual)
                result.push_back(*value);
        return result;
    }

private:
    cv::Mat m_brightened;
    cv::Mat m_around;
    double m_usual = 0;
};

/// Without its shading, which stays where the detector is, and without the finest, which is noise.
cv::Mat detail(const cv::Mat& values, cv::Size size)
{
    cv::Mat small;
    cv::resize(values, small, size, 0, 0, cv::INTER_AREA);
    cv::Mat shading;
    cv::GaussianBlur(small, shading, {0, 0}, shadingSigma);
    small -= shading;
    cv::GaussianBlur(small, small, {0, 0}, noiseSigma);
    return small;
}

} // namespace

QImage vesselLayer(const Roadmap& roadmap)
{
    QImage layer(roadmap.vessels.cols, roadmap.vessels.rows, QImage::Format_ARGB32_Premultiplied);
    const QColor& ink = pane_colours::roadmap;
    for (int row = 0; row < layer.height(); ++row) {
        const auto* vessel = roadmap.vessels.ptr<std::uint8_t>(row);
        auto* pixel = reinterpret_cast<QRgb*>(layer.scanLine(row));
        for (int column = 0; column < layer.width(); ++column)
            pixel[column] = qPremultiply(qRgba(ink.red(), ink.green(), ink.blue(), vessel[column]));
    }
    return layer;
}

bool Opacification::endsWith(const XrayFrame& frame) const
{
    // An X-ray system that was started anew counts its runs and pictures from the first again.
    return m_count > 0 && (m_first.acquisition != frame.acquisition || frame.frame <= m_lastFrame || m_first.source != frame.source ||
                           m_first.rows != frame.rows || m_first.columns != frame.columns || m_first.bitsStored != frame.bitsStored ||
                           m_first.photometric != frame.photometric || m_first.intensity != frame.intensity ||
                           m_first.imagerPixelSpacing != frame.imagerPixelSpacing || !sameProjection(m_first.geometry, frame.geometry));
}

Opacification Opacification::copy() const
{
    Opacification other(*this);
    for (cv::Mat* picture : {&other.m_coarse, &other.m_mask, &other.m_smooth, &other.m_darkest, &other.m_brightest})
        *picture = picture->clone();
    return other;
}

void Opacification::begin(const XrayFrame& frame)
{
    m_first = frame;
    m_first.owner.reset();
    m_first.pixels = {};
    m_count = 0;
}

void Opacification::take(const cv::Mat& stored, const XrayFrame& frame)
{
    if (m_count == 0 || endsWith(frame))
        begin(frame);
    cv::Mat small;
    cv::resize(stored, small, coarser(stored.size(), vesselEdge), 0, 0, cv::INTER_AREA);
    small.convertTo(m_coarse, CV_32F);
    m_lastNs = frame.captureNs;
    m_lastFrame = frame.frame;
    ++m_count;
    const cv::Mat picture = m_count > 1 ? levelled(m_coarse, m_mask / std::min(m_count - 1, maskPictures), m_first) : m_coarse;
    if (m_count <= maskPictures) {
        if (m_count == 1)
            m_mask = cv::Mat::zeros(picture.size(), CV_32F);
        m_mask += picture;
        m_smooth = m_mask / m_count;
        m_smooth.copyTo(m_darkest);
        m_smooth.copyTo(m_brightest);
        return;
    }
    cv::addWeighted(picture, newest, m_smooth, 1 - newest, 0, m_smooth);
    cv::Mat& least = darkerIsLess(m_first) ? m_darkest : m_brightest;
    cv::Mat& most = darkerIsLess(m_first) ? m_brightest : m_darkest;
    cv::min(least, m_smooth, least);
    cv::max(most, m_smooth, most);
}

std::optional<Roadmap> Opacification::roadmap() const
{
    if (m_count < leastPictures)
        return std::nullopt;
    const cv::Mat before = attenuation(m_mask / maskPictures, m_first);
    cv::Mat darkened = attenuation(m_darkest, m_first) - before;
    cv::Mat brightened = before - attenuation(m_brightest, m_first);
    const cv::Mat dark = shadows(m_mask, m_first);
    for (cv::Mat* change : {&darkened, &brightened}) {
        change->setTo(0, dark);
        cv::GaussianBlur(*change, *change, {5, 5}, 1.0, 1.0, cv::BORDER_REPLICATE);
    }
    darkened -= brightened;

    const NoiseAround noise(brightened);
    std::vector<float> values = noise.whereSeen(darkened / noise.around());
    if (values.empty())
        return std::nullopt;
    const float usual = quantile(values, 0.5);
    const float darkest = quantile(values, 1 - darkestShare);
    std::transform(values.begin(), values.end(), values.begin(), [usual](float value) { return std::abs(value - usual); });
    const double spread = std::max(1.4826 * quantile(values, 0.5), leastSpread); // of a normal distribution with that median deviation
    if (darkest - usual < noiseSeen * spread)
        return std::nullopt;

    // From what may be noise at that place up to the darkest anywhere.
    const cv::Mat least = noise.around() * (usual + noiseShown * spread);
    values.assign(darkened.begin<float>(), darkened.end<float>());
    const double most = quantile(values, 1 - darkestShare);
    Roadmap roadmap;
    const cv::Mat shown = (darkened - least) / cv::max(most - least, leastUsual);
    shown.convertTo(roadmap.vessels, CV_8U, 255);
    roadmap.vessels.setTo(0, dark);
    roadmap.background = detail(before, coarser(before.size(), backgroundEdge));
    roadmap.about = m_first;
    roadmap.lastNs = m_lastNs;
    roadmap.pictures = m_count;
    return roadmap;
}

std::optional<QPointF> Opacification::displacement(const Roadmap& roadmap) const
{
    if (m_count == 0 || m_first.rows != roadmap.about.rows || m_first.columns != roadmap.about.columns)
        return std::nullopt;
    if (roadmap.background.rows < 2 || roadmap.background.cols < 2)
        return std::nullopt; // OpenCV has no window for a single row, and throws
    const cv::Mat now = detail(attenuation(m_coarse, m_first), roadmap.background.size());
    cv::Mat window;
    cv::createHanningWindow(window, now.size(), CV_32F);
    cv::Mat before = roadmap.background.clone(); // OpenCV 4.6 weighs a picture of 2^a 3^b 5^c rows and columns with the window in its place
    double likeness = 0;
    const cv::Point2d shift = cv::phaseCorrelate(before, now, window, &likeness);
    if (!(likeness >= leastLikeness))
        return std::nullopt;
    return QPointF(shift.x * m_first.columns / now.cols, shift.y * m_first.rows / now.rows);
}

} // namespace console
