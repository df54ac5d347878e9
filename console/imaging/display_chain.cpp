// The display chain, stage after stage.
#include "imaging/display_chain.hpp"

#include "imaging/exposure.hpp"
#include "imaging/frame_decoder.hpp"
#include "imaging/mean_picture.hpp"

#include <QCoreApplication>

#include <algorithm>
#include <cmath>
#include <utility>

namespace console {

namespace {

constexpr int framesPerNoise = 8; ///< the noise is read anew from every eighth picture
constexpr double kStep = 0.05;    ///< by which K may fall from one picture to the next; it may rise at once
constexpr std::chrono::seconds longestGap{1};
constexpr int storedBits = 16;

Instant present() { return std::chrono::steady_clock::now(); }

/// The same with its centre among the picture's own values. A picture that a slip of the hand made all black or all white looks like one
/// without a beam.
GreyWindow withinPicture(GreyWindow window, GreyWindow picture)
{
    if (!picture.isKnown())
        return window;
    return {std::clamp(window.centre, picture.centre - picture.width / 2, picture.centre + picture.width / 2), window.width};
}

/// Between the two pulses; between two as they were announced when the clock tells nothing sensible.
Duration periodBetween(const XrayFrame& before, const XrayFrame& now)
{
    const Duration announced = now.rate > 0 ? fromMilliseconds(1000 / now.rate) : Duration::zero();
    if (now.captureNs <= before.captureNs)
        return announced;
    return std::max(announced, Duration(static_cast<Duration::rep>(now.captureNs - before.captureNs)));
}

/// A stored value stands for the same in both. The ladder of an X-ray system changes the depth within a run.
bool hasSameValues(const XrayFrame& before, const XrayFrame& now)
{
    return before.acquisition == now.acquisition && before.source == now.source && before.bitsStored == now.bitsStored &&
           before.intensity == now.intensity && before.photometric == now.photometric;
}

/// What was lost on the way of one is in no picture that says it lost nothing, or less.
bool hasSameLoss(const XrayFrame& before, const XrayFrame& now)
{
    if (!before.isLossy() && !now.isLossy())
        return true;
    return before.encoding == now.encoding && before.quality == now.quality;
}

/// Taken after the other, and so soon that what is seen goes on.
bool comesNext(const XrayFrame& before, const XrayFrame& now)
{
    return now.captureNs >= before.captureNs && periodBetween(before, now) <= longestGap;
}

} // namespace

QString DisplayChain::process(const XrayFrame& frame, const DisplaySettings& settings, Duration filterRoom, DisplayPicture& picture,
                              std::span<const std::shared_ptr<const XrayFrame>> earlier)
{
    const Instant begun = present();
    if (QString refusal = decodeFrame(frame, m_incoming); !refusal.isEmpty())
        return refusal;
    picture.meanOf = meanWith(frame, earlier, m_incoming);
    cv::swap(m_incoming, m_stored);
    const Instant decoded = present();
    picture.about = frame;
    picture.about.owner.reset();
    picture.about.pixels = {};
    picture.treatment = {};
    const bool goesOn = continues(frame);
    // Its edges go on from those of the picture before only where a person saw that one in them. A jump in brightness begins nothing anew
    // here: what moves into view makes one, too.
    if (!m_automatic || !hasSameValues(m_last->about, frame) || !comesNext(m_last->about, frame))
        m_autoWindow.reset();
    m_automatic.reset();
    if (!goesOn) {
        m_temporal.reset();
        m_untilNextNoise = 0;
    }
    std::swap(m_last, m_previous);
    m_last = picture;
    filter(frame, settings, filterRoom);
    m_last->times = {};
    m_last->times.decode = decoded - begun;
    m_last->times.temporal = present() - decoded;
    picture = *m_last;
    if (!draw(settings, picture))
        return QCoreApplication::translate("console::DisplayChain", "there is no memory for it");
    return {};
}

bool DisplayChain::continues(const XrayFrame& frame) const
{
    if (!m_last)
        return false;
    const XrayFrame& before = m_last->about;
    return hasSameValues(before, frame) && hasSameLoss(before, frame) && sameProjection(before.geometry, frame.geometry, resting) &&
           before.imagerPixelSpacing == frame.imagerPixelSpacing && before.rows == frame.rows && before.columns == frame.columns &&
           before.mask == frame.mask && comesNext(before, frame) && sameBrightness(m_brightness, brightnessOf(m_stored));
}

// It rises at once, since the latency must not wait, and falls slowly, since noise that comes and goes looks like something.
double DisplayChain::chosenK(double wanted) const { return wanted >= m_k ? wanted : std::max(wanted, m_k - kStep); }

void DisplayChain::filter(const XrayFrame& frame, const DisplaySettings& settings, Duration room)
{
    m_brightness = brightnessOf(m_stored);
    m_isFiltered = settings.noiseReduction > 0;
    if (!m_isFiltered) {
        m_temporal.reset();
        m_k = 1;
        m_delay = {};
        return;
    }
    m_stored.convertTo(m_filtered, CV_32F);
    if (--m_untilNextNoise < 0) {
        m_noise = estimateNoise(m_filtered);
        m_untilNextNoise = framesPerNoise;
    }
    const bool mixes = m_previous && m_temporal.remembers({m_filtered.cols, m_filtered.rows});
    const Duration period = mixes ? periodBetween(m_previous->about, frame) : Duration::zero();
    const double asked = kOfStrength(settings.noiseReduction);
    const double least = mixes ? leastK(room - period, m_delay, period) : 0; // it will stand for a period, and grow older
    m_k = mixes ? chosenK(std::max(asked, least)) : 1;
    m_delay = mixes ? filterDelay(m_k, m_delay, period) : Duration::zero(); // what is mixed in brings its own with it
    m_temporal.apply(m_filtered, m_k, m_noise);
    PictureTreatment& treatment = m_last->treatment;
    treatment.k = m_k;
    treatment.filterDelay = m_delay;
    treatment.filterIsBounded = least > asked; // else it is on its way to what is asked for
}

bool DisplayChain::redraw(const DisplaySettings& settings, DisplayPicture& picture)
{
    if (!m_last)
        return false;
    picture = *m_last;
    return draw(settings, picture);
}

const cv::Mat& DisplayChain::enhanced(const DisplaySettings& settings, DisplayPicture& picture, int& fractionBits)
{
    fractionBits = 0;
    // Of the picture that stands there the filter can be taken away again; it cannot be put on without the ones before.
    const bool filtered = m_isFiltered && settings.noiseReduction > 0;
    if (!filtered)
        picture.treatment = {};
    if (!filtered && settings.edge == 0)
        return m_stored;
    const Instant begun = present();
    if (filtered)
        m_filtered.copyTo(m_work);
    else
        m_stored.convertTo(m_work, CV_32F);
    if (settings.edge > 0) {
        const NoiseModel noise = filtered ? m_noise.scaled(varianceShare(m_k)) : estimateNoise(m_work);
        if (settings.edgeMethod == EdgeMethod::MultiScale)
            m_multiScale.apply(m_work, settings.edge, noise);
        else
            m_edge.apply(m_work, settings.edge, noise);
    }
    fractionBits = storedBits - picture.about.bitsStored;
    m_work.convertTo(m_quantised, CV_16U, std::ldexp(1.0, fractionBits));
    picture.times.edge = present() - begun;
    return m_quantised;
}

GreyWindow DisplayChain::automaticWindow(ShutterShape shape)
{
    if (std::exchange(m_automaticShutter, shape) != shape) {
        m_autoWindow.reset();
        m_automatic.reset();
    }
    if (!m_automatic)
        m_automatic = m_autoWindow.next(m_stored, Shutter(shape, {m_stored.cols, m_stored.rows}));
    return *m_automatic;
}

GreyWindow DisplayChain::chosenWindow(const DisplaySettings& settings, bool& isAutomatic)
{
    const XrayFrame& about = m_last->about;
    const GreyWindow sent{about.windowCentre, about.windowWidth};
    const double range = std::ldexp(1.0, about.bitsStored);
    const Shutter shutter(settings.shutter, {about.columns, about.rows});
    isAutomatic = false;
    switch (settings.window) {
    case WindowChoice::Fixed:
        return withinPicture(carriedOver(settings.fixed, settings.fixedOn, basisOf(about)), percentileWindow(m_stored, shutter));
    case WindowChoice::FullRange:
        return {range / 2, range};
    case WindowChoice::AsSent:
    case WindowChoice::Narrow:
    case WindowChoice::Wide:
        if (!sent.isKnown())
            break;
        return settings.window == WindowChoice::AsSent
                   ? sent
                   : GreyWindow{sent.centre, sent.width * (settings.window == WindowChoice::Wide ? 2 : 0.5)};
    case WindowChoice::Automatic:
        break;
    }
    isAutomatic = true;
    return automaticWindow(settings.shutter);
}

bool DisplayChain::draw(const DisplaySettings& settings, DisplayPicture& picture)
{
    int fractionBits = 0;
    const cv::Mat& last = enhanced(settings, picture, fractionBits);
    const Instant begun = present();
    picture.settings = settings;
    picture.window = chosenWindow(settings, picture.windowIsAutomatic);
    picture.isCalibrated = m_table.isCalibrated();
    const bool lowIsWhite = (picture.about.photometric == Photometric::Monochrome1) != settings.inverted;
    m_table.prepare({picture.window, settings.function, lowIsWhite ? Polarity::LowIsWhite : Polarity::LowIsBlack}, fractionBits);
    picture.image = m_pool.next({last.cols, last.rows});
    if (!m_table.apply(last, picture.image))
        return false;
    picture.presentation = m_table.presentation(last);
    if (picture.isCalibrated && picture.presentation.isNull())
        return false;
    const Shutter shutter(settings.shutter, picture.image.size());
    applyShutter(picture.image, shutter);
    applyShutter(picture.presentation, shutter);
    m_pool.keep(picture.image);
    picture.times.window = present() - begun;
    return true;
}

} // namespace console
